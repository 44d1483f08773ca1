"""The shape and the axes of a block in PyBullet, which has inertias about a body's own axes."""

from __future__ import annotations

from typing import Any

import numpy as np

from vv.scene import Scene, Vector

ALIKE = 1e-9  # relative to a length or an inertia: less is rounding
LOCKED = 1e12  # factor on the largest moment: inertia about a locked axis
CORNERS = 8


def own_axes(block: dict[str, Any]) -> dict[str, Any]:
    """axes (3, 3): the block's own axes as rows; half: half sides of a box, [] for others; moments.

    block: one of those that `vv.standins.boxed` writes. The moments of a block that cannot rotate
    are zero, by which PyBullet means an infinite inertia. About a single locked axis a moment is
    large but finite, since the gyroscopic torque is divided by each.
    """
    inertia = np.array(block["inertia"])
    vertices = np.array(block["vertices"])
    axes = _edges(vertices)
    half = [] if axes is None else np.abs(vertices @ axes.T).max(axis=0).tolist()
    if axes is None or not _diagonal(axes @ inertia @ axes.T):
        axes, half = (np.eye(3) if _diagonal(inertia) else _principal(inertia)), []
    moments = np.diag(axes @ inertia @ axes.T)
    loose = np.abs(axes[:, np.array(block["free_spin"], bool)]).max(axis=1, initial=0.0) > ALIKE
    moments = np.where(loose, moments, LOCKED * moments.max() if loose.any() else 0.0)
    return {"axes": axes.tolist(), "half": half, "moments": moments.tolist()}


def why_no_shapes(scene: Scene) -> str | None:
    """Why PyBullet cannot lock blocks as the scene does; None if it can."""
    free = [block for block in scene.blocks if block.free.any()]
    if any((block.free != free[0].free).any() for block in free):
        return (
            "blocks are locked along different directions; gravity and shaking act alike on all in "
            "PyBullet"
        )
    for block in scene.blocks:
        loose = block.free_spin
        if not loose.any() or loose.all():
            continue
        turned = scene.axes @ block.inertia @ scene.axes.T
        if np.abs(turned[np.ix_(loose, ~loose)]).max() > ALIKE * np.abs(turned).max():
            return (
                f"block '{block.name}' is locked about an axis that is no principal axis of inertia"
            )
    return None


def _diagonal(matrix: Vector) -> bool:
    return bool(np.abs(matrix - np.diag(np.diag(matrix))).max() < ALIKE * np.abs(matrix).max())


def _principal(inertia: Vector) -> Vector:
    """Principal axes (3, 3) as the rows of a rotation."""
    axes = np.linalg.eigh(inertia)[1].T
    return np.asarray(axes * np.sign(np.linalg.det(axes)))


def _edges(vertices: Vector) -> Vector | None:
    """The axes (3, 3) of a box as the rows of a rotation; None if the vertices form no box."""
    if len(vertices) != CORNERS:
        return None
    arms = vertices[1:] - vertices[0]
    arms = arms[np.argsort(np.linalg.norm(arms, axis=1))]
    first = arms[0]
    across = [arm for arm in arms[1:] if _across(arm, first)]
    corner = [first, *across[:1], *(arm for arm in across[1:] if _across(arm, across[0]))][:3]
    if len(corner) < 3:
        return None
    axes = np.stack([arm / np.linalg.norm(arm) for arm in corner])
    axes[2] *= np.sign(np.linalg.det(axes))
    axes = np.where(np.abs(axes) < 1e-15, 0.0, axes)
    half = np.abs(vertices @ axes.T)
    is_box = np.abs(half - half[0]).max() < ALIKE * half.max()
    return np.asarray(axes[_sorted(axes)]) if is_box else None


def _across(one: Vector, other: Vector) -> bool:
    size = float(np.linalg.norm(one) * np.linalg.norm(other))
    return bool(abs(one @ other) < ALIKE * size)


def _sorted(axes: Vector) -> list[int]:
    """The cyclic order in which the rows are closest to x, y, z."""
    turns = [[0, 1, 2], [1, 2, 0], [2, 0, 1]]
    return max(turns, key=lambda order: float(np.abs(np.diag(axes[order])).sum()))

"""Reasons why LMGC90 cannot represent an ask although it has every term."""

from __future__ import annotations

import itertools

import numpy as np

from vv.ask import Ask
from vv.scene import Block, Scene, Vector, Wall, face_normal, polyhedron_inertia
from vv.standins.boxed import why_no_boxes

TOUCHING = 1e-9  # relative to a block's size: a smaller gap counts as contact
ALIKE = 1e-9  # relative tolerance of masses and inertias


def refusal(ask: Ask) -> str | None:
    """The first reason to refuse the ask; None if there is none."""
    return why_no_boxes(ask) or _spins(ask.scene) or _densities(ask.scene) or _faces(ask.scene)


def _spins(scene: Scene) -> str | None:
    for block in scene.blocks:
        if block.spin.any():
            return f"block '{block.name}' spins at the start; spins are not passed to LMGC90"
    return None


def density(scene: Scene) -> float:
    """The density [kg/m3] of the first block, which must be that of all blocks."""
    block = scene.blocks[0]
    return block.mass / polyhedron_inertia(block.vertices, block.faces, 1.0)[0]


def _densities(scene: Scene) -> str | None:
    """Why masses or inertias are not those of one density, which is all that LMGC90 accepts."""
    rho = density(scene)
    for block in scene.blocks:
        mass, inertia = polyhedron_inertia(block.vertices, block.faces, rho)
        if not np.isclose(mass, block.mass, ALIKE, 0):
            return (
                f"block '{block.name}' has another density than the first; LMGC90 takes a single "
                "one"
            )
        off = np.abs(inertia - block.inertia).max()
        if block.free_spin.any() and off > ALIKE * np.abs(inertia).max():
            return f"block '{block.name}' has an inertia which is not that of its volume"
    return None


def _faces(scene: Scene) -> str | None:
    """Why bodies do not meet face to face at the start; LMGC90 detects only such contacts."""
    for block in scene.blocks:
        for wall in scene.walls:
            if reason := _on_wall(block, wall):
                return reason
    for one, other in itertools.combinations(scene.blocks, 2):
        if near(one, other) and not _share_a_plane(one, other):
            return f"blocks '{one.name}' and '{other.name}' do not meet face to face at the start"
    if not scene.walls and len(scene.blocks) == 1:
        return "a single block without a wall has no contact"
    return None


def _on_wall(block: Block, wall: Wall) -> str | None:
    """Why a block does not stand on a wall with a face; None if it does, or is above the wall."""
    gap = (block.vertices - wall.point) @ wall.normal
    size = _size(block)
    feet = block.vertices[np.abs(gap) < TOUCHING * size]
    if not len(feet) and gap.min() > 0.5 * size:  # other blocks lie between
        return None
    across = feet - feet.mean(axis=0) if len(feet) else feet
    if len(feet) < 3 or np.linalg.matrix_rank(across, 1e-6 * size) < 2:
        return f"block '{block.name}' does not stand on its wall with a face at the start"
    return None


def near(one: Block, other: Block) -> bool:
    """Whether two blocks may touch, judged by their bounding boxes."""
    slack = TOUCHING * max(_size(one), _size(other))
    low = np.maximum(one.vertices.min(axis=0), other.vertices.min(axis=0))
    high = np.minimum(one.vertices.max(axis=0), other.vertices.max(axis=0))
    return bool((low <= high + slack).all())


def _share_a_plane(one: Block, other: Block) -> bool:
    slack = TOUCHING * max(_size(one), _size(other))
    return any(
        np.linalg.norm(n + m) < 1e-6 and abs((a - b) @ n) < slack
        for a, n in _planes(one)
        for b, m in _planes(other)
    )


def _planes(block: Block) -> list[tuple[Vector, Vector]]:
    return [(block.vertices[face[0]], face_normal(block.vertices, face)) for face in block.faces]


def _size(block: Block) -> float:
    return float(np.ptp(block.vertices, axis=0).max())

"""Checks a scene of blocks before it is run, and finds which block a body number refers to."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from vv.engines.blocks.geometry import depth_axis
from vv.scene import Block, Scene, Vector

OVERLAP = 1e-6  # of the smaller block's size: a larger overlap at t = 0 is not rounding
LOCKED = 1e-12  # part of a speed below which its component in a locked direction is rounding
ACROSS = 1e-9  # length of a normal's part in the free directions below which it has none


def block_index(scene: Scene, body: int) -> int:
    """The index within `blocks` of a body number; raises ValueError if the body is no block."""
    first = block = 0
    for group in scene.bodies:
        if isinstance(group, Block):
            if body == first:
                return block
            block += 1
        first += len(group)
    raise ValueError(f"body {body} is no block of this scene, which has {first} bodies")


def strained(scene: Scene) -> str | None:
    """A refusal that names the first elastic block, or None."""
    for block in scene.blocks:
        if block.elastic:
            return f"block '{block.name}' is elastic; only rigid blocks are solved"
    return None


def moves_where_locked(scene: Scene) -> str | None:
    """A refusal that names the first block with a velocity or spin along a locked axis, or None."""
    for block in scene.blocks:
        for name, free in (("velocity", block.free), ("spin", block.free_spin)):
            parts = scene.axes @ getattr(block, name)
            for axis in np.flatnonzero(~free & (np.abs(parts) > LOCKED * np.abs(parts).max()))[:1]:
                along = f"{parts[axis]:.6g} along a locked axis"
                return f"block '{block.name}': its {name} has {along}; it must be at rest there"
    return None


def undetermined(scene: Scene) -> str | None:
    """A refusal that names a block locked along the normal of a wall with friction, or None.

    The normal force of rigid contact, and with it the friction, is then not determined.
    """
    for block in scene.blocks:
        rows = scene.axes[block.free]
        for number, wall in enumerate(scene.walls):
            touches = (block.vertices - wall.point) @ wall.normal
            held = len(rows) and not block.free_spin.any() and (
                np.linalg.norm(rows @ wall.normal) <= ACROSS
            )  # fmt: skip
            if held and scene.contact.mu > 0 and touches.min() <= OVERLAP * size(block):
                return (
                    f"block '{block.name}' is locked along the normal of wall {number}, which it "
                    "touches with friction: the normal force of rigid contact is not determined"
                )
    return None


def unsupported(scene: Scene) -> str | None:
    """A refusal that names a block under gravity or a load without any support, or None."""
    held = any(not block.free.any() for block in scene.blocks)
    if scene.walls or held:
        return None
    for block in scene.blocks:
        if scene.gravity.any() or block.load.any():
            return (
                f"block '{block.name}' has no support: gravity or a load accelerates it, and the "
                "scene has neither a wall nor a fixed block"
            )
    return None


def overlaps(scene: Scene) -> str | None:
    """A refusal that names a block which overlaps a wall or another block at t = 0, or None."""
    for block in scene.blocks:
        for number, wall in enumerate(scene.walls):
            depth = -float(((block.vertices - wall.point) @ wall.normal).min())
            if depth > OVERLAP * size(block) and _matters(scene, wall.normal):
                return f"block '{block.name}' overlaps wall {number} by {depth:.4g} m at t = 0"
    for one, two in _close_pairs(scene.blocks):
        apart, what = max(_separations(one, two))
        if -apart > OVERLAP * min(size(one), size(two)):
            return (
                f"blocks '{one.name}' and '{two.name}' overlap by {-apart:.4g} m at t = 0, "
                f"along {what}"
            )
    return None


def size(block: Block) -> float:
    """The largest extent of a block along the axes of the frame [m]."""
    return float(np.ptp(block.vertices, axis=0).max())


def _matters(scene: Scene, normal: Vector) -> bool:
    """Whether contact along a normal affects the motion: in a plane scene, not across the plane."""
    return bool(abs(float(depth_axis(scene) @ normal)) < 0.5)


def _close_pairs(blocks: tuple[Block, ...]) -> Iterator[tuple[Block, Block]]:
    """Pairs of blocks whose bounding boxes overlap and of which at least one can move."""
    low = np.array([block.vertices.min(axis=0) for block in blocks])
    high = np.array([block.vertices.max(axis=0) for block in blocks])
    for i, block in enumerate(blocks):
        meets = ((low < high[i]) & (high > low[i])).all(axis=1)
        for j in np.flatnonzero(meets[i + 1 :]) + i + 1:
            other = blocks[j]
            moves = [b.free.any() or b.free_spin.any() for b in (block, other)]
            if any(moves):
                yield block, other


def _separations(one: Block, two: Block) -> Iterator[tuple[float, str]]:
    """The distances of two blocks [m] along all axes that could separate them, with axis names."""
    for block, other in ((one, two), (two, one)):
        for number, (face, normal) in enumerate(zip(block.faces, block.normals, strict=True)):
            level = float(block.vertices[face[0]] @ normal)
            apart = float((other.vertices @ normal).min()) - level
            yield apart, f"the normal of face {number} of '{block.name}'"
    crossed = np.cross(_edges(one)[:, None], _edges(two)[None]).reshape(-1, 3)
    length = np.linalg.norm(crossed, axis=1)
    normals = crossed[length > 1e-6] / length[length > 1e-6, None]
    first, second = normals @ one.vertices.T, normals @ two.vertices.T
    gaps = np.maximum(
        second.min(axis=1) - first.max(axis=1), first.min(axis=1) - second.max(axis=1)
    )
    if len(gaps):
        yield float(gaps.max()), "a pair of edges"


def _edges(block: Block) -> Vector:
    """Unit vectors (e, 3) along the edges of a block."""
    pairs = {
        (min(a, b), max(a, b))
        for face in block.faces
        for a, b in zip(face, (*face[1:], face[0]), strict=True)
    }
    ends = block.vertices[np.array(sorted(pairs))]
    along = ends[:, 1] - ends[:, 0]
    return np.asarray(along / np.linalg.norm(along, axis=1)[:, None])

"""Finds the corners on which a block stands, their shares of its load, and its mass points."""

from __future__ import annotations

import numpy as np

from vv.scene import Block, Mask, Vector, Wall
from vv.standins.penalty_springs import TOUCHING

SIGNS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
FLAT = 1e-6  # relative deviation from a line below which corners are collinear


def size_of(block: Block) -> float:
    """The largest side [m] of the box around a block."""
    return float(np.ptp(block.vertices, axis=0).max())


def feet(block: Block, wall: Wall) -> Mask:
    """A mask (n,) of the vertices that lie on the wall."""
    gap = (block.vertices - wall.point) @ wall.normal
    return np.asarray(np.abs(gap) < TOUCHING * size_of(block))


def spans_a_face(block: Block, wall: Wall) -> bool:
    """Whether the vertices on the wall span a plane and not only a line."""
    lying = block.vertices[feet(block, wall)]
    across = lying - lying.mean(axis=0)
    return int(np.linalg.matrix_rank(across, FLAT * float(np.abs(across).max(initial=0.0)))) >= 2


def sole(block: Block, wall: Wall) -> tuple[Vector, Mask, Vector]:
    """Corners (k, 3) [m], which of them touch the wall (k,), and directions to the spheres (k, 3).

    A block stands on the vertices that lie on the wall. If it leans on an edge, its corners are
    those of the face on which it will fall back: of the two faces at the edge, the one that makes
    the smaller angle with the wall. The spheres of corners off the wall lie along the inward
    normal of that face, all others along the normal of the wall.
    """
    lies = feet(block, wall)
    if spans_a_face(block, wall):
        count = int(lies.sum())
        return block.vertices[lies], np.ones(count, bool), np.tile(wall.normal, (count, 1))
    edge = set(np.flatnonzero(lies).tolist())
    normals = {face: _inward(block, face) for face in block.faces if edge <= set(face)}
    face, inward = max(normals.items(), key=lambda item: float(item[1] @ wall.normal))
    chosen = list(face)
    touching = lies[chosen]
    return block.vertices[chosen], touching, np.where(touching[:, None], wall.normal, inward)


def _inward(block: Block, face: tuple[int, ...]) -> Vector:
    """The inward unit normal (3,) of a face."""
    a, b, c = block.vertices[list(face[:3])]
    normal = np.cross(b - a, c - a)
    return np.asarray(normal * np.sign(normal @ (block.centroid() - a)) / np.linalg.norm(normal))


def shares(block: Block, wall: Wall, feet: Vector, force: Vector, friction: Vector) -> Vector:
    """Each corner's share (k,) of the normal force, which varies linearly over the face.

    force, friction: (3,) [N] of the wall. Shares are negative if friction would tip the block.
    """
    alike = np.full(len(feet), 1 / len(feet))
    total = float(force @ wall.normal)
    if not block.free_spin.any() or total == 0:
        return alike
    arms = feet - block.centroid()
    # the shares add up to one; the moment about the centroid has no component along the wall
    rows = np.column_stack([np.ones(len(feet)), arms - np.outer(arms @ wall.normal, wall.normal)])
    centre = (arms @ wall.normal).mean() * wall.normal
    tipping = np.cross(centre, friction)
    moments = np.cross(arms, total * wall.normal).T @ rows
    system = np.vstack([rows.sum(axis=0), moments])
    wanted = np.concatenate([[1.0], -tipping])
    return np.asarray(rows @ np.linalg.lstsq(system, wanted, rcond=1e-12)[0])


def mass_points(block: Block) -> Vector:
    """Eight points (8, 3) [m] which, with an eighth of the mass each, have the block's inertia."""
    moments, axes = np.linalg.eigh(block.inertia)
    spread = np.sqrt((moments.sum() / 2 - moments) / block.mass)
    return np.asarray(block.centroid() + (SIGNS * spread) @ axes.T)

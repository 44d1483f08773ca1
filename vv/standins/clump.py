"""Blocks as clumps: spheres at the corners they stand on, and points that hold their mass."""

from __future__ import annotations

import functools
from dataclasses import dataclass

import numpy as np

from vv.ask import Ask
from vv.scene import Block, Term, Vector, Wall, initial_normal_forces
from vv.standins.soften import TOUCHING
from vv.standins.stand_in import Stood, held, stood_for, why_not

SMALL = 0.01  # of a block's size: the radius of the spheres at its corners
SIGNS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)


@dataclass(frozen=True, eq=False)
class Clump:
    """A block on one wall, as a rigid body of spheres.

    stood: the scene in which a single sphere stands for the block, with springs kn, ks of the
    whole. corners: centres (k, 3) [m] of the spheres, of one radius [m], that touch the wall;
    each has springs kn/k, ks/k, and shares (k,) is its part of the normal force and friction at
    t = 0. points: (8, 3) [m], each an eighth of the mass; they have the block's inertia.
    """

    stood: Stood
    block: Block
    corners: Vector
    radius: float
    shares: Vector
    points: Vector

    @property
    def friction(self) -> Vector:
        """The friction (k, 3) [N] that the shear spring of each corner holds at t = 0."""
        assert self.stood.charged is not None
        return np.outer(self.shares, self.stood.charged[0])

    @property
    def words(self) -> str:
        """What it is made of."""
        return (
            f"{len(self.corners)} spheres of {self.radius:g} m on its corners, which share the "
            "springs below, and eight points with its mass and inertia"
        )


@functools.lru_cache(maxsize=32)  # it is wanted several times for each of a ladder's rungs
def clump(ask: Ask) -> Clump:
    """The clump for an ask about one block on a wall; `why_no_clump` must not object.

    Spheres stand on the corners, pressed in by what their springs carry. Where the block may
    turn, the corners share the load so that nothing turns it at t = 0: friction acts below the
    centroid. Where it may not, its lock does that, and all share alike.
    """
    (block,), (wall,) = ask.scene.blocks, ask.scene.walls
    stood = stood_for(ask)
    size = float(np.ptp(block.vertices, axis=0).max())
    feet = _feet(block, wall, size)
    (force,) = initial_normal_forces(stood.scene)
    shares = _shares(block, wall, feet, force, stood)
    overlap = shares * len(feet) * float(force @ wall.normal) / stood.scene.contact.kn
    radius = SMALL * size
    corners = feet + np.outer(radius - overlap, wall.normal)
    lowered = stood.scene.spheres.position[0] - block.centroid()
    return Clump(stood, block, corners, radius, shares, _points(block) + lowered)


def why_no_clump(ask: Ask) -> str | None:
    """Why no clump can stand for what an ask has; None if one can."""
    scene = ask.scene
    if len(scene.blocks) != 1 or len(scene.walls) != 1 or len(scene.spheres):
        return "a clump stands for one block on one wall: its corners meet no faces and edges"
    if Term.RIGID_CONTACT not in scene.terms():
        return "a block whose contact has a stiffness of its own does not say how corners share it"
    if scene.blocks[0].spin.any():
        return f"block '{scene.blocks[0].name}' spins as it starts: corners slip their own ways"
    return why_not(held(ask)) or _tips(ask) or _sinks(ask)


def _tips(ask: Ask) -> str | None:
    """Why a block would not begin on all corners of a face."""
    (block,), (wall,) = ask.scene.blocks, ask.scene.walls
    feet = _feet(block, wall, float(np.ptp(block.vertices, axis=0).max()))
    across = feet - feet.mean(axis=0)
    if np.linalg.matrix_rank(across, 1e-6 * float(np.abs(across).max(initial=0.0))) < 2:
        return f"block '{block.name}' stands on no face, but on {len(feet)} corners"
    if (clump(ask).shares < 0).any():
        return f"block '{block.name}' begins to tip: not all corners of its face are pressed"
    return None


def _sinks(ask: Ask) -> str | None:
    """Why springs would be too soft for spheres so small: their centres must stay off the wall."""
    made, (wall,) = clump(ask), ask.scene.walls
    lowest = float(((made.corners - wall.point) @ wall.normal).min())
    if lowest > 0:
        return None
    return (
        f"kn = {ask.knobs.kn:g} N/m lets a corner sink by {made.radius - lowest:.3g} m at t = 0, "
        f"through its sphere of {made.radius:g} m"
    )


def _feet(block: Block, wall: Wall, size: float) -> Vector:
    """The vertices (k, 3) that lie on the wall."""
    gap = (block.vertices - wall.point) @ wall.normal
    return np.asarray(block.vertices[np.abs(gap) < TOUCHING * size])


def _shares(block: Block, wall: Wall, feet: Vector, force: Vector, stood: Stood) -> Vector:
    """Each corner's part (k,) of the normal force: linear over the face, as of a rigid body."""
    alike = np.full(len(feet), 1 / len(feet))
    total = float(force @ wall.normal)
    if not block.free_spin.any() or total == 0 or stood.charged is None:
        return alike
    arms = feet - block.centroid()
    # sum of shares is one, and the moment of all forces about the centroid along the wall nil
    rows = np.column_stack([np.ones(len(feet)), arms - np.outer(arms @ wall.normal, wall.normal)])
    centre = (arms @ wall.normal).mean() * wall.normal
    tipping = np.cross(centre, stood.charged[0])
    moments = np.cross(arms, total * wall.normal).T @ rows
    system = np.vstack([rows.sum(axis=0), moments])
    wanted = np.concatenate([[1.0], -tipping])
    return np.asarray(rows @ np.linalg.lstsq(system, wanted, rcond=1e-12)[0])


def _points(block: Block) -> Vector:
    """Eight places (8, 3) for an eighth of the mass each, with the block's inertia."""
    moments, axes = np.linalg.eigh(block.inertia)
    spread = np.sqrt((moments.sum() / 2 - moments) / block.mass)
    return np.asarray(block.centroid() + (SIGNS * spread) @ axes.T)

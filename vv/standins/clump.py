"""Blocks as clumps: spheres at the corners they stand on, and points that hold their mass."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from vv.ask import Ask
from vv.scene import Block, Mask, Scene, Vector, in_frame, initial_wall_forces
from vv.standins.corners import mass_points, shares, size_of, sole
from vv.standins.stand_in import SpringScene
from vv.standins.tipping import tipping

SMALL = 0.01  # of a block's size: the radius of the spheres at its corners
TINY = 0.001  # the same of a block that leans: it turns about the edge, not about spheres


@dataclass(frozen=True, eq=False)
class Clump:
    """A block on a wall, as a rigid body of spheres.

    corners: centres (k, 3) [m] of the spheres, of one radius [m], that meet the wall; each has a
    part 1/k of the block's springs; forces (k, 3) [N] are those of the wall on them at t = 0;
    touching (k,): which are pressed then, all but where it leans or begins to tip. points: (8, 3)
    [m], each an eighth of the mass; they have the block's inertia. free_spin: (3,) whether it may
    turn about the axes of the frame. extra, moment: (3,) what the forces have beyond those on the
    sphere in its place [N], and how they turn the block [N m].
    """

    block: Block
    corners: Vector
    radius: float
    forces: Vector
    touching: Mask
    points: Vector
    free_spin: Mask
    normal: Vector
    extra: Vector
    moment: Vector

    @property
    def friction(self) -> Vector:
        """The friction (k, 3) [N] that the shear spring of each corner holds at t = 0."""
        return np.asarray(self.forces - np.outer(self.forces @ self.normal, self.normal))

    @property
    def tips(self) -> bool:
        """Whether it begins to tip."""
        return bool(self.moment.any())

    @property
    def words(self) -> str:
        """What it is made of."""
        return (
            f"{len(self.corners)} spheres of {self.radius:g} m on its corners, which share the "
            "springs below, and eight points with its mass and inertia"
        )


def clumps(ask: Ask, springs: SpringScene) -> tuple[Clump, ...]:
    """The clumps for an ask about blocks on a wall; `why_no_clump` must not object.

    springs: the scene in which spheres stand for the blocks, with their rotations locked.
    """
    pressed = initial_wall_forces(springs.scene)
    charged = np.zeros_like(pressed) if springs.charged is None else springs.charged
    places = springs.scene.spheres.position
    law = springs.scene.contact
    rows = zip(ask.scene.blocks, pressed, charged, places, strict=True)
    return tuple(_clump(b, ask.scene, force, drag, place, law.kn) for b, force, drag, place in rows)


def words(made: Sequence[Clump], body: str) -> str:
    """How a code is given blocks: as bodies of which kind, and what they are made of."""
    if len(made) == 1:
        return f"{body} stands for the block: {made[0].words}"
    return f"{body} stands for each of {len(made)} blocks: of the first, {made[0].words}"


def _clump(
    block: Block, scene: Scene, pressed: Vector, charged: Vector, place: Vector, kn: float
) -> Clump:
    """The clump of a block that is pressed and held by forces (3,) [N] where it stands.

    Spheres stand on the corners, pressed in by what their springs carry. Where the block may
    turn, the corners share the load so that nothing turns it at t = 0: friction acts below the
    centroid; if no sharing does that, it begins to tip. Where it may not, its lock does that, and
    all share alike. A block that leans on an edge starts with its weight on that: the rigid one
    presses less, as it begins to fall back, and springs of rigid contact do not tell.
    """
    (wall,) = scene.walls
    corners, touching, up = sole(block, wall)
    leans = not touching.all()
    part = touching / touching.sum()
    if not leans:
        part = shares(block, wall, corners, pressed, charged)
    forces, moment = np.outer(part, pressed + charged), np.zeros(3)
    if (part < 0).any():
        forces = tipping(block, wall, scene, corners, part)
        moment = np.cross(corners - block.centroid(), forces).sum(axis=0)
        touching = forces @ wall.normal > 0
    overlap = len(corners) * (forces @ wall.normal) / kn
    radius = (TINY if leans else SMALL) * size_of(block)
    centres = corners + (radius - overlap)[:, None] * up
    turns = in_frame(scene.axes, block.free_spin)
    return Clump(
        block, centres, radius, forces, touching, mass_points(block) + place - block.centroid(),
        block.free_spin if turns is None else turns, wall.normal,
        forces.sum(axis=0) - pressed - charged if moment.any() else np.zeros(3), moment,
    )  # fmt: skip

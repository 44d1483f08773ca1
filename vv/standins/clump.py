"""Represents blocks by clumps: spheres at the corners that stand on the wall, and mass points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from vv.ask import Ask
from vv.scene import Block, Mask, Scene, Vector, in_frame, initial_wall_forces
from vv.standins.corners import mass_points, shares, size_of, sole
from vv.standins.stand_in import SpringScene
from vv.standins.tipping import tipping

SMALL = 0.01  # radius of the spheres at the corners, over the size of the block
TINY = 0.001  # the same for a block that leans: it must turn about its edge, not about spheres


@dataclass(frozen=True, eq=False)
class Clump:
    """A block on a wall, as a rigid body of spheres.

    corners: (k, 3) centres [m] of the spheres that meet the wall, all of one radius [m]; each has a
    share 1/k of the block's stiffness. forces: (k, 3) [N] of the wall on them at t = 0. touching:
    (k,) which of them are loaded then: all, unless the block leans or begins to tip. points: (8, 3)
    [m], each with an eighth of the mass; together they have the block's inertia. free_spin: (3,)
    whether the block may rotate about each axis of the frame. extra: (3,) [N] the sum of forces
    less the force on the sphere that would represent a block without rotations. moment: (3,) [N m]
    of the forces about the centroid, if the block begins to tip.
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
        """The friction (k, 3) [N] in the shear spring of each corner at t = 0."""
        return np.asarray(self.forces - np.outer(self.forces @ self.normal, self.normal))

    @property
    def tips(self) -> bool:
        """Whether the block begins to tip at t = 0."""
        return bool(self.moment.any())

    @property
    def words(self) -> str:
        """A description of the spheres and points of the clump."""
        return (
            f"{len(self.corners)} spheres of {self.radius:g} m on its corners, which share the "
            "springs below, and eight points with its mass and inertia"
        )


def clumps(ask: Ask, springs: SpringScene) -> tuple[Clump, ...]:
    """The clumps for an ask about blocks on a wall, for which `why_no_clump` is None.

    springs: the scene in which spheres represent the blocks, with locked rotations.
    """
    pressed = initial_wall_forces(springs.scene)
    charged = np.zeros_like(pressed) if springs.charged is None else springs.charged
    places = springs.scene.spheres.position
    law = springs.scene.contact
    rows = zip(ask.scene.blocks, pressed, charged, places, strict=True)
    return tuple(_clump(b, ask.scene, force, drag, place, law.kn) for b, force, drag, place in rows)


def words(made: Sequence[Clump], body: str) -> str:
    """A note on the kind of body by which a code represents blocks, and on its parts."""
    if len(made) == 1:
        return f"{body} stands for the block: {made[0].words}"
    return f"{body} stands for each of {len(made)} blocks: of the first, {made[0].words}"


def _clump(
    block: Block, scene: Scene, pressed: Vector, charged: Vector, place: Vector, kn: float
) -> Clump:
    """The clump of a block on which its wall acts at t = 0.

    pressed, charged: (3,) [N] normal force and friction of the wall; place: (3,) centre [m] of the
    sphere that represents the block without rotations. Spheres at the corners overlap the wall by
    the compression of their springs. If the block may rotate, the corners share the load so that
    the moment about the centroid is zero, although friction acts below it; if no such shares
    exist, the block begins to tip. If it may not rotate, its lock carries the moment, and all
    shares are equal. A block that leans on an edge starts with its whole weight on that edge. In
    rigid contact the force is smaller, since the block begins to fall back; how much smaller is
    not determined by the springs.
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

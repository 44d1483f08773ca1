"""Blocks as clumps: spheres at the corners they stand on, and points that hold their mass."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from vv.ask import Ask
from vv.scene import Block, Mask, Pulse, Term, Vector, Wall, initial_normal_forces
from vv.standins.corners import feet, mass_points, shares, size_of, sole, spans_a_face
from vv.standins.stand_in import (
    SpringScene,
    spring_scene,
    why_no_spring_scene,
    without_rotations,
)

SMALL = 0.01  # of a block's size: the radius of the spheres at its corners
TINY = 0.001  # the same of a block that leans: it turns about the edge, not about spheres


@dataclass(frozen=True, eq=False)
class Clump:
    """A block on one wall, as a rigid body of spheres.

    springs: the scene in which a single sphere stands for the block, with springs kn, ks of the
    whole. corners: centres (k, 3) [m] of the spheres, of one radius [m], that meet the wall;
    each has springs kn/k, ks/k, and shares (k,) is its part of the normal force and friction at
    t = 0; touching (k,): which are on the wall then, all but where it leans. points: (8, 3) [m],
    each an eighth of the mass; they have the block's inertia.
    """

    springs: SpringScene
    block: Block
    corners: Vector
    radius: float
    shares: Vector
    touching: Mask
    points: Vector

    @property
    def friction(self) -> Vector:
        """The friction (k, 3) [N] that the shear spring of each corner holds at t = 0."""
        assert self.springs.charged is not None
        return np.outer(self.shares, self.springs.charged[0])

    @property
    def words(self) -> str:
        """What it is made of."""
        return (
            f"{len(self.corners)} spheres of {self.radius:g} m on its corners, which share the "
            "springs below, and eight points with its mass and inertia"
        )


def clump(ask: Ask, springs: SpringScene) -> Clump:
    """The clump for an ask about one block on a wall; `why_no_clump` must not object.

    springs: the scene in which a sphere stands for the block, with its rotations locked.

    Spheres stand on the corners, pressed in by what their springs carry. Where the block may
    turn, the corners share the load so that nothing turns it at t = 0: friction acts below the
    centroid. Where it may not, its lock does that, and all share alike. A block that leans on an
    edge starts with its weight on that: the rigid one presses less, as it begins to fall back, and
    springs of rigid contact do not tell.
    """
    (block,), (wall,) = ask.scene.blocks, ask.scene.walls
    corners, touching, up = sole(block, wall)
    (force,) = initial_normal_forces(springs.scene)
    part = touching / touching.sum()
    if touching.all():
        part = shares(block, wall, corners, force, springs.charged)
    overlap = part * len(corners) * float(force @ wall.normal) / springs.scene.contact.kn
    radius = (SMALL if touching.all() else TINY) * size_of(block)
    centres = corners + (radius - overlap)[:, None] * up
    lowered = springs.scene.spheres.position[0] - block.centroid()
    return Clump(springs, block, centres, radius, part, touching, mass_points(block) + lowered)


def why_no_clump(ask: Ask) -> str | None:
    """Why no clump can stand for what an ask has; None if one can."""
    scene = ask.scene
    if len(scene.blocks) != 1 or len(scene.walls) != 1 or len(scene.spheres):
        return "a clump stands for one block on one wall: its corners meet no faces and edges"
    if Term.RIGID_CONTACT not in scene.terms():
        return "a block whose contact has a stiffness of its own does not say how corners share it"
    if scene.blocks[0].spin.any():
        return f"block '{scene.blocks[0].name}' spins as it starts: corners slip their own ways"
    locked = without_rotations(ask)
    reason = why_no_spring_scene(locked) or _no_face(scene.blocks[0], scene.walls[0])
    if reason is not None:
        return reason
    made = clump(ask, spring_scene(locked))
    return _tips(made) or _sinks(made, ask) or _hurries(made, ask)


def _no_face(block: Block, wall: Wall) -> str | None:
    """Why a block would not stand on corners that span a face, nor rest on an edge and lean."""
    if spans_a_face(block, wall):
        return None
    count = int(feet(block, wall).sum())
    if count != 2 or not block.free_spin.any():
        return f"block '{block.name}' stands on no face, but on {count} corners"
    if block.velocity.any() or wall.motion is not None:
        return (
            f"block '{block.name}' moves on an edge as it starts: what presses the edge is not "
            "known, and springs would give that back"
        )
    return None


def _tips(made: Clump) -> str | None:
    """Why a block would not begin on all corners of its face."""
    if (made.shares < 0).any():
        name = made.block.name
        return f"block '{name}' begins to tip: not all corners of its face are pressed"
    return None


def _sinks(made: Clump, ask: Ask) -> str | None:
    """Why springs would be too soft for spheres so small: their centres must stay off the wall."""
    (wall,) = ask.scene.walls
    lowest = float(((made.corners - wall.point) @ wall.normal).min())
    if lowest > 0:
        return None
    return (
        f"kn = {ask.knobs.kn:g} N/m lets a corner sink by {made.radius - lowest:.3g} m at t = 0, "
        f"through its sphere of {made.radius:g} m"
    )


def _hurries(made: Clump, ask: Ask) -> str | None:
    """Why a step would be too long for a block that rocks from corner to corner.

    One that stays on its face bears longer steps than its turning does.
    """
    block, law = made.block, made.springs.scene.contact
    rocks = isinstance(ask.scene.shaking, Pulse) or not made.touching.all()
    if ask.dt is None or not rocks or not block.free_spin.any():
        return None
    normal, count = ask.scene.walls[0].normal, len(made.corners)
    along = np.outer(normal, normal)
    spring = (law.kn * along + law.ks * (np.eye(3) - along)) / count
    moved = [np.hstack([np.eye(3), _turning(foot)]) for foot in made.corners - block.centroid()]
    stiff = np.sum([each.T @ spring @ each for each in moved], axis=0)
    mass = np.zeros((6, 6))
    mass[:3, :3], mass[3:, 3:] = block.mass * np.eye(3), block.inertia
    free = np.concatenate([block.free, block.free_spin])
    own = np.ix_(free, free)
    squares: Vector = np.linalg.eigvals(np.linalg.solve(mass[own], stiff[own])).real
    longest = 2.0 / float(np.sqrt(squares.max()))
    if ask.dt < longest:
        return None
    return f"dt = {ask.dt:g} s; the springs of its corners are stable up to {longest:.3g} s"


def _turning(arm: Vector) -> Vector:
    """(3, 3): how a point moves as the body turns, minus the cross product of its arm."""
    x, y, z = arm
    return np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])

"""Blocks as clumps: spheres at the corners they stand on, and points that hold their mass."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from vv.ask import Ask
from vv.scene import Block, Mask, Pulse, Scene, Term, Vector, Wall, in_frame, initial_wall_forces
from vv.standins.corners import feet, mass_points, shares, size_of, sole, spans_a_face
from vv.standins.stand_in import (
    SHEAR,
    SpringScene,
    spring_scene,
    why_no_spring_scene,
    without_rotations,
)
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


def why_no_clump(ask: Ask) -> str | None:
    """Why no clumps can stand for what an ask has; None if they can."""
    scene = ask.scene
    if len(scene.walls) != 1 or not scene.blocks or len(scene.spheres):
        return "a clump stands for a block on one wall: its corners meet no faces and edges"
    if Term.RIGID_CONTACT not in scene.terms():
        return "a block whose contact has a stiffness of its own does not say how corners share it"
    if spinning := [block.name for block in scene.blocks if block.spin.any()]:
        return f"block '{spinning[0]}' spins as it starts: corners slip their own ways"
    locked, wall = without_rotations(ask), scene.walls[0]
    reasons = (_no_face(block, wall) for block in scene.blocks)
    reason = why_no_spring_scene(locked) or next(filter(None, reasons), None)
    if reason is not None:
        return reason
    made = clumps(ask, spring_scene(locked))
    return _unlike(made) or next(filter(None, (_starts_ill(one, ask) for one in made)), None)


def _unlike(made: Sequence[Clump]) -> str | None:
    """Why springs would not be right for all: each corner has the same."""
    first = len(made[0].corners)
    for one in made:
        if len(one.corners) != first:
            return (
                f"blocks '{made[0].block.name}' and '{one.block.name}' stand on {first} and "
                f"{len(one.corners)} corners, of which all springs are alike"
            )
    return None


def _starts_ill(made: Clump, ask: Ask) -> str | None:
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
    """Why it is not known what presses a block that begins to tip."""
    if made.touching.any():
        return None
    return (
        f"block '{made.block.name}' begins to tip as it slides: what presses the corners it turns "
        "about is found for a block at rest"
    )


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

    One alone that slides on its face bears longer steps than its turning does, since friction
    caps what grows; where it stops, it lets go and sets off again. Among several, rounding is
    enough to set one off: forty steps threw blocks that only slide by all of their way.
    """
    block, kn = made.block, ask.knobs.kn
    pulsed = isinstance(ask.scene.shaking, Pulse)
    several = len(ask.scene.blocks) > 1
    rocks = pulsed or several or not made.touching.all() or _stops(made, ask.scene)
    if kn is None or not rocks or not block.free_spin.any():
        return None
    along, axes = np.outer(made.normal, made.normal), ask.scene.axes
    ks = SHEAR * kn if ask.scene.contact.mu > 0 else 0.0
    spring = (kn * along + ks * (np.eye(3) - along)) / len(made.corners)
    arms = made.corners - block.centroid()
    moved = [np.hstack([axes.T, _turning(foot) @ axes.T]) for foot in arms]
    stiff = np.sum([each.T @ spring @ each for each in moved], axis=0)
    mass = np.zeros((6, 6))
    mass[:3, :3], mass[3:, 3:] = block.mass * np.eye(3), axes @ block.inertia @ axes.T
    free = np.concatenate([block.free, block.free_spin])
    own = np.ix_(free, free)
    squares: Vector = np.linalg.eigvals(np.linalg.solve(mass[own], stiff[own])).real
    longest = 2.0 / float(np.sqrt(squares.max()))
    if ask.dt < longest:
        return None
    return f"dt = {ask.dt:g} s; the springs of its corners are stable up to {longest:.3g} s"


def _stops(made: Clump, scene: Scene) -> bool:
    """Whether a block that moves at t = 0 is stopped by friction, where nothing shakes it."""
    block, (wall,) = made.block, scene.walls
    if scene.shaking is not None or wall.motion is not None or not block.velocity.any():
        return False
    load = block.load + block.mass * scene.gravity
    press = -float(load @ made.normal)
    return bool(np.linalg.norm(load + press * made.normal) < scene.contact.mu * press)


def _turning(arm: Vector) -> Vector:
    """(3, 3): how a point moves as the body turns, minus the cross product of its arm."""
    x, y, z = arm
    return np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])

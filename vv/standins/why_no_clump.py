"""Says why a clump cannot represent a block: because of its support, its springs or the step."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from vv.ask import Ask
from vv.scene import Block, Pulse, Scene, Term, Vector, Wall
from vv.standins.clump import Clump, clumps
from vv.standins.corners import feet, spans_a_face
from vv.standins.penalty_springs import found_once
from vv.standins.stand_in import SHEAR, spring_scene, why_no_spring_scene, without_rotations

MOST_STRETCH = 0.02  # of shear springs, over the distance in which friction stops a slide


@found_once
def why_no_clump(ask: Ask) -> str | None:
    """Why clumps cannot represent the blocks of an ask; None if they can."""
    scene = ask.scene
    if len(scene.walls) != 1 or not scene.blocks or len(scene.spheres):
        return "a clump represents a block on one wall: its corners cannot touch faces and edges"
    if Term.RIGID_CONTACT not in scene.terms():
        return "how the corners of a clump share the stiffness of its contact is not defined"
    if spinning := [block.name for block in scene.blocks if block.spin.any()]:
        return f"block '{spinning[0]}' spins at t = 0: its corners slip in different directions"
    locked, wall = without_rotations(ask), scene.walls[0]
    reasons = (_no_face(block, wall) for block in scene.blocks)
    reason = why_no_spring_scene(locked) or next(filter(None, reasons), None)
    if reason is not None:
        return reason
    made = clumps(ask, spring_scene(locked))
    return _unlike(made) or next(filter(None, (_why_not(one, ask) for one in made)), None)


def _unlike(made: Sequence[Clump]) -> str | None:
    """Why the springs cannot suit all clumps: every corner has the same; None if they do."""
    first = len(made[0].corners)
    for one in made:
        if len(one.corners) != first:
            return (
                f"blocks '{made[0].block.name}' and '{one.block.name}' stand on {first} and "
                f"{len(one.corners)} corners, but all corners have the same springs"
            )
    return None


def _why_not(made: Clump, ask: Ask) -> str | None:
    return _tips(made) or _sinks(made, ask) or _unstable(made, ask) or _yields(made, ask)


def _no_face(block: Block, wall: Wall) -> str | None:
    """Why a block neither stands on a face nor leans at rest on an edge; None if it does."""
    if spans_a_face(block, wall):
        return None
    count = int(feet(block, wall).sum())
    if count != 2 or not block.free_spin.any():
        return f"block '{block.name}' stands on no face, but on {count} corners"
    if block.velocity.any() or wall.motion is not None:
        return (
            f"block '{block.name}' moves on an edge at t = 0: the force on the edge is not known, "
            "and springs would make the block rebound"
        )
    return None


def _tips(made: Clump) -> str | None:
    """Why the forces on the corners of a block that begins to tip are not known, else None."""
    if made.touching.any():
        return None
    return (
        f"block '{made.block.name}' begins to tip as it slides: the forces on the corners about "
        "which it turns are found for a block at rest only"
    )


def _sinks(made: Clump, ask: Ask) -> str | None:
    """Why springs are too soft for such small spheres, whose centres would pass the wall."""
    (wall,) = ask.scene.walls
    lowest = float(((made.corners - wall.point) @ wall.normal).min())
    if lowest > 0:
        return None
    return (
        f"kn = {ask.knobs.kn:g} N/m lets a corner sink by {made.radius - lowest:.3g} m at t = 0, "
        f"through its sphere of {made.radius:g} m"
    )


def _unstable(made: Clump, ask: Ask) -> str | None:
    """Why the step exceeds the stable one, 2 over the highest frequency on the corner springs.

    A single block that slides on its face tolerates longer steps, since friction limits the
    oscillation; but once it stops, the oscillation sets it in motion again. Among several blocks,
    rounding is enough to start it: within forty steps, blocks that should slide were displaced by
    as much as their whole slide.
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


def _yields(made: Clump, ask: Ask) -> str | None:
    """Why springs would move a block back after friction has stopped it, else None.

    The corners share the stiffness of one contact: they stretch by mu N/ks, ks being the sum.
    """
    kn, block, mu = ask.knobs.kn, made.block, ask.scene.contact.mu
    if kn is None or not _stops(made, ask.scene):
        return None
    pull, press = _pull_and_press(made, ask.scene)
    distance = 0.5 * block.mass * float(block.velocity @ block.velocity) / (mu * press - pull)
    stretch = mu * press / (SHEAR * kn)
    if stretch < MOST_STRETCH * distance:
        return None
    return (
        f"its springs stretch by {stretch:.3g} m, {100 * stretch / distance:.2g} % of the distance "
        f"in which friction stops it; at most {100 * MOST_STRETCH:g} % is allowed"
    )


def _stops(made: Clump, scene: Scene) -> bool:
    """Whether friction stops a block that moves at t = 0 and is not shaken."""
    block, (wall,) = made.block, scene.walls
    if scene.shaking is not None or wall.motion is not None or not block.velocity.any():
        return False
    pull, press = _pull_and_press(made, scene)
    return pull < scene.contact.mu * press


def _pull_and_press(made: Clump, scene: Scene) -> tuple[float, float]:
    """The sizes of the forces on a block along its wall and into it [N]."""
    load = made.block.load + made.block.mass * scene.gravity
    press = -float(load @ made.normal)
    return float(np.linalg.norm(load + press * made.normal)), press


def _turning(arm: Vector) -> Vector:
    """The matrix (3, 3) that takes a small rotation to the displacement of a point at an arm."""
    x, y, z = arm
    return np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])

"""Where no clump can stand for a block, and why: what it stands on, its springs and its step."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from vv.ask import Ask
from vv.scene import Block, Pulse, Scene, Term, Vector, Wall
from vv.standins.clump import Clump, clumps
from vv.standins.corners import feet, spans_a_face
from vv.standins.penalty_springs import found_once
from vv.standins.stand_in import SHEAR, spring_scene, why_no_spring_scene, without_rotations

GIVES = 0.02  # of the way in which a slide stops: what shear springs may stretch by


@found_once
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
    return _tips(made) or _sinks(made, ask) or _hurries(made, ask) or _gives(made, ask)


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


def _gives(made: Clump, ask: Ask) -> str | None:
    """Why springs would swing a block back from where friction stops it.

    Corners share the springs of one contact: they stretch by mu N/ks of that, and not of each.
    """
    kn, block, mu = ask.knobs.kn, made.block, ask.scene.contact.mu
    if kn is None or not _stops(made, ask.scene):
        return None
    pull, press = _drive(made, ask.scene)
    way = 0.5 * block.mass * float(block.velocity @ block.velocity) / (mu * press - pull)
    stretch = mu * press / (SHEAR * kn)
    if stretch < GIVES * way:
        return None
    return (
        f"its springs give by {stretch:.3g} m, {100 * stretch / way:.2g} % of the way in which "
        f"friction stops it; {100 * GIVES:g} % is the most that is run"
    )


def _stops(made: Clump, scene: Scene) -> bool:
    """Whether a block that moves at t = 0 is stopped by friction, where nothing shakes it."""
    block, (wall,) = made.block, scene.walls
    if scene.shaking is not None or wall.motion is not None or not block.velocity.any():
        return False
    pull, press = _drive(made, scene)
    return pull < scene.contact.mu * press


def _drive(made: Clump, scene: Scene) -> tuple[float, float]:
    """What pulls a block along its wall, and presses it on that [N]."""
    load = made.block.load + made.block.mass * scene.gravity
    press = -float(load @ made.normal)
    return float(np.linalg.norm(load + press * made.normal)), press


def _turning(arm: Vector) -> Vector:
    """(3, 3): how a point moves as the body turns, minus the cross product of its arm."""
    x, y, z = arm
    return np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])

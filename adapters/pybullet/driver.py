"""Solves an ask with PyBullet: rigid bodies with impulses, by semi-implicit Euler steps.

The input is what `vv.standins.boxed` writes. A moving wall is at rest here: the frame moves with
it, and inertial forces act on the blocks. Half of all forces act in the first step, which makes
velocities those of half steps, as in a leapfrog.
"""

import math

import numpy as np
import pybullet as bullet

from vv.codes.driver_protocol import Plan, RunError, Sines, Stopwatch, serve, swung

SWEEPS = (200, 1000)  # iterations of the solver at most: for two bodies, and for more
NEAR = 0.2  # relative to a block's size: the distance within which contacts are kept
DRIFT = 1e-3  # relative to a block's size: allowed numerical drift along locks
bullet.connect(bullet.DIRECT)


def simulate(ask: Plan, watched: bool, watch: Stopwatch) -> tuple[object, Plan]:
    """Build the scene and take all steps; values are displacements or velocities (.., time, 3).

    Lengths of the ask are in its `unit` [m].
    """
    bodies = build(ask)
    moving = [body for body in ask["blocks"] if any(body["free"])]
    seen = [(kind, bodies[body]) for kind, body in ask["observe"]]
    values = np.zeros((len(seen), ask["steps"] // ask["stride"] + 1, 3))
    speeds = [row for row, (kind, _) in enumerate(seen) if kind == "velocity"]
    base = Base(ask)
    for row in speeds:
        values[row, 0] = seen[row][1]["velocity"]
    watch.lap("setup")
    push(ask, base, moving, 0.0, 0.5)
    bullet.stepSimulation()
    for step in range(1, ask["steps"] + 1):
        t = step * ask["dt"]
        output = watched and step % ask["stride"] == 0
        if output:
            watch.lap("steps")
            read(ask, seen, values[:, step // ask["stride"]], base, t)
            watch.lap("reading")
        if step < ask["steps"] or speeds:
            push(ask, base, moving, t, 1.0)
            bullet.stepSimulation()
        if output and speeds:
            for row in speeds:  # halfway between the velocities before and after
                values[row, step // ask["stride"]] += 0.5 * velocity(seen[row][1])
    watch.lap("steps")
    return values * ask["unit"], {}


class Base:
    """The motion of the one moving wall, which is the frame of reference of the blocks."""

    def __init__(self, ask: Plan) -> None:
        moving: list[Sines] = [wall["motion"] for wall in ask["walls"] if wall["motion"]]
        self.sines = moving[0] if moving else []
        self.start = np.array(swung(self.sines, 0.0))

    def moved(self, t: float) -> np.ndarray:
        """The displacement (3,) [m] of the wall since t = 0."""
        return np.asarray(np.array(swung(self.sines, t)) - self.start)

    def velocity(self, t: float) -> np.ndarray:
        """The velocity (3,) [m/s] of the wall."""
        return np.array(swung(self.sines, t, 1))


def build(ask: Plan) -> dict[int, Plan]:
    """All bodies by their number, each with its number in PyBullet."""
    bullet.resetSimulation()
    bullet.setPhysicsEngineParameter(
        fixedTimeStep=ask["dt"],
        numSolverIterations=SWEEPS[len(ask["walls"]) + len(ask["blocks"]) > 2],
        numSubSteps=0,
        enableConeFriction=1,
        solverResidualThreshold=0,
        contactSlop=0,
        erp=0,  # the correction of overlaps adds normal forces, and so friction
        contactERP=0,
        contactBreakingThreshold=NEAR * ask["size"],
        deterministicOverlappingPairs=1,
    )
    friction = math.sqrt(ask["mu"])  # that of a contact is the product of both
    base = Base(ask).velocity(0.0)
    for wall in ask["walls"]:
        shape = bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=wall["half"])
        wall["id"] = placed(0.0, shape, wall["centre"], wall["axes"])
        bullet.changeDynamics(wall["id"], -1, lateralFriction=friction, restitution=0)
    for block in ask["blocks"]:
        fixed = not any(block["free"]) and not any(block["free_spin"])
        mass = 0.0 if fixed else block["mass"]
        block["id"] = placed(mass, shape_of(block), block["centre"], block["axes"])
        bullet.changeDynamics(
            block["id"], -1, lateralFriction=friction, restitution=0, linearDamping=0,
            angularDamping=0, rollingFriction=0, spinningFriction=0, collisionMargin=0.0,
        )  # fmt: skip
        if not fixed:
            bullet.changeDynamics(block["id"], -1, localInertiaDiagonal=block["moments"])
            start = np.subtract(block["velocity"], base).tolist()
            bullet.resetBaseVelocity(block["id"], start, block["spin"])
    return {body["body"]: body for body in (*ask["walls"], *ask["blocks"])}


def shape_of(block: Plan) -> int:
    """A box, or else the convex hull of the vertices, relative to the block's own axes."""
    if block["half"]:
        return int(bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=block["half"]))
    vertices = (np.array(block["vertices"]) @ np.array(block["axes"]).T).tolist()
    return int(bullet.createCollisionShape(bullet.GEOM_MESH, vertices=vertices))


def placed(mass: float, shape: int, centre: list[float], axes: list[list[float]]) -> int:
    """A body with its own axes along the rows of `axes`."""
    turn = quaternion(np.array(axes).T)
    return int(bullet.createMultiBody(mass, shape, basePosition=centre, baseOrientation=turn))


def quaternion(turn: np.ndarray) -> list[float]:
    """(x, y, z, w) of a rotation (3, 3), by the largest of its four parts."""
    (a, b, c), (d, e, f), (g, h, i) = turn.tolist()
    rows = np.array([
        [1 + a - e - i, b + d, c + g, h - f],
        [b + d, 1 - a + e - i, f + h, c - g],
        [c + g, f + h, 1 - a - e + i, d - b],
        [h - f, c - g, d - b, 1 + a + e + i],
    ])  # fmt: skip
    row = rows[int(np.argmax(np.diag(rows)))]
    return [float(part) for part in row / np.linalg.norm(row)]


def push(ask: Plan, base: Base, moving: list[Plan], t: float, part: float) -> None:
    """Apply loads and shaking in the step that starts at t; part: the fraction that acts."""
    field = np.add(ask["gravity"], shaken(ask, t)) - swung(base.sines, t, 2)
    field = np.where(ask["driven"], field, 0.0) * part
    bullet.setGravity(*field.tolist())
    for block in moving:
        if any(block["load"]):
            place = bullet.getBasePositionAndOrientation(block["id"])[0]
            force = (np.array(block["load"]) * part).tolist()
            bullet.applyExternalForce(block["id"], -1, force, place, bullet.WORLD_FRAME)


def shaken(ask: Plan, t: float) -> np.ndarray:
    """The shaking acceleration (3,) [m/s2]; half of it in the step in which it ends."""
    left = 1.0 if ask["until"] is None else (ask["until"] - t) / ask["dt"] + 0.5
    return np.array(swung(ask["shaking"], t)) * min(1.0, max(0.0, left))


def velocity(body: Plan) -> np.ndarray:
    """The velocity of a body, half a step after the last requested position."""
    return np.array(bullet.getBaseVelocity(body["id"])[0])


def read(ask: Plan, seen: list[tuple[str, Plan]], row: np.ndarray, base: Base, t: float) -> None:
    """Read displacements and half of the velocities before t; reject blocks that left a lock."""
    for number, (kind, body) in enumerate(seen):
        if kind == "velocity":
            row[number] = base.velocity(t) + 0.5 * velocity(body)
            continue
        place = bullet.getBasePositionAndOrientation(body["id"])[0]
        row[number] = np.subtract(place, body["centre"])
        away = np.abs(np.where(body["free"], 0.0, row[number])).max()
        if away > DRIFT * ask["size"]:
            reason = (
                f"body {body['body']} moved {away * ask['unit']:.3g} m along a locked direction"
            )
            raise RunError("error", f"{reason}, which PyBullet leaves free")
        row[number] += base.moved(t)


if __name__ == "__main__":
    serve(simulate)

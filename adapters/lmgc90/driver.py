"""Solves an ask with LMGC90: polyhedra in contact dynamics, stepped by its theta method.

The input is what `vv.standins.boxed` writes. LMGC90 takes no velocities at t = 0: a moving body
gets them from a force during the first step, and starts displaced by v dt/2, which the first step
of a body at rest lacks. Forces in a step are the mean of those at its ends. LMGC90 does not report
velocities either: they follow from x+ - x = dt (v+ + v)/2, step by step.
"""

import math

import compas_lmgc90._lmgc90 as lmgc90
import numpy as np

from vv.codes.driver_protocol import Plan, RunError, Stopwatch, serve, swung

THETA = 0.5
ALERT = 1e-2  # relative to a block's size: contacts are searched within this distance
GIVEN = np.array([0.0, 0.0, -9.81])  # m/s2: its gravity, for which there is no setter
DRIFT = 1e-3  # relative to a block's size: allowed numerical drift along locks
FARTHEST = 0.25  # of a block's size: farthest path of one that can rotate; at 0.29 its error is 2 %
AXES = range(3)
STILL = [0.0] * 6


def simulate(ask: Plan, watched: bool, watch: Stopwatch) -> tuple[object, Plan]:
    """Build the scene and take all steps; values are displacements or velocities (.., time, 3)."""
    solver, bodies = build(ask)
    state = solver.get_initial_state()
    place = np.array(state.init_bodies)[:, :3]
    start, speed = place - [body["ahead"] for body in bodies], np.zeros_like(place)
    rows = {body["body"]: row for row, body in enumerate(bodies)}
    seen = [(kind == "velocity", rows[body]) for kind, body in ask["observe"]]
    values = np.zeros((len(seen), ask["steps"] // ask["stride"] + 1, 3))
    follows = watched and any(fast for fast, _ in seen)
    for number, (fast, row) in enumerate(seen):
        values[number, 0] = bodies[row]["velocity"] if fast else 0.0
    watch.lap("setup")
    for column in range(1, values.shape[1]):
        for _ in range(ask["stride"]):
            state = solver.compute_one_step()
            if follows:
                watch.lap("steps")
                before, place = place, np.array(state.bodies)[:, :3]
                speed = 2 * (place - before) / ask["dt"] - speed
                watch.lap("reading")
        watch.lap("steps")
        if watched:
            moved = np.array(state.bodies)[:, :3] - start
            for number, (fast, row) in enumerate(seen):
                values[number, column] = speed[row] if fast else moved[row]
            check(ask, bodies, moved)
            watch.lap("reading")
    return values, {}


def build(ask: Plan) -> tuple[lmgc90.LMGC90Solver, list[Plan]]:
    """The solver with all bodies, walls first, and the data of each."""
    solver = lmgc90.LMGC90Solver()
    solver.initialize(ask["dt"], THETA, False)
    solver.add_one_tact_behav("iqsc0", "IQS_CLB", [ask["mu"]])
    solver.set_materials([ask["density"]])
    solver.set_see_tables(ALERT * ask["size"])
    walls = [wall_drives(ask, wall) for wall in ask["walls"]]
    bodies = [*walls, *(block_drives(ask, block) for block in ask["blocks"])]
    solver.set_nb_bodies(len(bodies))
    for number, body in enumerate(bodies, 1):
        place = np.add(body["centre"], body["ahead"]).tolist()
        faces = [corner + 1 for face in body["faces"] for corner in triangles(face)]
        vertices = np.ravel(body["vertices"]).tolist()
        kept, pushed = body["velocities"], body["forces"]
        solver.set_one_polyr("s0001", place, faces, vertices, len(kept), len(pushed))
        for drives, is_velocity in ((kept, True), (pushed, False)):
            for freedom, values in drives.items():
                tabled = values[4:] != [1.0, 0.0] and values != STILL
                solver.set_drvdof(number, freedom, values, is_velocity, tabled)
    solver.close_before_computing()
    return solver, bodies


def triangles(face: list[int]) -> list[int]:
    """The corners of the triangles into which a face is divided, one after the other."""
    return [k for i in range(1, len(face) - 1) for k in (face[0], face[i], face[i + 1])]


def wall_drives(ask: Plan, wall: Plan) -> Plan:
    """A wall with its velocity in all six degrees of freedom; it starts from rest, displaced."""
    velocity = np.array(swung(wall["motion"], 0.0, 1))
    velocities = {
        axis + 1: drive(ask, 0.0, [(a[axis] * w, w, p + math.pi / 2) for a, w, p in wall["motion"]])
        for axis in AXES
    }
    velocities.update(dict.fromkeys((4, 5, 6), STILL))
    ahead = velocity * ask["dt"] / 2
    return {**wall, "velocities": velocities, "forces": {}, "ahead": ahead, "velocity": velocity}


def block_drives(ask: Plan, block: Plan) -> Plan:
    """A block with zero velocities where it is locked, and forces elsewhere.

    Locks that the ask does not list as held are omitted, because with locks LMGC90 takes four times
    as long and solves contacts less accurately; `check` monitors the directions that are left free.
    Locks of only some rotations are omitted too.
    """
    mass, velocity = block["mass"], np.array(block["velocity"])
    held = [not free and needs for free, needs in zip(block["free"], ask["held"], strict=True)]
    velocities = {axis + 1: STILL for axis in AXES if held[axis]}
    if not any(block["free_spin"]):
        velocities.update(dict.fromkeys((4, 5, 6), STILL))
    steady = mass * (np.array(ask["gravity"]) - GIVEN) + block["load"]
    impulse = mass * velocity / (1 - THETA)
    forces = {
        axis + 1: drive(
            ask,
            float(steady[axis]),
            [(mass * a[axis], w, phase) for a, w, phase in ask["shaking"]],
            float(impulse[axis]),
            ask["until"],
        )
        for axis in AXES
        if not held[axis]
    }
    return {**block, "velocities": velocities, "forces": forces, "ahead": velocity * ask["dt"] / 2}


def drive(
    ask: Plan,
    steady: float,
    sines: list[tuple[float, float, float]],
    impulse: float = 0.0,
    until: float | None = None,
) -> list[float]:
    """steady + sum of A sin(w t + phase), and an impulse in the first step, as LMGC90 reads it.

    until: the end of the sines [s], if any; their values are halved for half a step about that
    time. A steady value plus one cosine is given as six numbers, anything else as a table of times
    and values, which LMGC90 interpolates. It searches the table from its beginning, so tables are
    kept short.
    """
    sines = [sine for sine in sines if sine[0]]
    if not impulse and len(sines) < 2 and (until is None or not sines):
        a, omega, phase = sines[0] if sines else (0.0, 0.0, 0.0)
        return [steady, a, omega, phase - math.pi / 2, 1.0, 0.0]
    times = ask["dt"] * np.arange(ask["steps"] + 2)
    times = times if sines else times[[0, 1, -1]]
    swings = sum((a * np.sin(w * times + p) for a, w, p in sines), np.zeros(len(times)))
    left = 1.0 if until is None else np.clip((until - times) / ask["dt"] + 0.5, 0.0, 1.0)
    values = steady + left * swings
    values[0] += impulse / ask["dt"]
    return [*times.tolist(), *values.tolist()]


def check(ask: Plan, bodies: list[Plan], moved: np.ndarray) -> None:
    """Reject a run in which a block left its lock or its initial contact points."""
    for body, way in zip(bodies, moved, strict=True):
        away = np.abs(np.where(body.get("free", True), 0.0, way)).max()
        if away > DRIFT * ask["size"] and any(body.get("free", ())):
            reason = f"block '{body['name']}' moved {away:.3g} m along a locked direction"
            raise RunError("error", f"{reason}, which LMGC90 does not lock")
        if ask["walls"] and any(body.get("free_spin", ())):
            slid = float(np.linalg.norm(way - moved[0]))
            if slid > FARTHEST * ask["size"]:
                raise RunError(
                    "refused",
                    f"block '{body['name']}' can rotate and moved by more than a quarter of its "
                    "size, away from the initial contact points, at which LMGC90 detects contacts",
                )


if __name__ == "__main__":
    serve(simulate)

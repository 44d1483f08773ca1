"""Solves asks with YADE: build the scene, step it, read it; nothing here knows the project.

It runs in the system's own python3, for which YADE is built: as `python3 driver.py ask.json ...`,
where answers go to ask.json.npy and, as the last act, ask.json.answer; or alone, as a script in
which ASK is filled in.

An ask says, in SI units: dt; steps, and stride: how many of them lie between two outputs; kn, ks,
mu of every contact; gravity; drag, the coefficient of -drag v; observe, pairs of quantity and body;
contacts, how many overlap at the start; moves, whether something must move; bodies, in the order
of YADE's ids; shaking, the sines A sin(2 pi f t + fi) of a body acceleration; charged, the
friction with which a wall holds a sphere at the start; volumes: whether polyhedra overlap by
volumes, for which kn is a stiffness per area. A sphere has position, velocity (half a
step before t = 0), spin, mass, inertia, the mass that is shaken, blocked freedoms, a dead force,
and push and twist: a force and a torque during the first step. A wall's motion holds sines as
YADE's HarmonicMotionEngine takes them.
"""

import contextlib
import glob
import json
import math
import os
import sys
import time
from typing import Any

import numpy as np

os.environ.setdefault("OMP_NUM_THREADS", "1")  # read when YADE is imported
FOLDER = os.environ.get("VV_YADE") or next(iter(glob.glob("/usr/lib/*/yade-double/py")), "")
WITHIN_YADE = "yade" in sys.modules  # started by `yade script.py`
if FOLDER and not WITHIN_YADE:
    sys.path.insert(0, FOLDER)
import yade  # noqa: E402
from yade import utils  # noqa: E402
from yade import wrapper as yd  # noqa: E402

ASK: dict[str, Any] | None = None

O = yade.O  # noqa: E741  # the name every YADE script uses


class RunError(Exception):
    """A run that must not count: its status and why."""

    def __init__(self, status: str, reason: str) -> None:
        super().__init__(reason)
        self.status = status


def build(ask: dict[str, Any]) -> None:
    """Set up the scene: bodies, contact law, engines, time step."""
    O.reset()
    O.materials.append(material(ask))
    for body in ask["bodies"]:
        body["id"] = SHAPES[body["kind"]](body)
        if "mass" in body:
            O.forces.setPermF(body["id"], np.add(body["force"], body["push"]))
            O.forces.setPermT(body["id"], body["twist"])
    O.engines = engines(ask, {TOUCHED.get(body["kind"], body["kind"]) for body in ask["bodies"]})
    O.dt = ask["dt"]
    for held in ask["charged"]:
        body = ask["bodies"][held["body"]]
        for number, force in zip(body.get("feet", [body["id"]]), held["forces"], strict=True):
            charge(ask["bodies"][held["wall"]]["id"], number, force)


def material(ask: dict[str, Any]) -> Any:
    """The stuff of all bodies; polyhedra take two like stiffnesses in series, young and poisson."""
    angle = math.atan(ask["mu"])
    if not ask["volumes"]:
        return yd.FrictMat(frictionAngle=angle)
    made = yd.PolyhedraMat(frictionAngle=angle)
    made.young, made.poisson = 2 * ask["kn"], ask["ks"] / ask["kn"]
    return made


def sphere(body: dict[str, Any]) -> int:
    """Append a sphere with the given mass and inertia in place of those of its volume."""
    made = utils.sphere(body["position"], body["radius"])
    start(made.state, body, [body["inertia"]] * 3)
    return int(O.bodies.append(made))


def clump(body: dict[str, Any]) -> int:
    """Append a rigid body of spheres: those that touch walls, and points that touch nothing."""
    parts = [(part, 1) for part in body["touching"]] + [(part, 0) for part in body["points"]]
    members = []
    for part, mask in parts:
        stuff = yd.FrictMat(density=part["density"], frictionAngle=O.materials[0].frictionAngle)
        members.append(utils.sphere(part["position"], part["radius"], material=stuff, mask=mask))
    number, numbers = O.bodies.appendClumped(members)
    body["feet"] = numbers[: len(body["touching"])]
    start(O.bodies[number].state, body, body["inertia"])
    return int(number)


def polyhedron(body: dict[str, Any]) -> int:
    """Append a convex polyhedron with its corners about its centroid."""
    from yade import polyhedra_utils  # slow, and rarely needed

    made = polyhedra_utils.polyhedra(O.materials[0], v=body["vertices"])
    made.state.pos = made.state.refPos = body["position"]
    start(made.state, body, made.state.inertia)
    return int(O.bodies.append(made))


def start(state: Any, body: dict[str, Any], inertia: list[float]) -> None:
    """Give a body its mass, its motion and its locks."""
    state.mass, state.inertia = body["mass"], inertia
    state.vel, state.angVel = body["velocity"], body["spin"]
    state.blockedDOFs = body["blocked"]


def wall(body: dict[str, Any]) -> int:
    """Append an infinite wall across an axis, acting on its normal's side."""
    axis = int(np.argmax(np.abs(body["normal"])))
    sense = 1 if body["normal"][axis] > 0 else -1
    return int(O.bodies.append(utils.wall(body["point"], axis, sense=sense)))


def facet(body: dict[str, Any]) -> int:
    """Append a triangle about a point of an oblique wall, far larger than the scene.

    It is put in place after it was made, which keeps the point free of the corners' rounding.
    """
    made = utils.facet(body["corners"])
    made.state.pos = made.state.refPos = body["point"]
    return int(O.bodies.append(made))


TOUCHED = {"clump": "sphere"}  # the shape that collides, where it is another
SHAPES = {"sphere": sphere, "clump": clump, "polyhedron": polyhedron, "wall": wall, "facet": facet}


def charge(wall: int, sphere: int, force: list[float]) -> None:
    """Make a contact before the first step, its shear spring charged to push the sphere so."""
    contact = utils.createInteraction(wall, sphere)
    contact.phys.shearForce = force if contact.id2 == sphere else [-part for part in force]


def engines(ask: dict[str, Any], kinds: set[str]) -> list[Any]:
    """What YADE does in a step: contacts, drag and motion, and nothing the scene lacks."""
    return [
        yd.ForceResetter(),
        *(overlaps() if ask["volumes"] else contacts(ask, sorted(kinds))),
        *drag(ask),
        *shaking(ask),
        *motion(ask),
        yd.NewtonIntegrator(damping=0, gravity=ask["gravity"]),
    ]


def contacts(ask: dict[str, Any], kinds: list[str]) -> list[Any]:
    """Finds contacts of spheres and presses and shears them by linear springs."""
    bounds = {"sphere": yd.Bo1_Sphere_Aabb, "wall": yd.Bo1_Wall_Aabb, "facet": yd.Bo1_Facet_Aabb}
    geometry = {
        "sphere": lambda: yd.Ig2_Sphere_Sphere_ScGeom(avoidGranularRatcheting=False),
        "wall": lambda: yd.Ig2_Wall_Sphere_ScGeom(noRatch=False),
        "facet": yd.Ig2_Facet_Sphere_ScGeom,
    }
    stiffness = yd.Ip2_FrictMat_FrictMat_FrictPhys(
        kn=yd.MatchMaker(algo="val", val=ask["kn"]), ks=yd.MatchMaker(algo="val", val=ask["ks"])
    )
    law = yd.Law2_ScGeom_FrictPhys_CundallStrack()
    return [
        yd.InsertionSortCollider([bounds[kind]() for kind in kinds]),
        yd.InteractionLoop([geometry[kind]() for kind in kinds], [stiffness], [law]),
    ]


def overlaps() -> list[Any]:
    """Finds polyhedra that overlap walls and presses them by the volume of the overlap."""
    return [
        yd.InsertionSortCollider([yd.Bo1_Polyhedra_Aabb(), yd.Bo1_Wall_Aabb()], verletDist=0.05),
        yd.InteractionLoop(
            [yd.Ig2_Wall_Polyhedra_PolyhedraGeom()],
            [yd.Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
            [yd.Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()],
        ),
    ]


def drag(ask: dict[str, Any]) -> list[Any]:
    """Stokes' drag 6 pi nu R v = drag v: an engine for each radius among the moving spheres."""
    return [
        yd.LinearDragEngine(nu=ask["drag"] / (6 * math.pi * radius), ids=ids)
        for radius, ids in moving(ask, "radius").items()
        if ask["drag"]
    ]


def shaking(ask: dict[str, Any]) -> list[Any]:
    """A force m A sin(2 pi f t + fi) at the time of the positions: an engine for each sine."""
    return [
        yd.HarmonicForceEngine(
            A=[mass * part for part in sine["A"]], f=[sine["f"]] * 3, fi=[sine["fi"]] * 3, ids=ids
        )
        for sine in ask["shaking"]
        for mass, ids in moving(ask, "shaken").items()
    ]


def moving(ask: dict[str, Any], name: str) -> dict[float, list[int]]:
    """The numbers of the spheres that may move, by a property of theirs."""
    alike: dict[float, list[int]] = {}
    for body in ask["bodies"]:
        if "mass" in body and not set("xyz") <= set(body["blocked"]):
            alike.setdefault(body[name], []).append(body["id"])
    return alike


def motion(ask: dict[str, Any]) -> list[Any]:
    """What sets the velocities of moving walls for the step to come, after contacts used them."""
    engines = []
    for body in ask["bodies"]:
        sines = [
            yd.HarmonicMotionEngine(A=sine["A"], f=[sine["f"]] * 3, fi=[sine["fi"]] * 3)
            for sine in body.get("motion", ())
        ]
        if sines:
            engines.append(yd.CombinedKinematicEngine(comb=sines, ids=[body["id"]]))
    return engines


def first_step(ask: dict[str, Any]) -> None:
    """Take one step and end the forces that act during the first step alone."""
    O.step()
    for body in ask["bodies"]:
        if any(body.get("push", ())) or any(body.get("twist", ())):
            O.forces.setPermF(body["id"], body["force"])
            O.forces.setPermT(body["id"], (0, 0, 0))


def bare(ask: dict[str, Any]) -> tuple[float, float]:
    """Take all steps and look at nothing; CPU and wall seconds of the stepping."""
    wall_start, cpu_start = time.perf_counter(), time.process_time()
    first_step(ask)
    step = O.step
    for _ in range(ask["steps"] - 1):
        step()
    return time.process_time() - cpu_start, time.perf_counter() - wall_start


def watched(ask: dict[str, Any]) -> tuple[np.ndarray, float, float, float]:
    """Take all steps and read the observables; also CPU and wall seconds of steps, and reading.

    After n steps YADE holds positions at n dt and velocities half a step earlier: a velocity is
    the mean of this one and the next, for which one step more is taken.
    """
    kinds = [kind for kind, _ in ask["observe"]]
    states = [O.bodies[ask["bodies"][number]["id"]].state for _, number in ask["observe"]]
    values = np.zeros((len(states), ask["steps"] // ask["stride"] + 1, 3))
    origin = [tuple(state.pos) for state in states]
    for k, (kind, number) in enumerate(ask["observe"]):
        values[k, 0] = ask["bodies"][number]["initial"] if kind == "velocity" else 0.0
    step, clock, reading = O.step, time.process_time, 0.0
    wall_start, cpu_start = time.perf_counter(), clock()
    first_step(ask)
    done, reading = 1, reading + timed(clock, check_contacts, ask)
    for row in range(1, values.shape[1]):
        for _ in range(row * ask["stride"] - done):
            step()
        done = row * ask["stride"]
        reading += timed(clock, read, kinds, states, origin, values[:, row])
        if "velocity" in kinds:
            step()
            done += 1
            reading += timed(clock, centre, kinds, states, values[:, row])
    cpu, whole = clock() - cpu_start, time.perf_counter() - wall_start
    return values, cpu - reading, whole - reading, reading


def timed(clock: Any, work: Any, *given: Any) -> float:
    """CPU seconds that a piece of work took."""
    start = clock()
    work(*given)
    return float(clock() - start)


def read(kinds: list[str], states: list[Any], origin: list[Any], row: np.ndarray) -> None:
    """Read displacements, and velocities half a step early; refuse what is not finite."""
    for k, state in enumerate(states):
        vector = state.vel if kinds[k] == "velocity" else state.pos
        start = (0.0, 0.0, 0.0) if kinds[k] == "velocity" else origin[k]
        row[k] = vector[0] - start[0], vector[1] - start[1], vector[2] - start[2]
        if not math.isfinite(row[k, 0] + row[k, 1] + row[k, 2]):
            raise RunError("diverged", f"{kinds[k]} not finite at t = {O.iter * O.dt:.6g} s")


def centre(kinds: list[str], states: list[Any], row: np.ndarray) -> None:
    """Make velocities read half a step early the mean of these and the present ones."""
    for k, state in enumerate(states):
        if kinds[k] == "velocity":
            row[k] = (row[k] + np.array(state.vel)) / 2


def check_contacts(ask: dict[str, Any]) -> None:
    """Refuse a run in which YADE missed a contact that overlaps at the start."""
    seen = O.interactions.countReal()
    if seen < ask["contacts"]:
        raise RunError("error", f"YADE found {seen} of {ask['contacts']} contacts at the start")


def check_end(ask: dict[str, Any]) -> None:
    """Refuse a run that is not finite, where nothing moved, or a sphere went through a wall."""
    states = [O.bodies[body["id"]].state for body in ask["bodies"]]
    spheres = [i for i, body in enumerate(ask["bodies"]) if "mass" in body]
    place = np.array([tuple(states[i].pos) for i in spheres])
    if not np.isfinite(place).all():
        raise RunError("diverged", f"a position is not finite after {O.iter} steps")
    if ask["moves"] and (place == [ask["bodies"][i]["position"] for i in spheres]).all():
        raise RunError("error", f"nothing moved in {O.iter} steps, yet velocities were given")
    for number, body in enumerate(ask["bodies"]):
        if "mass" not in body:
            height = (place - states[number].pos) @ np.array(body["normal"])
            if height.min() <= 0:
                through = spheres[int(height.argmin())]
                raise RunError("diverged", f"the centre of body {through} went through a wall")


def unknowns() -> int:
    """How many freedoms YADE integrates."""
    return sum(6 - len(body.state.blockedDOFs) for body in O.bodies if not body.isClumpMember)


def solve(ask: dict[str, Any], repeat: float = 0.0) -> tuple[np.ndarray, dict[str, Any]]:
    """Observables (quantity, time, 3) of one ask, and what it cost and was made of.

    repeat: set-up and bare steps are done again until the steps alone took that many CPU
    seconds, at least three times, and the least is reported; steps that took twice that while they
    were watched, whose readings are not counted, are not done again.
    """
    setups = [timed(time.process_time, build, ask)]
    values, cpu, whole, reading = watched(ask)
    check_end(ask)
    made = {"steps": O.iter, "unknowns": unknowns(), "output": reading}
    solves = [(cpu, whole)] if cpu > 2 * repeat else []
    fewest = 1 if solves else 3
    while len(solves) < fewest or sum(cpu for cpu, _ in solves) < repeat:
        setups.append(timed(time.process_time, build, ask))
        solves.append(bare(ask))
    least, most = min(solves), max(solves)
    cost = {"setup": min(setups), "solve_cpu": least[0], "solve_wall": least[1]}
    more = {"repeats": len(solves), "spread": most[0] / least[0] - 1}
    return values, {"status": "ran", "reason": "", **made, **cost, **more}


def answer(path: str, ready: float) -> None:
    """Solve the ask in a file and put the answer beside it, whole or not at all."""
    with open(path) as file:
        ask = json.load(file)
    try:
        values, facts = solve(ask, ask["repeat"])
    except RunError as trouble:
        values, facts = np.zeros(0), {"status": trouble.status, "reason": str(trouble)}
    except Exception as error:
        values = np.zeros(0)
        facts = {"status": "error", "reason": f"{type(error).__name__}: {error}"}
    values_file, facts_file = path + ".npy", path + ".answer"
    facts["output"] = facts.get("output", 0.0) + timed(
        time.perf_counter, np.save, values_file, values
    )
    facts.update(ready=ready, version=yade.config.version)
    with open(facts_file + ".half", "w") as file:
        json.dump(facts, file)
    os.replace(facts_file + ".half", facts_file)


def main() -> None:
    """Solve the ask written in, and print it as a table; or else those in the files named."""
    if not WITHIN_YADE:
        with contextlib.suppress(OSError):  # YADE makes this folder in /tmp, and leaves it there
            os.rmdir(os.path.dirname(O.tmpFilename()))
    if ASK is None:
        ready = time.monotonic()
        for path in sys.argv[1:]:
            answer(path, ready)
            ready = 0.0
        return
    values, facts = solve(ASK)
    print(facts)
    for number, (kind, body) in enumerate(ASK["observe"]):
        print(f"# t [s], {kind} of body {body}: x, y, z [SI]")
        for row, vector in enumerate(values[number]):
            moment = row * ASK["stride"] * ASK["dt"]
            print(" ".join(f"{number:.17g}" for number in (moment, *vector)))


if __name__ == "__main__":
    main()

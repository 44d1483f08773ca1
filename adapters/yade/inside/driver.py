"""Solves asks with YADE: builds the scene, takes the steps, reads the results; independent of vv.

It runs in the system's own python3, for which YADE is built, as one script made of the files in
this folder. As `python3 script.py` it reads names of files from its standard input, each of which
lists asks; the answer to ask.json goes to ask.json.npy and, at the very end, ask.json.answer.
Alternatively it runs alone, as a script in which ASK is filled in.

The fields of an ask, in SI units: dt; steps; stride: how many steps lie between two outputs; kn,
ks, mu and eta_n of every contact; hertz: the elastic material of spheres and walls, or empty;
gravity; drag: the coefficient of -drag v; observe: pairs of quantity and body; contacts: how many
overlap at the start; moves: whether a body must move; bodies, in the order of YADE's ids; shaking:
the sines A sin(2 pi f t + fi) of a body acceleration; charged: the friction of a wall on a sphere
at the start; volumes: whether polyhedra overlap by volumes, for which kn is a stiffness per area;
bonds.

The fields of a sphere: position, velocity (half a step before t = 0), spin, mass, inertia, the mass
that is shaken, blocked freedoms, a constant force, push and twist: a force and a torque during the
first step, carried: its steady velocity where it is blocked, and held: the part of that in the
first step. The motion of a wall is given as sines for YADE's HarmonicMotionEngine. A bond has two
bodies, kn, ks, the overlap of its spheres at which its force is zero, and strengths in tension and
shear [N].
"""

import contextlib
import json
import math
import os
import sys
import time
from typing import Any

import numpy as np

from adapters.yade.inside.bodies import SHAPES, TOUCHED, charge
from adapters.yade.inside.bonds import tie
from adapters.yade.inside.engines import engines
from adapters.yade.inside.session import WITHIN_YADE, O, RunError, timed, yade, yd
from adapters.yade.inside.stepping import bare, check_end, unknowns, watched

ASK: dict[str, Any] | None = None


def build(ask: dict[str, Any]) -> None:
    """Set up the scene: bodies, contact law, engines, time step."""
    O.reset()
    if ask["hertz"]:
        O.materials.append(
            [elastic_material(ask, "walls_young"), elastic_material(ask, "facets_young")]
        )
    O.materials.append(material(ask))
    for body in ask["bodies"]:
        body["id"] = SHAPES[body["kind"]](body)
        if "mass" in body:
            force = np.add(body["force"], body["push"])
            if force.any() or any(body["twist"]):  # a call costs more with more bodies
                O.forces.setPermF(body["id"], force)
                O.forces.setPermT(body["id"], body["twist"])
    O.engines = engines(ask, {TOUCHED.get(body["kind"], body["kind"]) for body in ask["bodies"]})
    O.dt = ask["dt"]
    for held in ask["charged"]:
        body = ask["bodies"][held["body"]]
        for number, force in zip(body.get("feet", [body["id"]]), held["forces"], strict=True):
            if any(force):  # a foot that is off the wall has no contact
                charge(ask["bodies"][held["wall"]]["id"], number, force)
    if ask["bonds"]:
        tie(ask)


def material(ask: dict[str, Any]) -> Any:
    """The material of all bodies.

    For polyhedra, young and poisson act as two equal stiffnesses in series; the same holds for
    viscous contacts.
    """
    angle = math.atan(ask["mu"])
    if ask["hertz"]:
        return elastic_material(ask, "young")
    if ask["eta_n"]:
        kn, ks, cn = (2 * ask[name] for name in ("kn", "ks", "eta_n"))
        return yd.ViscElMat(kn=kn, cn=cn, ks=ks, cs=0, frictionAngle=angle)
    if not ask["volumes"]:
        return yd.FrictMat(frictionAngle=angle)
    made = yd.PolyhedraMat(frictionAngle=angle)
    made.young, made.poisson = 2 * ask["kn"], ask["ks"] / ask["kn"]
    return made


def elastic_material(ask: dict[str, Any], young: str) -> Any:
    """The elastic material of spheres or walls, whose Young's modulus has the given name."""
    made = yd.FrictMat(frictionAngle=math.atan(ask["mu"]))
    made.young, made.poisson = ask["hertz"][young], ask["hertz"]["poisson"]
    return made


def solve(ask: dict[str, Any], repeat: float = 0.0) -> tuple[np.ndarray, dict[str, Any]]:
    """The observables (quantity, time, 3) of one ask, with its cost and the size of its model.

    repeat: set-up and steps without readings are repeated until the steps took so many CPU seconds,
    at least three times; the minimum is reported. If the steps with readings took twice as long,
    they are not repeated, and the time of the readings is subtracted.
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
    spread = most[0] / least[0] - 1 if least[0] > 0 else 0.0  # 0 if less than a clock tick
    more = {"repeats": len(solves), "spread": spread}
    return values, {"status": "ran", "reason": "", **made, **cost, **more}


def answer(path: str, ready: float) -> None:
    """Solve the ask in a file, and write the answer beside it, complete or not at all."""
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
    """Solve the ask that is filled in, and print it as a table; or else those that are listed."""
    if not WITHIN_YADE:
        with contextlib.suppress(OSError):  # YADE leaves this folder in /tmp
            os.rmdir(os.path.dirname(O.tmpFilename()))
    if ASK is None:
        ready = time.monotonic()
        for line in sys.stdin:
            with open(line.strip("\n")) as listed:
                asks = listed.read().splitlines()
            for path in asks:
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

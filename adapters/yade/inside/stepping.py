"""Takes the steps of a run, reads the observables, and rejects runs that must not count."""

import math
import time
from typing import Any

import numpy as np

from adapters.yade.inside.session import O, RunError, timed

LATER = {"velocity", "reaction"}  # known only one step later


def first_step(ask: dict[str, Any]) -> None:
    """Take one step, end the forces of that step alone, and start steady velocities.

    Bodies that were at rest in it, so that shear is in phase, are then moved by what they missed.
    """
    O.step()
    for body in ask["bodies"]:
        if any(body.get("push", ())) or any(body.get("twist", ())):
            O.forces.setPermF(body["id"], body["force"])
            O.forces.setPermT(body["id"], (0, 0, 0))
        missing = np.subtract(body.get("carried", 0.0), body.get("held", 0.0))
        if missing.any():
            state = O.bodies[body["id"]].state
            state.vel, state.pos = state.vel + missing, state.pos + missing * ask["dt"]


def bare(ask: dict[str, Any]) -> tuple[float, float]:
    """Take all steps without observables; return CPU and wall seconds of the stepping."""
    wall_start, cpu_start = time.perf_counter(), time.process_time()
    first_step(ask)
    step = O.step
    for _ in range(ask["steps"] - 1):
        step()
    return time.process_time() - cpu_start, time.perf_counter() - wall_start


def watched(ask: dict[str, Any]) -> tuple[np.ndarray, float, float, float]:
    """Take all steps and read the observables; also return CPU and wall seconds of both.

    After n steps YADE has positions at n dt, velocities half a step earlier, and forces a step
    earlier. A velocity is the mean of this one and the next; so one more step is taken for
    velocities and forces.
    """
    seen = [(kind, ask["bodies"][number]) for kind, number in ask["observe"]]
    for _, body in seen:
        body["origin"] = tuple(O.bodies[body["id"]].state.pos)
    more = any(kind in LATER for kind, _ in seen)
    values = np.zeros((len(seen), ask["steps"] // ask["stride"] + 1, 3))
    step, clock, reading = O.step, time.process_time, 0.0
    wall_start, cpu_start = time.perf_counter(), clock()
    first_step(ask)
    done, reading = 1, reading + timed(clock, check_contacts, ask)
    reading += timed(clock, read_first, ask, seen, values[:, 0])
    for row in range(1, values.shape[1]):
        for _ in range(row * ask["stride"] - done):
            step()
        done = row * ask["stride"]
        reading += timed(clock, read, seen, values[:, row])
        if more:
            step()
            done += 1
            reading += timed(clock, read_later, ask, seen, values[:, row])
    cpu, whole = clock() - cpu_start, time.perf_counter() - wall_start
    return values, cpu - reading, whole - reading, reading


Observed = list[tuple[str, dict[str, Any]]]  # quantities with their bodies


def read_first(ask: dict[str, Any], seen: Observed, row: np.ndarray) -> None:
    """Read the observables at t = 0, without the special forces of the first step."""
    for k, (kind, body) in enumerate(seen):
        row[k] = body["initial"] if kind == "velocity" else 0.0
        if kind == "reaction":
            late = np.subtract(body["carried"], body["held"]) * ask["drag"]
            row[k] = locked(body, np.add(reaction(ask, body), body["push"]) + late)


def read(seen: Observed, row: np.ndarray) -> None:
    """Read displacements, and velocities half a step early; reject values that are not finite."""
    for k, (kind, body) in enumerate(seen):
        if kind != "reaction":
            state = O.bodies[body["id"]].state
            row[k] = vector = list(state.vel) if kind == "velocity" else way(state, body)
            check_finite(kind, vector)


def read_later(ask: dict[str, Any], seen: Observed, row: np.ndarray) -> None:
    """Complete velocities to the mean of half a step early and late, and read reactions."""
    for k, (kind, body) in enumerate(seen):
        if kind == "velocity":
            vel = O.bodies[body["id"]].state.vel
            row[k] = [(early + late) / 2 for early, late in zip(row[k].tolist(), vel, strict=True)]
        elif kind == "reaction":
            row[k] = vector = locked(body, reaction(ask, body))
            check_finite(kind, vector)


# Plain numbers from here on: arrays so short would take as long as the steps between outputs.
def way(state: Any, body: dict[str, Any]) -> list[float]:
    """The distance of a body from its initial position."""
    return [now - first for now, first in zip(state.pos, body["origin"], strict=True)]


def check_finite(kind: str, vector: list[float]) -> None:
    """Reject a run whose observables are not finite."""
    if not math.isfinite(vector[0] + vector[1] + vector[2]):
        raise RunError("diverged", f"{kind} not finite at t = {O.iter * O.dt:.6g} s")


def reaction(ask: dict[str, Any], body: dict[str, Any]) -> list[float]:
    """The force [N] that would keep a body's velocity, opposite to all forces of the last step."""
    mass, gravity = body["mass"], ask["gravity"]
    return [-force - mass * g for force, g in zip(O.forces.f(body["id"]), gravity, strict=True)]


def locked(body: dict[str, Any], force: Any) -> list[float]:
    """The part of a force along the axes in which a body is blocked."""
    along = zip("xyz", force, strict=True)
    return [part if axis in body["blocked"] else 0.0 for axis, part in along]


def check_contacts(ask: dict[str, Any]) -> None:
    """Reject a run in which YADE missed a contact that overlaps at the start."""
    seen = O.interactions.countReal()
    if seen < ask["contacts"]:
        raise RunError("error", f"YADE found {seen} of {ask['contacts']} contacts at the start")


def check_end(ask: dict[str, Any]) -> None:
    """Reject a run that is not finite, in which nothing moved, or a sphere went through a wall."""
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
    """The number of degrees of freedom that YADE integrates."""
    return sum(6 - len(body.state.blockedDOFs) for body in O.bodies if not body.isClumpMember)

"""Takes the steps of a run, reads what is observed, and refuses a run that must not count."""

import math
import time
from typing import Any

import numpy as np

from adapters.yade.inside.session import O, RunError, timed


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

"""The part that all drivers share: it reads asks, times their solution, and writes answers.

It runs in the Python of an external code, as part of one script with the driver, and imports
nothing but numpy: see `vv.codes.own_python`. The script answers the asks in the files it is given,
each in FILE.npy and, at the very end, FILE.answer; without files it answers the ask that is filled
in as ASK.
"""

import json
import math
import os
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

ASK: dict[str, Any] | None = None
Plan = dict[str, Any]
Sines = list[tuple[list[float], float, float]]  # amplitude along x, y, z; rad/s; phase


class RunError(Exception):
    """A run without a valid result: its status and reason."""

    def __init__(self, status: str, reason: str) -> None:
        super().__init__(reason)
        self.status = status


class Stopwatch:
    """CPU and wall seconds of the parts of a run, from one call of `lap` to the next."""

    def __init__(self) -> None:
        self.laps: dict[str, tuple[float, float]] = {}
        self.cpu, self.wall = time.process_time(), time.perf_counter()

    def lap(self, part: str) -> None:
        """Add the time since the last call to a part."""
        cpu, wall = time.process_time(), time.perf_counter()
        spent = self.laps.get(part, (0.0, 0.0))
        self.laps[part] = spent[0] + cpu - self.cpu, spent[1] + wall - self.wall
        self.cpu, self.wall = cpu, wall


# simulate(ask, watched): values (quantity, time, 3), or None if not watched, and facts of the run;
# laps `setup`, `steps` and `reading` are its cost
Simulate = Callable[[Plan, bool, Stopwatch], tuple[Any, Plan]]


def swung(sines: Sines, t: float, derivative: int = 0) -> tuple[float, float, float]:
    """The sum of A sin(w t + phase) along x, y, z, or its first or second time derivative."""
    x = y = z = 0.0
    for (a, b, c), omega, phase in sines:
        part = math.sin(omega * t + phase + derivative * math.pi / 2) * omega**derivative
        x, y, z = x + a * part, y + b * part, z + c * part
    return x, y, z


def solve(ask: Plan, simulate: Simulate, repeat: float) -> tuple[Any, Plan]:
    """Observables of one ask, and their cost.

    repeat: the run is repeated without observables, at least three times, until its steps took that
    many CPU seconds; the minimum is reported.
    """
    watch = Stopwatch()
    values, facts = simulate(ask, True, watch)
    if not np.isfinite(values).all():
        raise RunError("diverged", "an observable is not finite")
    runs = [watch.laps]
    while repeat and (len(runs) < 4 or sum(laps["steps"][0] for laps in runs) < repeat):
        watch = Stopwatch()
        simulate(ask, False, watch)
        runs.append(watch.laps)
    timed = [laps["steps"] for laps in runs[1:] or runs]
    least, most = min(timed), max(timed)
    cost = {
        "setup": min(laps["setup"][0] for laps in runs),
        "solve_cpu": least[0],
        "solve_wall": least[1],
        "output": runs[0].get("reading", (0.0, 0.0))[0],
        "repeats": len(timed),
        "spread": most[0] / least[0] - 1 if least[0] > 0 else 0.0,
    }
    return values, {"status": "ran", "reason": "", "steps": ask["steps"], **facts, **cost}


def answer(path: str, simulate: Simulate, ready: float) -> None:
    """Solve the ask in a file and write the answer beside it, completely or not at all."""
    with open(path) as file:
        ask = json.load(file)
    values = np.zeros(0)
    try:
        values, facts = solve(ask, simulate, ask["repeat"])
    except RunError as trouble:
        facts = {"status": trouble.status, "reason": str(trouble)}
    except Exception as error:
        facts = {"status": "error", "reason": f"{type(error).__name__}: {error}"}
    np.save(path + ".npy", values)
    with open(path + ".answer.half", "w") as file:
        json.dump({**facts, "ready": ready}, file)
    os.replace(path + ".answer.half", path + ".answer")


def serve(simulate: Simulate) -> None:
    """Answer the asks in the files named, or print the answer to ASK."""
    if ASK is None:
        ready = time.monotonic()
        for path in sys.argv[1:]:
            answer(path, simulate, ready)
            ready = 0.0
        return
    values, facts = solve(ASK, simulate, 0.0)
    print(facts)
    for (kind, body), rows in zip(ASK["observe"], values, strict=True):
        print(f"# t [s], {kind} of body {body}: x, y, z [SI]")
        for number, row in enumerate(rows):
            print(*(f"{part:.17g}" for part in (number * ASK["stride"] * ASK["dt"], *row)))

"""Finds what solves cost, from the logs, file times and CPU accounts of a batch of decks.

LIGGGHTS reports the elapsed time of its stepping loop and, separately, that of output within it.
For one thread that never waits, elapsed time is CPU time as long as no other process needs the
core; so the minimum of several solves counts as both. A long solve is interrupted on any busy
machine; for it, the system's CPU account is used. Set-up is the remainder of a solve, known to the
resolution of the file system's clock: some ms over all solves.
"""

from __future__ import annotations

import re
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from adapters.liggghts.terms.contact import COUNTED, UNCOUNTED
from vv.ask import Cost
from vv.codes.external import Process
from vv.scene import Vector

LOOP = re.compile(r"^Loop time of (\S+)", re.MULTILINE)
CHARGING = re.compile(f"^{UNCOUNTED}.*?^{COUNTED}", re.MULTILINE | re.DOTALL)
OUTPUT = re.compile(r"^(?:Outpt|Fix history print) *time \(%\) = (\S+)", re.MULTILINE)


@dataclass(frozen=True)
class Loops:
    """LIGGGHTS' own times of the runs in a log, (k,) [s]: the loop without and with its output."""

    solve: Vector
    whole: Vector


def loops(log: str) -> Loops:
    """The times in a log.

    LIGGGHTS counts elapsed time from before the first to after the last step of a run; writing rows
    and thermo lines is part of it and is reported as well. The step that charges springs is set-up.
    """
    runs = LOOP.split(CHARGING.sub("", log))[1:]  # the time, then the text up to the next
    whole = np.array([float(time) for time in runs[::2]])
    output = np.array([sum(map(float, OUTPUT.findall(text))) for text in runs[1::2]])
    return Loops(np.maximum(whole - output, 0.0), whole)


def startup(part: Path, program: Process) -> float:
    """The time from the start of a program to that of its first part [s], by file times."""
    started = time.time() - (time.monotonic() - program.started)
    return max(0.0, part.with_suffix(".begun").stat().st_mtime - started)


def cost(part: Path) -> Cost:
    """The cost of the solves in a finished part of a batch."""
    spent = loops(part.with_suffix(".log").read_text(errors="replace"))
    begun, done = (part.with_suffix(s).stat().st_mtime for s in (".begun", ".done"))
    solve = np.minimum(spent.solve, _on_cpu(part.with_suffix(".cpu"), len(spent.solve)))
    warm = 1 if len(solve) > 1 else 0  # the first solve fills caches
    counted = solve[warm:]
    least = float(counted.min())
    return Cost(
        setup=max(0.0, (done - begun - float(spent.whole.sum())) / len(spent.whole)),
        solve_cpu=least,
        solve_wall=float(spent.solve[warm:].min()),
        output=float((spent.whole - spent.solve)[0]),
        repeats=len(counted),
        spread=float(np.ptp(counted)) / least if least > 0 else 0.0,
    )


def _on_cpu(account: Path, solves: int) -> Vector:
    """The CPU seconds of each solve, (k,); infinite where the system was not asked."""
    stated = account.read_text().split("\n") if account.exists() else []
    clock = np.array([float(line.split()[0]) for line in stated if line.strip()])
    if len(clock) != 2 * solves or (np.diff(clock) <= 0).any():
        return np.full(solves, np.inf)  # a system that does not keep such accounts
    return np.asarray(np.diff(clock)[::2] * 1e-9)

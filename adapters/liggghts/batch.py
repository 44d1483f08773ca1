"""Runs decks: many in one LIGGGHTS process, a log each, and what every solve cost.

LIGGGHTS states the elapsed time of its stepping loop and, apart, that of output within it. On one
thread that never waits, elapsed time is CPU time as long as nothing else wants the core, so the
least of several solves stands for both; of a long one, which others interrupt on any busy machine,
the system says how long it was on a core. Timed solves write nothing and are solves of their own,
from an empty LIGGGHTS to the last step; the first of several is not counted. Set-up is what
remains of a solve, known to the tick of the file system's clock: some ms over all the solves.
"""

from __future__ import annotations

import math
import shutil
import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from adapters.liggghts.answers import loops, parse
from adapters.liggghts.deck import deck, silent_deck
from vv.ask import Ask, Cost, Model, Run, Status
from vv.codes import external
from vv.scene import Vector

# One process without a network of ranks: Open MPI's search for one takes 0.3-0.5 s.
ON_CPU = "on-cpu.sh"  # adds to a file how long the program has been on a core
MPI = {
    "OMPI_MCA_ess_singleton_isolated": "1",
    "OMPI_MCA_btl": "self",
    "OMPI_MCA_pml": "ob1",
}
LEAST_REPEATS = 4  # with the first, which is not counted
GONE = ": Bond atoms"  # ... missing on proc 0
FEW = 20  # solves of which the system is asked: with more, a millisecond each would tell
MOST_REPEATS = 300  # each costs a set-up of about a millisecond besides its solve


def solved(
    asks: Sequence[Ask], models: Sequence[Model], scheme: str, scratch: Path, path: str
) -> Iterator[Run]:
    """The answers to asks, with the cost of the one solve that gave them."""
    first: dict[external.Program, int] = {}  # the ask that carries a program's start-up

    def launch(indices: Sequence[int]) -> external.Program:
        parts = [_framed(f"ask-{i}", deck(asks[i], scheme, f"ask-{i}.txt")) for i in indices]
        program = _start(parts, scratch, path)
        first[program] = indices[0]
        return program

    def collect(index: int, program: external.Program) -> Run | None:
        part = scratch / f"ask-{index}"
        if not part.with_suffix(".done").exists():
            return None
        run = parse(part.with_suffix(".txt"), asks[index], models[index])
        startup = _startup(part, program) if first[program] == index else 0.0
        return replace(run, cost=replace(_cost(part), startup=startup))

    for index, run in enumerate(external.run_batch(len(asks), launch, collect)):
        answered = (scratch / f"ask-{index}.done").exists()
        yield run if answered or not first else _explained(run, [*first][-1])


def timed(
    asks: Sequence[Ask],
    models: Sequence[Model],
    scheme: str,
    scratch: Path,
    path: str,
    repeat: float,
) -> Iterator[Run]:
    """Costs of solves that write nothing, and so give no values: one each, then more of the short.

    A solve of more than twice `repeat` [CPU s] has no caches to fill that would show: one is
    enough. Others are repeated for about `repeat` CPU seconds.
    """
    once = list(_silent(asks, models, scheme, scratch, path, [1] * len(asks)))
    short = [i for i, run in enumerate(once) if 0 < run.cost.solve_cpu <= 2 * repeat]
    times = [_times(once[i].cost.solve_cpu, repeat) for i in short]
    few = [asks[i] for i in short], [models[i] for i in short]
    again = dict(zip(short, _silent(*few, scheme, scratch, path, times), strict=True))
    for index, run in enumerate(once):
        startup = run.cost.startup
        more = again.get(index, run)
        yield replace(more, cost=replace(more.cost, startup=startup))


def _times(once: float, repeat: float) -> int:
    """How many solves of that many CPU seconds are repeated."""
    return max(LEAST_REPEATS, min(MOST_REPEATS, 1 + math.ceil(repeat / once)))


def _silent(
    asks: Sequence[Ask],
    models: Sequence[Model],
    scheme: str,
    scratch: Path,
    path: str,
    times: Sequence[int],
) -> Iterator[Run]:
    """Each ask solved so many times in a row without any output: no values, but what it cost."""
    name = f"time-{len(list(scratch.glob('batch-*.in')))}"
    first: dict[external.Program, int] = {}

    def launch(indices: Sequence[int]) -> external.Program:
        program = _start([_framed(f"{name}-{i}", text(i)) for i in indices], scratch, path)
        first[program] = indices[0]
        return program

    def text(index: int) -> str:
        around = [f"shell sh {ON_CPU} {name}-{index}.cpu"] if times[index] <= FEW else []
        return "clear\n".join([silent_deck(asks[index], scheme, around)] * times[index])

    def collect(index: int, program: external.Program) -> Run | None:
        part = scratch / f"{name}-{index}"
        if not part.with_suffix(".done").exists():
            return None
        startup = _startup(part, program) if first[program] == index else 0.0
        steps = asks[index].goal.steps(asks[index].dt)
        cost = replace(_cost(part), startup=startup)
        return Run(Status.RAN, cost=cost, steps=steps, model=models[index])

    yield from external.run_batch(len(asks), launch, collect)


def _explained(run: Run, program: external.Program) -> Run:
    """A failure with LIGGGHTS' own word on it, which Open MPI's banner may have pushed away.

    What it drops for having left its box (see `answers.parse`) it misses where a bond holds it.
    """
    said = program.log.read_text(errors="replace")
    errors = [line.strip() for line in said.splitlines() if line.startswith("ERROR")]
    if errors and GONE in errors[-1]:
        return Run(Status.DIVERGED, f"{errors[-1]}: a sphere left the box, farther than it may be")
    known = not errors or errors[-1] in run.reason
    return run if known else replace(run, reason=f"{errors[-1]}; {run.reason}")


def _framed(part: str, text: str) -> str:
    """A part of a batch: a fresh LIGGGHTS, a log of its own, marks where it begins and is done."""
    return (
        f'clear\nprint "begun" file {part}.begun screen no\nlog {part}.log\n{text}'
        f'log none\nprint "done" file {part}.done screen no\n'
    )


def _start(parts: Sequence[str], scratch: Path, path: str) -> external.Program:
    """Start LIGGGHTS on the parts; by line, since it loses what it has not written when it dies."""
    batch = scratch / f"batch-{len(list(scratch.glob('batch-*.in')))}.in"
    batch.write_text("".join(parts))
    (scratch / ON_CPU).write_text('cat /proc/"$(cat program.pid)"/schedstat >>"$1"\n')
    by_line = ["stdbuf", "-oL"] if shutil.which("stdbuf") else []
    named = ["sh", "-c", 'echo $$ >program.pid; exec "$@"', "sh"]
    command = [*named, *by_line, path, "-in", batch.name, "-echo", "none", "-log", "none"]
    return external.start(command, scratch, MPI)


def _startup(part: Path, program: external.Program) -> float:
    """From the start of a program to that of its first part [s]; file times are of the wall."""
    started = time.time() - (time.monotonic() - program.started)
    return max(0.0, part.with_suffix(".begun").stat().st_mtime - started)


def _cost(part: Path) -> Cost:
    """The cost of the solves in a part of a batch that is done."""
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


def _on_cpu(told: Path, solves: int) -> Vector:
    """Seconds that each solve was on a core, (k,); infinite where the system was not asked."""
    stated = told.read_text().split("\n") if told.exists() else []
    clock = np.array([float(line.split()[0]) for line in stated if line.strip()])
    if len(clock) != 2 * solves or (np.diff(clock) <= 0).any():
        return np.full(solves, np.inf)  # a system that does not keep such accounts
    return np.asarray(np.diff(clock)[::2] * 1e-9)

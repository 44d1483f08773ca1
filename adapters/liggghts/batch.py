"""Runs decks: many in one LIGGGHTS process, with a log each and the cost of every solve.

Timed solves write nothing; each is a complete solve from an empty LIGGGHTS to the last step. The
first of several is not counted. How costs are found from the logs: see `costs`.
"""

from __future__ import annotations

import math
import shutil
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from adapters.liggghts.answers import parse
from adapters.liggghts.costs import cost, startup
from adapters.liggghts.deck import deck, silent_deck
from adapters.liggghts.setup import Setup
from vv.ask import Model, Run, Status
from vv.codes import external

# One process without a network of ranks: Open MPI's search for one takes 0.3-0.5 s.
ON_CPU = "on-cpu.sh"  # appends to a file how long the program has run on a core
MPI = {
    "OMPI_MCA_ess_singleton_isolated": "1",
    "OMPI_MCA_btl": "self",
    "OMPI_MCA_pml": "ob1",
}
LEAST_REPEATS = 4  # with the first, which is not counted
GONE = ": Bond atoms"  # the beginning of LIGGGHTS' message
FEW = 20  # solves for which the system is asked for CPU time, which takes a millisecond
MOST_REPEATS = 300  # each adds a set-up of about a millisecond to its solve


@dataclass(frozen=True)
class Batch:
    """Setups with their models, a working folder of their own, and LIGGGHTS' executable."""

    setups: Sequence[Setup]
    models: Sequence[Model]
    folder: Path
    executable: str

    def only(self, indices: Sequence[int]) -> Batch:
        """A batch with some of the setups only."""
        some = [self.setups[i] for i in indices], [self.models[i] for i in indices]
        return Batch(*some, self.folder, self.executable)


def solved(batch: Batch) -> Iterator[Run]:
    """The answers to all asks, each with the cost of the solve that gave it."""
    first: dict[external.Process, int] = {}  # the ask whose cost includes the program's start-up
    setups, folder = batch.setups, batch.folder

    def launch(indices: Sequence[int]) -> external.Process:
        parts = [_framed(f"ask-{i}", deck(setups[i], f"ask-{i}.txt")) for i in indices]
        program = _start(parts, batch)
        first[program] = indices[0]
        return program

    def collect(index: int, program: external.Process) -> Run | None:
        part = folder / f"ask-{index}"
        if not part.with_suffix(".done").exists():
            return None
        run = parse(part.with_suffix(".txt"), setups[index], batch.models[index])
        before = startup(part, program) if first[program] == index else 0.0
        return replace(run, cost=replace(cost(part), startup=before))

    for index, run in enumerate(external.run_batch(len(setups), launch, collect)):
        answered = (folder / f"ask-{index}.done").exists()
        yield run if answered or not first else _explained(run, [*first][-1])


def timed(batch: Batch, repeat: float) -> Iterator[Run]:
    """Costs of solves that write nothing, and so have no values; short ones are repeated.

    A solve of more than twice `repeat` [CPU s] is done once, since filling caches does not show in
    it. Others are repeated for about `repeat` CPU seconds.
    """
    once = list(_silent(batch, [1] * len(batch.setups)))
    short = [i for i, run in enumerate(once) if 0 < run.cost.solve_cpu <= 2 * repeat]
    times = [_times(once[i].cost.solve_cpu, repeat) for i in short]
    again = dict(zip(short, _silent(batch.only(short), times), strict=True))
    for index, run in enumerate(once):
        more = again.get(index, run)
        yield replace(more, cost=replace(more.cost, startup=run.cost.startup))


def _times(once: float, repeat: float) -> int:
    """How many times a solve of so many CPU seconds is repeated."""
    return max(LEAST_REPEATS, min(MOST_REPEATS, 1 + math.ceil(repeat / once)))


def _silent(batch: Batch, times: Sequence[int]) -> Iterator[Run]:
    """The costs of asks, each solved a number of times in a row without output and values."""
    folder = batch.folder
    name = f"time-{len(list(folder.glob('batch-*.in')))}"
    first: dict[external.Process, int] = {}

    def launch(indices: Sequence[int]) -> external.Process:
        program = _start([_framed(f"{name}-{i}", text(i)) for i in indices], batch)
        first[program] = indices[0]
        return program

    def text(index: int) -> str:
        around = [f"shell sh {ON_CPU} {name}-{index}.cpu"] if times[index] <= FEW else []
        return "clear\n".join([silent_deck(batch.setups[index], around)] * times[index])

    def collect(index: int, program: external.Process) -> Run | None:
        part = folder / f"{name}-{index}"
        if not part.with_suffix(".done").exists():
            return None
        before = startup(part, program) if first[program] == index else 0.0
        ask = batch.setups[index].ask
        spent = replace(cost(part), startup=before)
        steps = ask.goal.steps(ask.dt)
        return Run(Status.RAN, cost=spent, steps=steps, model=batch.models[index])

    yield from external.run_batch(len(batch.setups), launch, collect)


def _explained(run: Run, program: external.Process) -> Run:
    """A failure with LIGGGHTS' own message, which Open MPI's banner may have displaced.

    LIGGGHTS reports an atom that left its box (see `answers.parse`) as missing if a bond holds it.
    """
    output = program.log.read_text(errors="replace")
    errors = [line.strip() for line in output.splitlines() if line.startswith("ERROR")]
    if errors and GONE in errors[-1]:
        return Run(Status.DIVERGED, f"{errors[-1]}: a sphere left the box, farther than it may be")
    known = not errors or errors[-1] in run.reason
    return run if known else replace(run, reason=f"{errors[-1]}; {run.reason}")


def _framed(part: str, text: str) -> str:
    """One part of a batch: a fresh LIGGGHTS, its own log, and marks at its beginning and end."""
    return (
        f'clear\nprint "begun" file {part}.begun screen no\nlog {part}.log\n{text}'
        f'log none\nprint "done" file {part}.done screen no\n'
    )


def _start(parts: Sequence[str], batch: Batch) -> external.Process:
    """Start LIGGGHTS on the parts; output is by lines: if it dies, buffered output is lost."""
    folder = batch.folder
    deck_file = folder / f"batch-{len(list(folder.glob('batch-*.in')))}.in"
    deck_file.write_text("".join(parts))
    (folder / ON_CPU).write_text('cat /proc/"$(cat program.pid)"/schedstat >>"$1"\n')
    by_line = ["stdbuf", "-oL"] if shutil.which("stdbuf") else []
    named = ["sh", "-c", 'echo $$ >program.pid; exec "$@"', "sh"]
    command = [
        *named,
        *by_line,
        batch.executable,
        "-in",
        deck_file.name,
        "-echo",
        "none",
        "-log",
        "none",
    ]
    return external.start(command, folder, MPI)

"""Answers asks in a worker: plain asks one by one, searches in rounds of several values each."""

from __future__ import annotations

import dataclasses
import itertools
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from vv.ask import Ask, Bracket, Cost, Run, SearchVariable, Status
from vv.codes.adapter import Adapter
from vv.scene import Vector

VARIED = {SearchVariable.STEP: Ask.at, SearchVariable.SHAKING: Ask.shaken}
LOST = float("inf")  # the reach of a run that did not reach its end


def answers(
    adapter: Adapter, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float
) -> Iterator[Run]:
    """Yield one Run per ask, in order, as `Adapter.run` does; adjacent searches run together.

    Each call of the adapter has its own folder: files that it names by the number of an ask must
    not be taken for the answer to another. The first values of searches run together with the plain
    asks before them, so that a program starts once for both, unless these are timed. A step that a
    code refuses is run nevertheless if the first step is not refused, since the search asks whether
    it is stable.
    """
    left = list(asks)
    while left:
        plain = list(itertools.takewhile(lambda ask: ask.search is None, left))
        sought = itertools.takewhile(lambda ask: ask.search is not None, left[len(plain) :])
        searches = [_Search(ask, ask.search) for ask in sought if ask.search is not None]
        if repeat and plain:
            yield from _run(adapter, plain, scheme, scratch, repeat)
            left = left[len(plain) :]
        else:
            yield from _found(adapter, plain, searches, scheme, scratch)
            left = left[len(plain) + len(searches) :]


def _run(
    adapter: Adapter, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float = 0.0
) -> Iterator[Run]:
    """Run asks by the adapter in a new folder."""
    folder = Path(tempfile.mkdtemp(prefix="asks-", dir=scratch))
    return adapter.run(asks, scheme, folder, repeat)


@dataclass(eq=False)
class _Search:
    """The state of a search. runs: value tried (step [s], or factor of the shaking) -> its run."""

    ask: Ask
    bracket: Bracket
    runs: dict[float, Run] = field(default_factory=dict)

    def tried(self) -> Vector:
        """(n, 2) values tried so far, ascending, and the largest response at each."""
        return np.array([(value, _reach(self.runs[value])) for value in sorted(self.runs)])

    def ask_at(self, value: float) -> Ask:
        """The ask that tries a value."""
        return VARIED[self.bracket.variable](self.ask, value)

    def values(self) -> list[float]:
        """The values to try next; empty once the largest of the bracket is stable."""
        if not self.runs:
            low = self.ask.dt if self.bracket.variable is SearchVariable.STEP else 1.0
            return list(np.geomspace(low, low * self.bracket.span, self.bracket.tries))
        stable, lost = self.bracket.stability_limits(self.tried())
        if not stable or lost is None:
            return []
        return list(np.geomspace(stable, lost, self.bracket.tries + 2)[1:-1])

    def run(self) -> Run:
        """The Run of the first value with all values tried; the failed run if that one failed."""
        first = self.runs[min(self.runs)]
        if _reach(first) == LOST:
            return first
        runs = self.runs.values()
        return dataclasses.replace(
            first,
            reason=self._beyond(),
            cost=_sum([run.cost for run in runs]),
            steps=sum(run.steps for run in runs),
            ledger=None,
            tried=self.tried(),
        )

    def _beyond(self) -> str:
        """The run of the smallest unstable value."""
        lost = self.bracket.stability_limits(self.tried())[1]
        if lost is None:
            return "all values that were tried are stable"
        reach, bound = _reach(self.runs[lost]), self.bracket.bound
        grown = f"reaches {reach:.3g} of at most {bound:.3g}"
        where = (
            f"dt = {lost:.6g} s"
            if self.bracket.variable is SearchVariable.STEP
            else f"{lost:.6g} times"
        )
        return f"at {where}: {self.runs[lost].reason if reach == LOST else grown}"


def _found(
    adapter: Adapter,
    plain: Sequence[Ask],
    searches: Sequence[_Search],
    scheme: str,
    scratch: Path,
) -> Iterator[Run]:
    """Yield runs of plain asks, then of searches, which all advance one round at a time."""
    rounds = max((one.bracket.rounds for one in searches), default=1)
    for number in range(rounds):
        due = [s for s in searches if number < s.bracket.rounds]
        probes = [(one, value) for one in due for value in one.values()]
        before = plain if number == 0 else ()
        runs = _run(
            adapter, [*before, *(one.ask_at(value) for one, value in probes)], scheme, scratch
        )
        yield from itertools.islice(runs, len(before))
        for (one, value), run in zip(probes, runs, strict=True):
            one.runs[value] = run
    yield from (one.run() for one in searches)


def _reach(run: Run) -> float:
    """The largest component of an observable; LOST if the run did not reach its end."""
    if run.status is not Status.RAN:
        return LOST
    reach = max(float(np.abs(values).max()) for values in run.values.values())
    return reach if np.isfinite(reach) else LOST


def _sum(costs: Sequence[Cost]) -> Cost:
    """The total cost of several runs; start-up of a shared program is counted with the first."""
    names = ("startup", "setup", "solve_cpu", "solve_wall", "output")
    total = {name: sum(getattr(cost, name) for cost in costs) for name in names}
    return Cost(**total, whole=any(cost.whole for cost in costs))

"""Answers asks in a worker: plain ones as they come, searches by rounds of several values each."""

from __future__ import annotations

import dataclasses
import itertools
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from vv.ask import Ask, Bracket, Cost, Run, Sought, Status
from vv.codes.adapter import Adapter
from vv.scene import Vector

VARIED = {Sought.STEP: Ask.at, Sought.SHAKING: Ask.shaken}
LOST = float("inf")  # the reach of a run that did not come to its end


def answers(
    adapter: Adapter, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float
) -> Iterator[Run]:
    """Yield one Run per ask, in order, as `Adapter.run` does; searches next to each other as one.

    Each call of the adapter has a folder of its own: what it names by an ask's number must not be
    taken for the answer to another. What is sought first goes along with the plain asks before it,
    so that a program starts once for both, unless these are timed.
    A step that a code refuses is run all the same where the first one is not refused: a search
    asks what comes of it.
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
    """As the adapter, in a folder of its own."""
    folder = Path(tempfile.mkdtemp(prefix="asks-", dir=scratch))
    return adapter.run(asks, scheme, folder, repeat)


@dataclass(eq=False)
class _Search:
    """How far the search for an ask is; runs: step [s], or times the shaking -> what came of it."""

    ask: Ask
    bracket: Bracket
    runs: dict[float, Run] = field(default_factory=dict)

    def tried(self) -> Vector:
        """(n, 2) what was tried so far, ascending, and how far each reached."""
        return np.array([(value, _reach(self.runs[value])) for value in sorted(self.runs)])

    def ask_at(self, value: float) -> Ask:
        """What is asked to try a value."""
        return VARIED[self.bracket.sought](self.ask, value)

    def values(self) -> list[float]:
        """What to try next; nothing once the highest of the bracket is stable."""
        if not self.runs:
            low = self.ask.dt if self.bracket.sought is Sought.STEP else 1.0
            return list(np.geomspace(low, low * self.bracket.span, self.bracket.tries))
        stable, lost = self.bracket.stability_limits(self.tried())
        if not stable or lost is None:
            return []
        return list(np.geomspace(stable, lost, self.bracket.tries + 2)[1:-1])

    def run(self) -> Run:
        """The Run of what was tried first, with all that was tried; its failure if it failed."""
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
        """What comes of the least value that is unstable."""
        lost = self.bracket.stability_limits(self.tried())[1]
        if lost is None:
            return "all that was tried is stable"
        reach, bound = _reach(self.runs[lost]), self.bracket.bound
        grown = f"reaches {reach:.3g} of at most {bound:.3g}"
        where = f"dt = {lost:.6g} s" if self.bracket.sought is Sought.STEP else f"{lost:.6g} times"
        return f"at {where}: {self.runs[lost].reason if reach == LOST else grown}"


def _found(
    adapter: Adapter,
    plain: Sequence[Ask],
    searches: Sequence[_Search],
    scheme: str,
    scratch: Path,
) -> Iterator[Run]:
    """The answers to plain asks, then to searches, all of which take their rounds together."""
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
    """The largest component of an observable; LOST where the run did not come to its end."""
    if run.status is not Status.RAN:
        return LOST
    reach = max(float(np.abs(values).max()) for values in run.values.values())
    return reach if np.isfinite(reach) else LOST


def _sum(costs: Sequence[Cost]) -> Cost:
    """What several runs cost together; a program that they share starts with the first."""
    names = ("startup", "setup", "solve_cpu", "solve_wall", "output")
    return Cost(**{name: sum(getattr(cost, name) for cost in costs) for name in names})

"""Runs what the command of a finding runs: one variant, one scheme, one setting."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import pytest

from bench.mutation.sensitivity import answer
from tests.support.installed import require
from vv.ask import Ask, Knobs, Ledger, Run, Status
from vv.case import Level, Norm, Trial
from vv.codes import Scheme
from vv.plan.project import find
from vv.records.quantity import MeasuredQuantity
from vv.records.record import measured

PROJECT = find(Path(__file__))


@dataclass(frozen=True)
class Answer:
    """What a scheme answers to a trial at a setting; given: its parameters."""

    given: Mapping[str, float]
    trial: Trial
    scheme: Scheme
    ask: Ask
    run: Run

    def of(self, quantity: str) -> MeasuredQuantity:
        """A quantity of a run that came to its end, as a record would have it."""
        assert self.run.status is Status.RAN, self.run.reason
        wanted = next(one for one in self.trial.quantities if one.name == quantity)
        method = self.scheme.method_for(self.ask.scene.terms())
        return measured(self.run, wanted, method, self.ask.knobs)[0]

    @property
    def ledger(self) -> Ledger:
        """The energy ledger of the run."""
        assert self.run.ledger is not None
        return self.run.ledger


@functools.cache
def asked(name: str, scheme: str, at: Knobs | Level | None) -> Answer:
    """What a scheme answers to CASE:VARIANT NAME=VALUE..., where NAME=VALUE are changes of it.

    A level stands for its last setting, None for the first of the quick level.
    """
    name, *changed = name.split()
    case, _, variant = name.partition(":")
    code, _, which = scheme.partition("/")
    sets = {key: float(value) for key, value in (one.split("=") for one in changed)}
    given = {**PROJECT.load_case(case).defaults(variant), **sets}
    trial = PROJECT.load_case(case).declare(variant, given)
    adapter = PROJECT.load_adapter(code)
    own = next(one for one in adapter.schemes if one.name == which)
    rungs = trial.study.rungs
    knobs = rungs[at][-1] if isinstance(at, Level) else at or rungs[Level.QUICK][0]
    ask = trial.study.ask(knobs)
    return Answer(given, trial, own, ask, answer(adapter, own, ask))


Figure = Callable[[Answer], float]


def error(quantity: str) -> Figure:
    """The largest error of a quantity."""

    def figure(answer: Answer) -> float:
        found = answer.of(quantity).errors[Norm.MAX]
        assert found is not None
        return found

    return figure


def value(quantity: str) -> Figure:
    """The value of a quantity."""

    def figure(answer: Answer) -> float:
        found = answer.of(quantity).value
        assert found is not None
        return found

    return figure


def allowed(quantity: str) -> Figure:
    """The tolerance of a quantity."""

    def figure(answer: Answer) -> float:
        found = answer.of(quantity).tolerance
        assert found is not None
        return found

    return figure


def against(quantity: str) -> Figure:
    """The value of a quantity over that measured or printed, less 1."""

    def figure(answer: Answer) -> float:
        found = answer.of(quantity)
        beside = found.measurement or found.printed
        assert found.value is not None
        assert beside is not None
        return found.value / beside.value - 1.0

    return figure


def measured_as(quantity: str) -> Figure:
    """The measured value of a quantity."""

    def figure(answer: Answer) -> float:
        found = answer.of(quantity).measurement
        assert found is not None
        return found.value

    return figure


def ends(status: Status) -> Figure:
    """1 where a run ends so."""
    return lambda answer: float(answer.run.status is status)


def unaccounted(answer: Answer) -> float:
    """Energy [J] that no term of the ledger explains."""
    return answer.ledger.unaccounted


def added_by_friction(answer: Answer) -> float:
    """Energy [J] that friction adds, which it should dissipate."""
    return -answer.ledger.terms["friction dissipation"]


def of_peak(figure: Figure) -> Figure:
    """An energy over the largest of the run."""
    return lambda answer: figure(answer) / answer.ledger.peak


class Row(NamedTuple):
    """What shows a figure: a variant and changes of it, a scheme, a setting, and a band.

    what: a function of the answer, or the name of a quantity whose error is meant.
    """

    name: str
    scheme: str
    at: Knobs | Level | None
    what: str | Figure
    low: float
    high: float

    def found(self) -> float:
        """The figure as it is now."""
        figure = error(self.what) if isinstance(self.what, str) else self.what
        return figure(asked(self.name, self.scheme, self.at))

    def holds(self) -> bool:
        """Whether the figure is within its band."""
        return self.low <= self.found() <= self.high

    def check(self) -> None:
        """Fail if the figure is outside its band; skip where the code is not installed."""
        require(PROJECT.load_adapter(self.scheme.partition("/")[0]))
        assert self.low <= self.found() <= self.high


Table = Mapping[str, Sequence[Row]]  # words of docs/findings.md, and what shows them


def rows(table: Table) -> list[object]:
    """The parameters of a test of all rows of a table."""
    return [
        pytest.param(row, id=f"{told}: {row.name} {row.scheme} {row.at}")
        for told, group in table.items()
        for row in group
    ]


def each(schemes: str, row: Sequence[object]) -> tuple[Row, ...]:
    """The same row for several schemes, CODE/SCHEME,...; the row is without its scheme."""
    name, *others = row
    return tuple(Row(name, scheme, *others) for scheme in schemes.split(","))  # type: ignore[arg-type]

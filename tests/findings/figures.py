"""Runs what the command of a finding runs, and reads figures of the answer."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from bench.bounds.sensitivity import answer
from vv.ask import Ask, Knobs, Ledger, Run, Status
from vv.case import Level, Norm, Trial
from vv.codes import Adapter, Scheme
from vv.plan.project import find
from vv.records.outcomes import Verdict
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


class Posed(NamedTuple):
    """What a scheme is asked, of which case and variant; given: the parameters."""

    case: str
    variant: str
    given: Mapping[str, float]
    trial: Trial
    adapter: Adapter
    scheme: Scheme
    ask: Ask


def posed(name: str, scheme: str, at: Knobs | Level | None) -> Posed:
    """A scheme is asked CASE:VARIANT NAME=VALUE..., where NAME=VALUE are changes of the variant.

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
    return Posed(case, variant, given, trial, adapter, own, trial.study.ask(knobs))


@functools.cache
def asked(name: str, scheme: str, at: Knobs | Level | None) -> Answer:
    """What a scheme answers to what it is asked, as in `posed`."""
    one = posed(name, scheme, at)
    run = answer(one.adapter, one.scheme, one.ask)
    return Answer(one.given, one.trial, one.scheme, one.ask, run)


Figure = Callable[[Answer], float]


@dataclass(frozen=True)
class Read:
    """A figure that a record of a run has too: of a quantity, its value or its largest error."""

    quantity: str
    name: str

    def __call__(self, answer: Answer) -> float:
        one = answer.of(self.quantity)
        return _there(one.value if self.name == VALUE else one.errors[Norm.MAX])


VALUE, ERROR = "value", "max error"


def error(quantity: str) -> Read:
    """The largest error of a quantity."""
    return Read(quantity, ERROR)


def value(quantity: str) -> Read:
    """The value of a quantity."""
    return Read(quantity, VALUE)


def allowed(quantity: str) -> Figure:
    """The tolerance of a quantity."""
    return lambda answer: _there(answer.of(quantity).tolerance)


def _there(found: float | None) -> float:
    assert found is not None
    return found


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


def passes(quantity: str) -> Figure:
    """1 where a quantity is within its tolerance or band."""
    return lambda answer: float(answer.of(quantity).verdict is Verdict.PASS)


def ends(status: Status) -> Figure:
    """1 where a run ends so."""
    return lambda answer: float(answer.run.status is status)


def unaccounted(answer: Answer) -> float:
    """Energy [J] that no term of the ledger explains."""
    return answer.ledger.unaccounted


def added_by_friction(answer: Answer) -> float:
    """Energy [J] that friction adds, which it should dissipate."""
    return -answer.ledger.terms["friction dissipation"]


def peak(answer: Answer) -> float:
    """The largest energy [J] of the run."""
    return answer.ledger.peak


def of_peak(figure: Figure) -> Figure:
    """An energy over the largest of the run."""
    return lambda answer: figure(answer) / answer.ledger.peak

"""Judges the answers of a scheme to a tiny scene, and says in words what is wrong with them."""

from __future__ import annotations

import enum
from collections.abc import Sequence
from dataclasses import dataclass

from vv.ask import Method, Run, Status
from vv.base.metrics import observed_order
from vv.codes.adapter import Scheme
from vv.codes.greetings import STEPS, Greeting, error, likeness

GOOD = 0.02  # of the largest value: a larger error at the finest step is a wrong answer
ROUNDING = 1e-9  # below which an order in dt says nothing
SHORTFALL = 0.5  # by how much an observed order may miss what is claimed
ORDERS = {Method.SECOND_ORDER: 2.0, Method.FIRST_ORDER: 1.0}


class Grip(enum.Enum):
    """What came of a handshake."""

    FIRM = "firm"
    REFUSED = "refused"
    WRONG = "wrong"
    FAILED = "failed"


@dataclass(frozen=True)
class Handshake:
    """What is to be said of the answers to one tiny scene."""

    grip: Grip
    words: str


def judged(scheme: Scheme, greeting: Greeting, runs: Sequence[Run]) -> Handshake:
    """The judgement on the runs of `greeting.asks(scheme)`, in their order."""
    lost = next((run for run in runs if run.status is not Status.RAN), None)
    if lost is None:
        return _of_errors(scheme, greeting, runs[-1], [error(greeting, run) for run in runs])
    grip = Grip.REFUSED if lost.status is Status.REFUSED else Grip.FAILED
    return Handshake(grip, f"{lost.status.value}: {lost.reason}")


def _of_errors(
    scheme: Scheme, greeting: Greeting, finest: Run, errors: Sequence[float]
) -> Handshake:
    last = errors[-1]
    if not last <= GOOD:
        like = likeness(greeting, finest)
        looks = f"; it looks as if {like}" if like else ""
        return Handshake(Grip.WRONG, f"wrong by {last:.2g} of the largest value{looks}")
    fitted = observed_order([1 / n for n in STEPS], [*errors]) if len(errors) > 1 else None
    if fitted is None or last < ROUNDING or not greeting.smooth:
        return Handshake(Grip.FIRM, f"right, error {last:.1e}")
    seen = f"error {last:.1e} at {STEPS[-1]} steps"
    claimed = ORDERS.get(scheme.method_for(greeting.scene.terms()).general, 0.0)
    if fitted.order < claimed - SHORTFALL:
        short = f"it claims order {claimed:g} in dt, and {fitted.order:.1f} was seen"
        return Handshake(Grip.WRONG, f"{seen}; {short}")
    return Handshake(Grip.FIRM, f"right, {seen}, order in dt {fitted.order:.1f}")

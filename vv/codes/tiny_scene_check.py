"""Judges the answers of a scheme to a tiny scene, and says in words what is wrong with them."""

from __future__ import annotations

import enum
from collections.abc import Sequence
from dataclasses import dataclass

from vv.ask import Method, Run, Status
from vv.base.metrics import observed_order
from vv.codes.adapter import Scheme
from vv.codes.tiny_scenes import STEPS, TinyScene, error, likeness

GOOD = 0.02  # fraction of the largest value: a larger error at the finest step is a wrong answer
ROUNDING = 1e-9  # relative errors below it are rounding and show no order in dt
SHORTFALL = 0.5  # how far an observed order may lie below the claimed one
ORDERS = {Method.SECOND_ORDER: 2.0, Method.FIRST_ORDER: 1.0}


class Answered(enum.Enum):
    """How a scheme answered a tiny scene."""

    RIGHT = "right"
    REFUSED = "refused"
    WRONG = "wrong"
    FAILED = "failed"


@dataclass(frozen=True)
class CheckResult:
    """The judgement on the answers to one tiny scene, with its reason in words."""

    answered: Answered
    words: str


def judged(scheme: Scheme, tiny: TinyScene, runs: Sequence[Run]) -> CheckResult:
    """The judgement on the runs of `tiny.asks(scheme)`, in their order."""
    lost = next((run for run in runs if run.status is not Status.RAN), None)
    if lost is None:
        return _of_errors(scheme, tiny, runs[-1], [error(tiny, run) for run in runs])
    answered = Answered.REFUSED if lost.status is Status.REFUSED else Answered.FAILED
    return CheckResult(answered, f"{lost.status.value}: {lost.reason}")


def _of_errors(
    scheme: Scheme, tiny: TinyScene, finest: Run, errors: Sequence[float]
) -> CheckResult:
    last = errors[-1]
    if not last <= GOOD:
        like = likeness(tiny, finest)
        looks = f"; it looks as if {like}" if like else ""
        return CheckResult(Answered.WRONG, f"wrong by {last:.2g} of the largest value{looks}")
    fitted = observed_order([1 / n for n in STEPS], [*errors]) if len(errors) > 1 else None
    if fitted is None or last < ROUNDING or not tiny.smooth:
        return CheckResult(Answered.RIGHT, f"right, error {last:.1e}")
    seen = f"error {last:.1e} at {STEPS[-1]} steps"
    claimed = ORDERS.get(scheme.method_for(tiny.scene.terms()).general, 0.0)
    if fitted.order < claimed - SHORTFALL:
        short = f"it claims order {claimed:g} in dt, and {fitted.order:.1f} was seen"
        return CheckResult(Answered.WRONG, f"{seen}; {short}")
    return CheckResult(Answered.RIGHT, f"right, {seen}, order in dt {fitted.order:.1f}")

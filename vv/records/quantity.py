"""A quantity of a run as it was measured, with its errors and its verdict."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from vv.case import (
    CodeToCode,
    Exact,
    Interval,
    Invariant,
    Judge,
    Measured,
    Norm,
    Shown,
)
from vv.records.fields import optional
from vv.records.outcomes import JudgeKind, QuantityKind, Verdict


@dataclass(frozen=True, slots=True)
class MeasurementFacts:
    """A measurement with the fields of `vv.case.Measurement`, and the band around it."""

    value: float
    digitisation: float
    experiment: float
    conditions: str
    source: str
    band: float | None
    over: str = optional("")
    at: float | None = optional(None)

    @property
    def uncertainty(self) -> float:
        """Standard uncertainty of both sources together."""
        return math.hypot(self.digitisation, self.experiment)


@dataclass(frozen=True, slots=True)
class PrintedFacts:
    """The answer of another code, with the fields of `vv.case.Printed`, and the band around it."""

    value: float
    rounding: float
    code: str
    source: str
    band: float | None


@dataclass(frozen=True, slots=True)
class MeasuredQuantity:
    """A quantity of a run: its value, errors and verdict.

    unit: of the value, empty for a plain number. value, reference: of a number; those of a series
    are stored as arrays beside the record. end: the reference of a series at the last time. errors:
    relative to `scale`, None if not finite. figures: a few numbers that represent the value. norm:
    of the error that is judged; None means the maximum. tolerance: the bound on that error at this
    rung, with its reason; note: a remark of the judge. measurement, printed: the measurement or the
    answer of another code with which a number was compared in place of a reference; the number then
    has no errors, so that no ranking, map or order mixes it with the accuracy of codes.
    """

    name: str
    kind: QuantityKind
    unit: str
    value: float | None
    reference: float | None
    end: float | None
    errors: Mapping[Norm, float | None]
    scale: float | None
    figures: Mapping[str, float | None]
    judge: JudgeKind
    norm: Norm | None
    tolerance: float | None
    why: str
    note: str
    verdict: Verdict
    measurement: MeasurementFacts | None = optional(None)  # noqa: RUF009  # None is frozen
    printed: PrintedFacts | None = optional(None)  # noqa: RUF009

    @property
    def error(self) -> float | None:
        """The error in the norm by which it is judged; None if it has none."""
        return self.errors.get(self.norm or Norm.MAX)


_KINDS: Mapping[type, JudgeKind] = {
    Exact: JudgeKind.EXACT,
    Interval: JudgeKind.INTERVAL,
    Invariant: JudgeKind.INVARIANT,
    Shown: JudgeKind.SHOWN,
    Measured: JudgeKind.MEASURED,
    CodeToCode: JudgeKind.CODE_TO_CODE,
}


def judge_kind(judge: Judge) -> JudgeKind:
    """The kind of a judge, by its name in records."""
    return _KINDS[type(judge)]

"""Measures the quantities of a run: their values, their errors and their verdicts."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from vv.ask import Knobs, Method, Model, Run
from vv.base import metrics
from vv.case import (
    CodeToCode,
    Count,
    Exact,
    Interval,
    Invariant,
    Judge,
    Measured,
    Norm,
    Quantity,
    Scalar,
    Series,
    Shown,
    at_rest,
    error_scale,
    evaluated,
    judge_at_other_parameters,
    judge_for_method,
    shown_if_wide,
)
from vv.records.job_record import JobCost, ModelSummary, RunSummary
from vv.records.outcomes import QuantityKind, Verdict
from vv.records.quantity import MeasuredQuantity, MeasurementFacts, PrintedFacts, judge_kind
from vv.scene import Vector

NOT_REPORTED = Shown("the code does not report the data from which it is computed")
NORMS = {
    Norm.MAX: metrics.max_error,
    Norm.FINAL: metrics.final_error,
    Norm.POINTWISE: metrics.pointwise_error,
    Norm.L2: metrics.l2_error,
}


@dataclass(frozen=True)
class _Figures:
    """The numbers of a quantity, named as in MeasuredQuantity, and the arrays of its series."""

    value: float | None = None
    reference: float | None = None
    end: float | None = None
    errors: Mapping[Norm, float | None] = field(default_factory=dict)
    scale: float | None = None
    figures: Mapping[str, float | None] = field(default_factory=dict)
    note: str = ""
    arrays: Mapping[str, Vector] = field(default_factory=dict)


def measured(
    run: Run,
    quantity: Quantity,
    method: Method,
    knobs: Knobs,
    modified: bool = False,
    chosen: bool = False,
) -> tuple[MeasuredQuantity, Mapping[str, Vector]]:
    """A quantity of a run in the form of a record, and the arrays of its series.

    modified: the parameters are not the case's own; chosen: the setting is none of the case's.
    """
    judge = judge_for_method(quantity.judge, method)
    if modified:
        judge = judge_at_other_parameters(judge)
    if modified or chosen:
        judge = shown_if_wide(judge, method, knobs)
    if isinstance(quantity, Scalar) and not quantity.is_reported(run):
        judge = NOT_REPORTED
    made, arrays = _found(run, quantity, judge, method, knobs, modified or chosen)
    return dataclasses.replace(made, verdict=_verdict(quantity, judge, made)), arrays


def _found(
    run: Run, quantity: Quantity, judge: Judge, method: Method, knobs: Knobs, uncut: bool
) -> tuple[MeasuredQuantity, Mapping[str, Vector]]:
    """The quantity before its verdict, and the arrays of its series. uncut: see `_bound`."""
    norm, tolerance, why = _bound(judge, method, knobs, uncut)
    found = _figures(run, quantity, judge, method)
    made = MeasuredQuantity(
        name=quantity.name,
        kind=QuantityKind(type(quantity).__name__.lower()),
        unit="" if isinstance(quantity, Count) else quantity.unit,
        value=found.value,
        reference=found.reference,
        end=found.end,
        errors=found.errors,
        scale=found.scale,
        figures=found.figures,
        judge=judge_kind(judge),
        norm=norm,
        tolerance=tolerance,
        why=why,
        note=found.note,
        verdict=Verdict.NO_REFERENCE,
        measurement=_measurement(judge),
        printed=_printed(judge),
    )
    return made, found.arrays


def _bound(
    judge: Judge, method: Method, knobs: Knobs, uncut: bool
) -> tuple[Norm | None, float | None, str]:
    """How the quantity is judged: norm, bound, which may be uncut, and the reason for it."""
    if not isinstance(judge, Exact):
        return None, judge.bound if isinstance(judge, Invariant) else None, judge.reason
    tolerance = judge.tolerance(method)
    return judge.norm, tolerance.uncut(knobs) if uncut else tolerance.at(knobs), tolerance.reason


def _measurement(judge: Judge) -> MeasurementFacts | None:
    """The measurement in the form of a record; None for other judges."""
    if not isinstance(judge, Measured):
        return None
    return MeasurementFacts(**dataclasses.asdict(judge.measurement), band=judge.band)


def _printed(judge: Judge) -> PrintedFacts | None:
    """The answer of another code in the form of a record; None for other judges."""
    if not isinstance(judge, CodeToCode):
        return None
    return PrintedFacts(**dataclasses.asdict(judge.answer), band=judge.band)


def _figures(run: Run, quantity: Quantity, judge: Judge, method: Method) -> _Figures:
    if not isinstance(quantity, Series):
        return _Figures() if judge is NOT_REPORTED else _figures_of_number(run, quantity, judge)
    found = _figures_of_series(run, quantity)
    if method is not Method.EXACT and _copied(found.arrays, quantity.name):
        note = "identical to the reference to the last bit, which no approximate method can be"
        return dataclasses.replace(found, note=note)
    return found


def _figures_of_series(run: Run, quantity: Series) -> _Figures:
    value = np.asarray(quantity.observe(run), float)
    arrays = {"t": run.times, f"{quantity.name}.value": value}
    figures = {"final": _finite(value[-1]), "mean": _finite(value.mean())}
    if quantity.reference is None:
        size = _finite(np.abs(value).max()) or 1.0
        return _Figures(scale=size, figures=figures, arrays=arrays)
    reference = np.asarray(quantity.reference(run.times), float)
    rests = at_rest(float(np.abs(reference).max()), quantity.still)
    scale = quantity.still if rests and quantity.scale is None else quantity.scale
    scale = None if scale is None else error_scale(quantity.name, scale)
    errors = _errors(value, reference, scale, rests)
    note = "" if errors else "the reference is zero throughout, and the quantity states no scale"
    if np.ptp(value) == 0 and np.ptp(reference) > 0 and not rests:
        note = "nothing moves, though the reference does"
    return _Figures(
        end=_finite(reference[-1]),
        errors=errors,
        scale=_finite(scale or np.abs(reference).max()) or 1.0,
        figures=figures,
        note=note,
        arrays={**arrays, f"{quantity.name}.reference": reference},
    )


def _copied(arrays: Mapping[str, Vector], name: str) -> bool:
    """Whether a series that moves equals its reference to the last bit."""
    value, reference = arrays[f"{name}.value"], arrays.get(f"{name}.reference")
    same = reference is not None and np.array_equal(value, reference)
    return bool(same and np.ptp(value) > 0)


def _errors(
    value: Vector, reference: Vector, scale: float | None, rests: bool
) -> dict[Norm, float | None]:
    """The errors by norm; for a reference at rest only the error relative to the scale."""
    errors: dict[Norm, float | None] = {}
    if not rests:
        errors = {norm: _finite(f(value, reference)) for norm, f in NORMS.items()}
    if scale is not None:
        errors[Norm.MAX] = _finite(metrics.scaled_error(value, reference, scale))
    return errors


def error_in(norm: Norm, value: Vector, reference: Vector, scale: float) -> float:
    """The error of a series in a norm; the maximum norm is relative to `scale`."""
    if norm is Norm.MAX:
        return metrics.scaled_error(value, reference, scale)
    return NORMS[norm](value, reference)


def _figures_of_number(run: Run, quantity: Scalar | Count, judge: Judge) -> _Figures:
    """The value, scale and errors; a count that is only shown has no errors, hence no order."""
    value = quantity.observe(run)
    reference = None if quantity.reference is None else evaluated(quantity.reference)
    if isinstance(quantity, Scalar):
        scale = error_scale(quantity.name, quantity.scale)
    else:
        scale = float(max(1, abs(reference or 0)))
    errors: dict[Norm, float | None] = {}
    only_shown = isinstance(quantity, Count) and isinstance(judge, Shown)
    if reference is not None and not only_shown:
        errors = dict.fromkeys((Norm.MAX, Norm.FINAL), _finite(abs(value - reference) / scale))
    kept = _finite(value)
    return _Figures(
        value=kept, reference=reference, errors=errors, scale=scale, figures={"value": kept}
    )


def _verdict(quantity: Quantity, judge: Judge, found: MeasuredQuantity) -> Verdict:
    if isinstance(judge, Shown):
        return Verdict.NO_REFERENCE
    if isinstance(judge, Measured):
        return _by_band(judge.band, judge.measurement.value, found.value)
    if isinstance(judge, CodeToCode):
        return _by_band(judge.band, judge.answer.value, found.value)
    if isinstance(judge, Interval):
        good = found.value is not None and judge.low <= found.value <= judge.high
        return Verdict.PASS if good else Verdict.FAIL
    if quantity.reference is None:
        return Verdict.NO_REFERENCE
    error, bound = found.error, found.tolerance
    good = error is not None and bound is not None and error <= bound and not found.note
    return Verdict.PASS if good else Verdict.FAIL


def _by_band(band: float | None, middle: float, value: float | None) -> Verdict:
    """The verdict by a band; SHOWN without a band."""
    if band is None:
        return Verdict.NO_REFERENCE
    good = value is not None and abs(value - middle) <= band
    return Verdict.PASS if good else Verdict.FAIL


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def summarised(
    run: Run, quantities: tuple[MeasuredQuantity, ...], largest_step: float | None = None
) -> RunSummary:
    """The summary of a run with these quantities. largest_step: see RunSummary."""
    cost = JobCost(**dataclasses.asdict(run.cost))
    model = None if run.model is None else _model(run.model)
    return RunSummary(
        run.status, run.reason, cost, run.steps, model, run.ledger, quantities, largest_step
    )


def _model(model: Model) -> ModelSummary:
    terms = sorted(term.name.lower().replace("_", "-") for term in model.terms)
    return ModelSummary(model.unknowns, tuple(terms), model.note)

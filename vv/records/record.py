"""Turns a run into a record: is it whole, how far from the reference, within tolerance or not."""

from __future__ import annotations

import dataclasses
import enum
import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from vv.ask import Ask, Knobs, Ledger, Method, Run, Status
from vv.base import metrics
from vv.case import (
    Count,
    Exact,
    Interval,
    Invariant,
    Judge,
    Norm,
    Quantity,
    Scalar,
    Series,
    Shown,
    error_scale,
    evaluated,
    judge_for_method,
)
from vv.records.reading import error_of
from vv.scene import Vector

UNTOLD = Shown("this code tells nothing to take it from")
NORMS = {
    Norm.MAX: metrics.max_error,
    Norm.FINAL: metrics.final_error,
    Norm.POINTWISE: metrics.pointwise_error,
    Norm.L2: metrics.l2_error,
}


class Verdict(enum.Enum):
    """What a quantity of a run is worth; the value is the word in records."""

    PASS = "pass"
    FAIL = "fail"
    XFAIL = "xfail"
    XPASS = "xpass"
    NO_REFERENCE = "no-reference"


def checked(run: Run, ask: Ask) -> Run:
    """The run, or the failure it really is: terms left out, outputs missing, numbers not finite."""
    if run.status is not Status.RAN:
        return run
    if run.ledger and not all(map(math.isfinite, _energies(run.ledger))):
        return Run(Status.ERROR, "the energy ledger is not finite")
    return _observed(run, ask)


def _observed(run: Run, ask: Ask) -> Run:
    """The run, or the failure that it is for want of a term, an output or a finite number."""
    if run.model is None or ask.scene.terms() - run.model.terms:
        terms = ask.scene.terms() - (run.model.terms if run.model else frozenset())
        left_out = ", ".join(sorted(term.value for term in terms)) or "everything"
        return Run(Status.ERROR, f"the run does not say that it modelled: {left_out}")
    expected = ask.goal.times(ask.knobs.dt)
    same = run.times.shape == expected.shape
    if not same or not np.allclose(run.times, expected, rtol=1e-9, atol=0.0):
        return Run(Status.ERROR, f"reported {len(run.times)} of {len(expected)} output times")
    for observable in ask.observables:
        values = run.values.get(observable)
        if values is None or values.shape != (len(expected), 3):
            what = "not reported" if values is None else f"reported with shape {values.shape}"
            due = f"({len(expected)}, 3)"
            return Run(Status.ERROR, f"{observable} was asked in shape {due} and {what}")
        if not np.isfinite(values).all():
            first = expected[int(np.argmin(np.isfinite(values).all(axis=1)))]
            return Run(Status.DIVERGED, f"{observable} is not finite from t = {first:.6g} s")
    if ask.search is not None and not len(run.tried):
        return Run(Status.ERROR, "the run does not say which steps were tried")
    return _energetic(run, ask)


def _energetic(run: Run, ask: Ask) -> Run:
    """The run, or the failure that it is for want of a form of energy or of a finite number."""
    for form in ask.energies:
        energy, due = run.energies.get(form), run.times.shape
        if energy is None or energy.shape != due:
            what = "not reported" if energy is None else f"reported with shape {energy.shape}"
            return Run(Status.ERROR, f"energy '{form.value}' was asked in shape {due} and {what}")
        if not np.isfinite(energy).all():
            first = run.times[int(np.argmin(np.isfinite(energy)))]
            return Run(Status.DIVERGED, f"energy '{form.value}' is not finite from {first:.6g} s")
    return run


def _energies(ledger: Ledger) -> Iterator[float]:
    """Every number of a ledger."""
    yield from (*ledger.terms.values(), ledger.unaccounted, ledger.peak, ledger.bound or 0.0)
    yield from (evaluated for pair in ledger.audits.values() for evaluated in pair)


def measured(
    run: Run, quantity: Quantity, method: Method, knobs: Knobs
) -> tuple[dict[str, Any], dict[str, Vector]]:
    """A quantity of a run as a record entry, and the arrays of its series."""
    judge = judge_for_method(quantity.judge, method)
    if isinstance(quantity, Scalar) and not quantity.is_reported(run):
        judge = UNTOLD
    entry: dict[str, Any] = {
        "name": quantity.name,
        "kind": type(quantity).__name__.lower(),
        "unit": getattr(quantity, "unit", ""),
        "value": None,
        "reference": None,
        "end": None,
        "errors": {},
        "scale": None,
        "figures": {},
        "judge": type(judge).__name__.lower(),
        **_stated(judge, method, knobs),
    }
    if isinstance(quantity, Series):
        arrays = _measure_series(run, quantity, entry)
        if method is not Method.EXACT and _copied(arrays, quantity.name):
            entry["note"] = "bit by bit the reference itself, which no approximate method can be"
    else:
        arrays = {}
        if judge is not UNTOLD:
            _measure_number(run, quantity, judge, entry)
    entry["verdict"] = _verdict(quantity, judge, entry).value
    return entry, arrays


def _stated(judge: Judge, method: Method, knobs: Knobs) -> dict[str, Any]:
    """How the quantity is judged: norm, bound and the reason for it."""
    if isinstance(judge, Exact):
        tolerance = judge.tolerances[method]
        bound = tolerance.at(knobs)
        norm = judge.norm.name.lower()
        return {"norm": norm, "tolerance": bound, "why": tolerance.reason, "note": ""}
    limit = judge.bound if isinstance(judge, Invariant) else None
    return {"norm": None, "tolerance": limit, "why": judge.reason, "note": ""}


def _measure_series(run: Run, quantity: Series, entry: dict[str, Any]) -> dict[str, Vector]:
    value = np.asarray(quantity.observe(run), float)
    arrays = {"t": run.times, f"{quantity.name}.value": value}
    entry["figures"] = {"final": _finite(value[-1]), "mean": _finite(value.mean())}
    entry["scale"] = _finite(np.abs(value).max()) or 1.0
    if quantity.reference is None:
        return arrays
    reference = np.asarray(quantity.reference(run.times), float)
    scale = None if quantity.scale is None else error_scale(quantity.name, quantity.scale)
    entry["scale"] = _finite(scale or np.abs(reference).max()) or 1.0
    entry["end"] = _finite(reference[-1])
    entry["errors"] = _errors(value, reference, scale)
    if not entry["errors"]:
        entry["note"] = "the reference is zero throughout, and the quantity states no scale"
    if np.ptp(value) == 0 and np.ptp(reference) > 0:
        entry["note"] = "nothing moves, though the reference does"
    return {**arrays, f"{quantity.name}.reference": reference}


def _copied(arrays: dict[str, Vector], name: str) -> bool:
    """Whether a series that moves equals its reference to the last bit."""
    value, reference = arrays[f"{name}.value"], arrays.get(f"{name}.reference")
    same = reference is not None and np.array_equal(value, reference)
    return bool(same and np.ptp(value) > 0)


def _errors(value: Vector, reference: Vector, scale: float | None) -> dict[str, float | None]:
    """The errors by norm; against a reference of zeros only those that the scale gives."""
    errors: dict[str, float | None] = {}
    if np.abs(reference).max() > 0:
        errors = {norm.name.lower(): _finite(f(value, reference)) for norm, f in NORMS.items()}
    if scale is not None:
        errors[Norm.MAX.name.lower()] = _finite(metrics.scaled_error(value, reference, scale))
    return errors


def _measure_number(
    run: Run, quantity: Scalar | Count, judge: Judge, entry: dict[str, Any]
) -> None:
    """Value, scale and errors; a count that is only shown has none, and so no order in dt."""
    value = quantity.observe(run)
    entry["value"] = _finite(value)
    reference = None if quantity.reference is None else evaluated(quantity.reference)
    entry["reference"] = reference
    entry["figures"] = {"value": entry["value"]}
    if isinstance(quantity, Scalar):
        scale = error_scale(quantity.name, quantity.scale)
    else:
        scale = float(max(1, abs(reference or 0)))
    entry["scale"] = scale
    only_shown = isinstance(quantity, Count) and isinstance(judge, Shown)
    if reference is not None and not only_shown:
        error = _finite(abs(value - reference) / scale)
        entry["errors"] = {norm.name.lower(): error for norm in (Norm.MAX, Norm.FINAL)}


def _verdict(quantity: Quantity, judge: Judge, entry: dict[str, Any]) -> Verdict:
    if isinstance(judge, Shown):
        return Verdict.NO_REFERENCE
    if isinstance(judge, Interval):
        value = entry["value"]
        good = value is not None and judge.low <= value <= judge.high
        return Verdict.PASS if good else Verdict.FAIL
    if quantity.reference is None:
        return Verdict.NO_REFERENCE
    error = error_of(entry)
    bound = judge.bound if isinstance(judge, Invariant) else entry["tolerance"]
    good = error is not None and error <= bound and not entry["note"]
    return Verdict.PASS if good else Verdict.FAIL


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def described(run: Run) -> dict[str, Any]:
    """What a record says of a run besides its quantities."""
    model, ledger = run.model, run.ledger
    return {
        "status": run.status.name.lower().replace("_", "-"),
        "reason": run.reason,
        "cost": {**dataclasses.asdict(run.cost), "kind": "indicative"},
        "steps": run.steps,
        "model": model
        and {
            "unknowns": model.unknowns,
            "terms": sorted(term.name.lower().replace("_", "-") for term in model.terms),
            "note": model.note,
        },
        "ledger": ledger
        and {
            "terms": dict(ledger.terms),
            "unaccounted": ledger.unaccounted,
            "peak": ledger.peak,
            "bound": ledger.bound,
            "audits": {name: list(pair) for name, pair in ledger.audits.items()},
        },
    }

"""Turns a run into a record: is it whole, how far from the reference, within tolerance or not."""

from __future__ import annotations

import dataclasses
import enum
import math
from typing import Any

import numpy as np

from vv import metrics
from vv.ask import Ask, Knobs, Method, Run, Status
from vv.case import Count, Exact, Interval, Invariant, Norm, Quantity, Scalar, Series, Shown
from vv.scene import Vector

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
    if run.model is None or ask.scene.terms() - run.model.terms:
        terms = ask.scene.terms() - (run.model.terms if run.model else frozenset())
        left_out = ", ".join(sorted(term.value for term in terms)) or "everything"
        return Run(Status.ERROR, f"the run does not say that it modelled: {left_out}")
    expected = ask.goal.times(ask.knobs.dt)
    if run.times.shape != expected.shape or not np.allclose(run.times, expected, rtol=1e-9):
        return Run(Status.ERROR, f"reported {len(run.times)} of {len(expected)} output times")
    for observable in ask.observables:
        values = run.values.get(observable)
        if values is None or values.shape != (len(expected), 3):
            return Run(Status.ERROR, f"{observable} was asked and not reported")
        if not np.isfinite(values).all():
            first = expected[int(np.argmin(np.isfinite(values).all(axis=1)))]
            return Run(Status.DIVERGED, f"{observable} is not finite from t = {first:.6g} s")
    return run


def measured(
    run: Run, quantity: Quantity, method: Method, knobs: Knobs
) -> tuple[dict[str, Any], dict[str, Vector]]:
    """A quantity of a run as a record entry, and the arrays of its series."""
    entry: dict[str, Any] = {
        "name": quantity.name,
        "kind": type(quantity).__name__.lower(),
        "unit": getattr(quantity, "unit", ""),
        "value": None,
        "reference": None,
        "errors": {},
        "judge": type(quantity.judge).__name__.lower(),
        **_stated(quantity, method, knobs),
    }
    if isinstance(quantity, Series):
        arrays = _measure_series(run, quantity, entry)
    else:
        arrays = {}
        _measure_number(run, quantity, entry)
    entry["verdict"] = _verdict(quantity, entry).value
    return entry, arrays


def _stated(quantity: Quantity, method: Method, knobs: Knobs) -> dict[str, Any]:
    """How the quantity is judged: norm, bound and the reason for it."""
    judge = quantity.judge
    if isinstance(judge, Exact):
        tolerance = judge.tolerances.get(method)
        if tolerance is None:
            raise ValueError(f"quantity '{quantity.name}' has no tolerance for {method.value}")
        bound = tolerance.at(knobs)
        norm = judge.norm.name.lower()
        return {"norm": norm, "tolerance": bound, "why": tolerance.reason, "note": ""}
    limit = judge.bound if isinstance(judge, Invariant) else None
    return {"norm": None, "tolerance": limit, "why": judge.reason, "note": ""}


def _measure_series(run: Run, quantity: Series, entry: dict[str, Any]) -> dict[str, Vector]:
    value = np.asarray(quantity.observe(run), float)
    arrays = {"t": run.times, f"{quantity.name}.value": value}
    if quantity.reference is None:
        return arrays
    reference = np.asarray(quantity.reference(run.times), float)
    entry["errors"] = {n.name.lower(): _finite(f(value, reference)) for n, f in NORMS.items()}
    if np.ptp(value) == 0 and np.ptp(reference) > 0:
        entry["note"] = "nothing moves, though the reference does"
    return {**arrays, f"{quantity.name}.reference": reference}


def _measure_number(run: Run, quantity: Scalar | Count, entry: dict[str, Any]) -> None:
    value = quantity.observe(run)
    entry["value"] = _finite(value)
    entry["reference"] = quantity.reference
    if quantity.reference is not None:
        scale = quantity.scale if isinstance(quantity, Scalar) else max(1, abs(quantity.reference))
        error = _finite(abs(value - quantity.reference) / scale)
        entry["errors"] = {norm.name.lower(): error for norm in (Norm.MAX, Norm.FINAL)}


def _verdict(quantity: Quantity, entry: dict[str, Any]) -> Verdict:
    judge = quantity.judge
    if isinstance(judge, Shown):
        return Verdict.NO_REFERENCE
    if isinstance(judge, Interval):
        value = entry["value"]
        good = value is not None and judge.low <= value <= judge.high
        return Verdict.PASS if good else Verdict.FAIL
    if quantity.reference is None:
        return Verdict.NO_REFERENCE
    error = entry["errors"].get(entry["norm"] or "max")
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
        },
    }

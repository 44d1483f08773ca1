"""Claims about numbers, counts and values without a reference as records judge them, by hand."""

import math
from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

import pytest

from tests.support.records.measured_runs import (
    EXACTLY,
    LEDGER,
    SECOND,
    ledger,
    run,
)
from vv.ask import (
    Knobs,
    Method,
    Status,
)
from vv.case import Count, Exact, Interval, Invariant, Judge, Norm, Scalar, Shown, Tolerance
from vv.records.checking import within
from vv.records.job_record import RunSummary
from vv.records.outcomes import JudgeKind, Verdict
from vv.records.quantity import MeasuredQuantity
from vv.records.record import _by_band, measured, summarised


def number(value: float, reference: float | None, judge: Judge, **more: Any) -> MeasuredQuantity:
    quantity = Scalar("e", "e", "J", "energy", lambda run: value, reference, 2.0, judge, **more)
    return measured(run(), quantity, SECOND, Knobs(0.25))[0]


INSIDE, CONSERVED = Interval(1.0, 3.0, "why"), Invariant(0.1, "why")


@pytest.mark.parametrize(
    ("value", "reference", "judge", "verdict"),
    [
        (2.0, None, INSIDE, "PASS"),
        (1.0, None, INSIDE, "PASS"),
        (3.0, None, INSIDE, "PASS"),
        (0.99, None, INSIDE, "FAIL"),
        (3.01, None, INSIDE, "FAIL"),
        (math.nan, None, INSIDE, "FAIL"),
        (5.19, 5.0, CONSERVED, "PASS"),  # over the scale, 2
        (4.81, 5.0, CONSERVED, "PASS"),
        (5.21, 5.0, CONSERVED, "FAIL"),
        (4.79, 5.0, CONSERVED, "FAIL"),
        (math.nan, 5.0, CONSERVED, "FAIL"),
        (5.019, 5.0, EXACTLY, "PASS"),
        (5.021, 5.0, EXACTLY, "FAIL"),
        (5.0, 5.0, Shown("why"), "NO_REFERENCE"),
        (5.0, 5.0, Exact({Method.EXACT: Tolerance(1e-9, "x")}), "NO_REFERENCE"),
    ],
)
def test_a_number_is_judged_by_both_sides_of_its_bound(
    value: float, reference: float | None, judge: Judge, verdict: str
) -> None:
    assert number(value, reference, judge).verdict is Verdict[verdict]


def test_the_error_of_a_number_is_over_its_scale_with_the_bound_beside_it() -> None:
    found = number(5.5, 5.0, EXACTLY)
    assert (found.value, found.reference, found.scale, found.tolerance) == (5.5, 5.0, 2.0, 1e-2)
    assert (found.errors, found.norm) == ({Norm.MAX: 0.25, Norm.FINAL: 0.25}, Norm.MAX)
    assert (found.figures, found.why) == ({"value": 5.5}, "why")
    bounded = number(5.5, 5.0, CONSERVED)
    assert (bounded.tolerance, bounded.norm, bounded.error) == (0.1, None, 0.25)
    assert number(5.5, None, INSIDE).tolerance is None


def test_what_a_code_does_not_report_is_not_judged() -> None:
    for reported in (True, False):
        found = number(9.0, 5.0, CONSERVED, is_reported=lambda run: reported)  # noqa: B023
        assert (found.judge is JudgeKind.SHOWN) is not reported
        assert (found.verdict is Verdict.FAIL) is reported


@pytest.mark.parametrize(
    ("seen", "exact", "judge", "verdict", "errors"),
    [
        (31, 31, EXACTLY, "PASS", {Norm.MAX: 0.0, Norm.FINAL: 0.0}),
        (30, 31, EXACTLY, "FAIL", {Norm.MAX: 1 / 31, Norm.FINAL: 1 / 31}),
        (1, 0, EXACTLY, "FAIL", {Norm.MAX: 1.0, Norm.FINAL: 1.0}),  # over one
        (30, 31, Shown("why"), "NO_REFERENCE", {}),
        (30, None, Shown("why"), "NO_REFERENCE", {}),
    ],
)
def test_a_count_is_compared_exactly(
    seen: int, exact: int | None, judge: Judge, verdict: str, errors: Mapping[Norm, float]
) -> None:
    quantity = Count("n", "n", "collisions", lambda run: seen, exact, judge)
    found = measured(run(), quantity, SECOND, Knobs(0.25))[0]
    assert (found.verdict, found.errors, found.unit) == (Verdict[verdict], errors, "")


def test_a_summary_says_what_the_run_was() -> None:
    found: RunSummary = summarised(run(ledger=LEDGER), ())
    assert (found.status, found.steps, found.ledger) == (Status.RAN, 4, LEDGER)
    assert found.cost.solve_cpu == 1e-3
    assert found.model is not None
    assert (found.model.unknowns, found.model.terms) == (1, ("gravity", "sphere"))
    assert summarised(run(model=None), ()).model is None


@pytest.mark.parametrize(
    ("value", "band", "verdict"),
    [
        (2.25, 0.25, "pass"),
        (1.75, 0.25, "pass"),
        (2.3, 0.25, "fail"),
        (1.7, 0.25, "fail"),
        (-2.0, 0.25, "fail"),
        (None, 0.25, "fail"),
        (9.0, None, "shown only"),
        (None, None, "shown only"),
    ],
)
def test_a_value_lies_within_its_band_or_is_shown_without_one(
    value: float | None, band: float | None, verdict: str
) -> None:
    assert _by_band(band, 2.0, value).value == verdict


@pytest.mark.parametrize(
    ("own", "unexplained", "bound"),
    [(1e-9, None, 1e-9), (1e-9, 1e-3, 1e-3), (1e-2, 1e-3, 1e-2), (None, 1e-3, None)],
)
def test_the_larger_of_two_bounds_holds_of_what_no_term_explains(
    own: float | None, unexplained: float | None, bound: float | None
) -> None:
    allowed: Any = unexplained and SimpleNamespace(at=lambda method, knobs: unexplained)
    found = within(run(ledger=ledger(bound=own)), allowed, Method.EXACT, Knobs())
    assert found.ledger is not None
    assert found.ledger.bound == bound
    bare = run(ledger=None)
    assert within(bare, allowed, Method.EXACT, Knobs()) is bare

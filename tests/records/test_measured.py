"""What becomes of a run: whole or not, how far off, and its verdict; tables written by hand."""

import dataclasses
import math
from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from vv.ask import (
    Ask,
    Bracket,
    Cost,
    Displacement,
    History,
    Knobs,
    Ledger,
    Method,
    Model,
    Run,
    Status,
    Velocity,
)
from vv.case import Count, Exact, Interval, Invariant, Judge, Norm, Scalar, Series, Shown, Tolerance
from vv.records.checking import checked, within
from vv.records.job_record import RunSummary
from vv.records.outcomes import JudgeKind, Verdict
from vv.records.quantity import MeasuredQuantity
from vv.records.record import _by_band, measured, summarised
from vv.scene import Contact, Form, Scene, Spheres, Term, Vector  # fmt: skip

WAY, SPEED = Displacement(0), Velocity(0)
BALL = Spheres(
    position=np.zeros((1, 3)),
    velocity=np.zeros((1, 3)),
    radius=np.ones(1),
    mass=np.ones(1),
    free=np.ones((1, 3), bool),
)
SCENE = Scene((BALL,), Contact(1e4), gravity=np.array([0.0, 0.0, -9.81]))
ASK = Ask(SCENE, History(1.0, 0.25), (WAY,), Knobs(0.25), energies=(Form.KINETIC,))
TIMES: Vector = np.array([0.0, 0.25, 0.5, 0.75, 1.0])
WHOLE = np.ones((5, 3))
SECOND = Method.SECOND_ORDER
EXACTLY = Exact({SECOND: Tolerance(1e-2, "why")})
POINT = Model(1, SCENE.terms(), "a point")


def run(**changes: Any) -> Run:
    whole = Run(
        Status.RAN, "", TIMES, {WAY: WHOLE}, Cost(solve_cpu=1e-3), 4, POINT, None,
        {Form.KINETIC: np.ones(5)},
    )  # fmt: skip
    return dataclasses.replace(whole, **changes)


def holed(shape: tuple[int, ...], at: int | tuple[int, ...], value: float = math.nan) -> Vector:
    made = np.ones(shape)
    made[at] = value
    return made


def ledger(**changes: Any) -> Ledger:
    return dataclasses.replace(LEDGER, **changes)


LEDGER = Ledger({"kinetic energy": 1.0}, 0.0, 1.0, 1e-9, {"Coulomb": (0.0, 1.0)})


@pytest.mark.parametrize(
    ("changes", "status", "said"),
    [
        ({}, "RAN", ""),
        ({"status": Status.REFUSED, "reason": "no", "model": None}, "REFUSED", "no"),
        ({"model": None}, "ERROR", "modelled: gravity, spheres"),
        ({"model": Model(1, frozenset({Term.GRAVITY}))}, "ERROR", "modelled: spheres"),
        ({"model": Model(1, SCENE.terms() | {Term.DRAG})}, "RAN", ""),  # more than asked
        ({"times": TIMES[:-1]}, "ERROR", "reported 4 of 5 output times"),
        ({"times": 1.01 * TIMES}, "ERROR", "output times"),
        ({"times": TIMES * (1 + 1e-8)}, "ERROR", "output times"),
        ({"times": TIMES * (1 + 1e-10)}, "RAN", ""),
        ({"values": {}}, "ERROR", "not reported"),
        ({"values": {SPEED: WHOLE}}, "ERROR", "not reported"),
        ({"values": {WAY: WHOLE[:4]}}, "ERROR", "shape (4, 3)"),
        ({"values": {WAY: holed((5, 3), 2)}}, "DIVERGED", "not finite from t = 0.5 s"),
        ({"values": {WAY: holed((5, 3), (2, 1))}}, "DIVERGED", "not finite from t = 0.5 s"),
        ({"values": {WAY: np.full((5, 3), 1e300)}}, "DIVERGED", "beyond 1e+100 from t = 0 s"),
        ({"values": {WAY: holed((5, 3), 3, math.inf)}}, "DIVERGED", "from t = 0.75 s"),
        ({"energies": {}}, "ERROR", "not reported"),
        ({"energies": {Form.KINETIC: np.ones(4)}}, "ERROR", "shape (4,)"),
        ({"energies": {Form.KINETIC: holed((5,), 1)}}, "DIVERGED", "not finite from t = 0.25 s"),
        ({"ledger": LEDGER}, "RAN", ""),
        ({"ledger": ledger(unaccounted=math.nan)}, "ERROR", "ledger"),
        ({"ledger": ledger(peak=math.inf)}, "ERROR", "ledger"),
        ({"ledger": ledger(bound=math.nan)}, "ERROR", "ledger"),
        ({"ledger": ledger(bound=None)}, "RAN", ""),
        ({"ledger": ledger(terms={"a": 1.0, "b": math.nan})}, "ERROR", "ledger"),
        ({"ledger": ledger(audits={"a": (math.nan, 1.0)})}, "ERROR", "ledger"),
    ],
)  # fmt: skip
def test_a_run_is_whole_or_the_failure_that_it_really_is(
    changes: dict[str, Any], status: str, said: str
) -> None:
    found = checked(run(**changes), ASK)
    assert found.status is Status[status]
    assert said in found.reason


@pytest.mark.parametrize(
    ("tried", "whole"),
    [
        (np.zeros((0, 2)), False),
        (np.array([[0.25, 1.0]]), True),
        (np.array([[0.25, 1.0, 2.0]]), False),
        (np.array([0.25, 1.0]), False),
    ],
)
def test_a_search_says_which_steps_were_tried(tried: Vector, whole: bool) -> None:
    searching = dataclasses.replace(ASK, search=Bracket(8.0, 1.0))
    found = checked(run(tried=tried), searching)
    assert found.status is (Status.RAN if whole else Status.ERROR)
    assert checked(run(tried=np.zeros((0, 2))), ASK).status is Status.RAN


def way(run: Run) -> Vector:
    return np.asarray(run.values[WAY][:, 0])


def series(values: Vector, reference: Vector | None, judge: Judge, **more: Any) -> MeasuredQuantity:
    exact = None if reference is None else lambda t: reference
    quantity = Series("x", "x", "m", "way", way, exact, judge, **more)
    made = run(values={WAY: np.stack([values] * 3, axis=1)})
    return measured(made, quantity, SECOND, Knobs(0.25))[0]


RAMP = np.array([0.0, 1.0, 2.0, 3.0, 4.0])
NIL = np.zeros(5)


@pytest.mark.parametrize(
    ("values", "reference", "verdict", "error", "note"),
    [
        (RAMP * 1.009, RAMP, "PASS", 0.009, ""),
        (RAMP * 1.011, RAMP, "FAIL", 0.011, ""),
        (RAMP, RAMP, "FAIL", 0.0, "identical to the reference to the last bit"),
        (NIL, RAMP, "FAIL", 1.0, "nothing moves"),
        (NIL + 2.0, RAMP, "FAIL", 0.5, "nothing moves"),
        (NIL, NIL, "FAIL", None, "the reference is zero throughout"),
        (RAMP, NIL + 4.0, "FAIL", 1.0, ""),
        (NIL + 4.0, NIL + 4.0, "PASS", 0.0, ""),  # both stand still, off zero
    ],
)
def test_a_series_is_judged_by_its_largest_error_over_the_largest_reference(
    values: Vector, reference: Vector, verdict: str, error: float | None, note: str
) -> None:
    found = series(values, reference, EXACTLY)
    assert found.verdict is Verdict[verdict]
    assert found.error == (error if error is None else pytest.approx(error, abs=1e-15))
    assert note in found.note
    assert bool(found.note) is bool(note)


def test_only_an_exact_method_may_give_the_reference_itself() -> None:
    judge = Exact({Method.EXACT: Tolerance(1e-9, "rounding")})
    quantity = Series("x", "x", "m", "way", way, lambda t: RAMP, judge)
    made = run(values={WAY: np.stack([RAMP] * 3, axis=1)})
    assert measured(made, quantity, Method.EXACT, Knobs())[0].verdict is Verdict.PASS


def test_a_series_keeps_its_final_value_its_mean_the_reference_s_end_and_its_arrays() -> None:
    quantity = Series("x", "x", "m", "way", way, lambda t: RAMP, EXACTLY)
    made = run(values={WAY: np.stack([1.5 * RAMP] * 3, axis=1)})
    found, arrays = measured(made, quantity, SECOND, Knobs(0.25))
    assert (found.figures, found.end, found.scale) == ({"final": 6.0, "mean": 3.0}, 4.0, 4.0)
    assert found.errors[Norm.FINAL] == found.errors[Norm.L2] == found.errors[Norm.MAX] == 0.5
    assert list(arrays) == ["t", "x.value", "x.reference"]
    np.testing.assert_array_equal(arrays["x.reference"], RAMP)
    np.testing.assert_array_equal(arrays["t"], TIMES)


def test_a_series_without_a_reference_is_shown_over_its_own_size() -> None:
    found = series(-2.0 * RAMP, None, Shown("why"))
    assert (found.verdict, found.scale, found.errors) == (Verdict.NO_REFERENCE, 8.0, {})
    assert series(NIL, None, Shown("why")).scale == 1.0


@pytest.mark.parametrize(
    ("reference", "more", "error", "scale"),
    [
        (RAMP, {"scale": 8.0}, 0.05, 8.0),  # a scale in place of the reference's size
        (RAMP, {"still": 10.0}, 0.1, 4.0),  # which moves
        (NIL, {"still": 10.0}, 0.04, 10.0),
        (1e-12 * RAMP, {"still": 10.0}, 0.04, 10.0),  # rounding of what stands still
        (1e-12 * RAMP, {"still": 10.0, "scale": 20.0}, 0.02, 20.0),
    ],
)
def test_errors_are_relative_to_the_scale_that_a_series_states(
    reference: Vector, more: dict[str, float], error: float, scale: float
) -> None:
    found = series(reference + 0.1 * RAMP, reference, EXACTLY, **more)
    assert found.error == pytest.approx(error)
    assert found.scale == pytest.approx(scale)


def test_a_way_that_stands_still_where_nothing_should_move_passes() -> None:
    assert series(NIL, 1e-13 * RAMP, EXACTLY, still=10.0).verdict is Verdict.PASS


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
        (9.0, None, "no-reference"),
        (None, None, "no-reference"),
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

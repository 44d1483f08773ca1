"""What becomes of a run: whole or not, how far off, and its verdict; tables written by hand."""

import dataclasses
import math
from typing import Any

import numpy as np
import pytest

from tests.support.records.measured_runs import (
    ASK,
    EXACTLY,
    LEDGER,
    SCENE,
    SECOND,
    TIMES,
    WAY,
    WHOLE,
    ledger,
    run,
)
from vv.ask import (
    Bracket,
    Knobs,
    Method,
    Model,
    Run,
    Status,
    Velocity,
)
from vv.case import Exact, Judge, Norm, Series, Shown, Tolerance
from vv.records.checking import checked
from vv.records.outcomes import Verdict
from vv.records.quantity import MeasuredQuantity
from vv.records.record import measured
from vv.scene import Form, Term, Vector  # fmt: skip


def holed(shape: tuple[int, ...], at: int | tuple[int, ...], value: float = math.nan) -> Vector:
    made = np.ones(shape)
    made[at] = value
    return made


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
        ({"values": {Velocity(0): WHOLE}}, "ERROR", "not reported"),
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

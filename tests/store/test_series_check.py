"""Series count only beside the figures that were measured of them: truths by hand, each broken."""

import math
import re
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from tests.support.fabricated import changed, entry
from vv.records.quantity import MeasuredQuantity
from vv.scene import Vector
from vv.store.series_check import check_series

# 4.4 instead of 4: 0.4 off at last; 2.0 in place of 1.6 before: 0.4 of 4 at most, 0.25 of itself
ARRAYS = {
    "t": np.array([0.0, 1.0, 2.0]),
    "y.value": np.array([1.0, 2.0, 4.4]),
    "y.reference": np.array([1.0, 1.6, 4.0]),
}
ERRORS = {
    "max": 0.4 / 4,
    "final": 0.1,
    "pointwise": 0.4 / 1.6,
    "l2": math.sqrt(0.32 / (1 + 1.6**2 + 16)),
}
FIGURES = {"final": 4.4, "mean": 7.4 / 3}
MEASURED = entry("fail", ERRORS, scale=4.0, end=4.0, figures=FIGURES)
ALONE = entry("no-reference", {}, figures=FIGURES)


def without(name: str) -> dict[str, Vector]:
    return {key: array for key, array in ARRAYS.items() if key != name}


@pytest.mark.parametrize(
    ("arrays", "quantities"),
    [
        (ARRAYS, [MEASURED]),
        (without("y.reference"), [ALONE]),
        ({}, []),
        ({}, [entry("pass", {"max": 0.1}, kind="scalar")]),
        (ARRAYS, [MEASURED, entry("pass", {"max": 0.1}, name="n", kind="count")]),
        ({**ARRAYS, "t": np.arange(3)}, [MEASURED]),
        (ARRAYS, [entry("fail", {"max": 0.4 / 8}, scale=8.0, end=4.0)]),
        ({"t": ARRAYS["t"], "z.value": ARRAYS["t"]}, [changed(ALONE, name="z", figures={})]),
        ({**ARRAYS, "y.value": ARRAYS["y.value"] * (1 + 1e-13)}, [MEASURED]),
    ],
)  # fmt: skip
def test_series_beside_their_own_figures_count(
    arrays: Mapping[str, Any], quantities: list[MeasuredQuantity]
) -> None:
    check_series(arrays, quantities)


def test_an_error_that_is_not_finite_is_said_to_be_unknown() -> None:
    ends_at_zero = {**ARRAYS, "y.reference": np.array([1.0, 1.6, 0.0])}
    said = {"max": 4.4 / 1.6, "final": None}
    check_series(ends_at_zero, [entry("fail", said, scale=1.6, end=0.0)])
    with pytest.raises(
        ValueError, match=r"the \|e\| / \|ref\| at the final time error of y is nan"
    ):
        check_series(ends_at_zero, [entry("fail", {**said, "final": 0.1}, scale=1.6, end=0.0)])
    holed = {**ARRAYS, "y.reference": np.array([1.0, np.nan, 4.0])}
    check_series(holed, [entry("fail", {"max": None, "final": 0.1}, scale=4.0, end=4.0)])


@pytest.mark.parametrize(
    ("arrays", "said"),
    [
        (without("t"), "it holds y.reference, y.value instead of t, y.reference, y.value"),
        (without("y.reference"), "it holds t, y.value instead of"),
        ({}, "it holds nothing instead of t"),
        ({**ARRAYS, "z.value": ARRAYS["t"]}, "it holds t, y.reference, y.value, z.value instead"),
        ({name: array[:0] for name, array in ARRAYS.items()}, "t is not a series with a number"),
        (
            {**ARRAYS, "y.value": np.ones((3, 1))},
            "y.value is not a series with a number at each time",
        ),
        ({**ARRAYS, "y.value": np.array(["1", "2", "4"])}, "y.value is not a series with a number"),
        ({**ARRAYS, "t": ARRAYS["t"][:2]}, "y.value is not a series with a number at each time"),
        ({**ARRAYS, "t": ARRAYS["t"][:, None]}, "t is not a series with a number at each time"),
        (
            {**ARRAYS, "y.value": np.array([1.0, 2.0, 4.5])},
            "final of y is 4.5, its record says 4.4",
        ),
        ({**ARRAYS, "y.value": np.array([1.0, 2.1, 4.4])}, "mean of y is 2.5"),
        ({**ARRAYS, "y.value": np.array([1.0, np.nan, 4.4])}, "mean of y is nan"),
        ({**ARRAYS, "y.reference": np.array([1.0, 1.6, 4.1])}, "the end of y is 4.1"),
    ],
)
def test_series_of_another_form_or_with_other_figures_count_not(
    arrays: Mapping[str, Any], said: str
) -> None:
    with pytest.raises(ValueError, match=re.escape(said)):
        check_series(arrays, [MEASURED])


@pytest.mark.parametrize("norm", ERRORS)
@pytest.mark.parametrize("factor", [1 - 1e-6, 1 + 1e-6, -1.0, None])
def test_each_error_is_that_of_the_series(norm: str, factor: float | None) -> None:
    wrong = {**ERRORS, norm: None if factor is None else factor * ERRORS[norm]}
    with pytest.raises(ValueError, match="error of y is"):
        check_series(ARRAYS, [changed(MEASURED, errors=wrong)])


@pytest.mark.parametrize(
    "change",
    [{"scale": None}, {"scale": 5.0}, {"figures": {"final": 4.4, "peak": 4.4}}, {"end": None}],
)
def test_what_a_record_says_besides_is_that_of_the_series(change: dict[str, object]) -> None:
    with pytest.raises(ValueError, match="its record says"):
        check_series(ARRAYS, [changed(MEASURED, **change)])

"""Norms and observed orders, on data whose answers are known."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vv.base.metrics import (
    count_before_floor,
    final_error,
    l2_error,
    max_error,
    observed_order,
    pointwise_error,
    pointwise_history,
    scaled_error,
)

T = np.linspace(0.0, 1.0, 101)
REFERENCE = np.sin(7.0 * T)
NORMS = (max_error, l2_error, final_error, pointwise_error)


@pytest.mark.parametrize("norm", NORMS)
def test_a_uniform_relative_error_is_itself_in_every_norm(norm) -> None:  # type: ignore[no-untyped-def]
    assert norm(1.01 * REFERENCE, REFERENCE) == pytest.approx(0.01)


@pytest.mark.parametrize("norm", NORMS)
def test_a_perfect_answer_has_no_error(norm) -> None:  # type: ignore[no-untyped-def]
    assert norm(REFERENCE, REFERENCE) == 0.0


@pytest.mark.parametrize(
    ("value", "largest", "mean_square", "final", "pointwise"),
    [
        ([2.0, 4.0, -8.0], 0.0, 0.0, 0.0, 0.0),
        ([2.0, 6.0, -8.0], 0.25, 2 / 84**0.5, 0.0, 0.5),  # too much
        ([2.0, 2.0, -8.0], 0.25, 2 / 84**0.5, 0.0, 0.5),  # too little
        ([2.0, 4.0, -6.0], 0.25, 2 / 84**0.5, 0.25, 0.25),  # at the end, on either side
        ([2.0, 4.0, -10.0], 0.25, 2 / 84**0.5, 0.25, 0.25),
        ([1.0, 4.0, -8.0], 0.125, 1 / 84**0.5, 0.0, 0.5),  # where little is due
        ([3.0, 1.0, -8.0], 0.375, 10**0.5 / 84**0.5, 0.0, 0.75),  # the worst of two
        ([2.0, 4.0, 8.0], 2.0, 16 / 84**0.5, 2.0, 2.0),  # the wrong way
    ],
)
def test_each_norm_of_a_few_numbers_by_hand(
    value: list[float], largest: float, mean_square: float, final: float, pointwise: float
) -> None:
    reference = np.array([2.0, 4.0, -8.0])
    found = [norm(np.array(value), reference) for norm in NORMS]
    assert found == pytest.approx([largest, mean_square, final, pointwise])
    assert scaled_error(np.array(value), reference, 4.0) == pytest.approx(2 * largest)


def test_the_final_error_has_no_measure_where_the_end_is_due_at_zero() -> None:
    assert math.isnan(final_error(np.array([1.0, 0.5]), np.array([1.0, 0.0])))


@pytest.mark.parametrize(
    ("errors", "free"),
    [
        ([1.0, 0.5, 0.25, 0.125], 4),
        ([1.0, 0.5, 0.4, 0.35], 1),  # two refinements that gain less than 1.5 times
        ([1.0, 0.5, 0.25, 0.2], 4),  # one alone is no floor
        ([1.0, 0.9, 0.8, 0.2], 4),  # it gained again
        ([1.0, 1.0, 1.0], 0),
        ([1.0, 0.5, 0.25, 0.24, 0.23, 0.25], 2),  # from the first of them on
    ],
)
def test_a_floor_begins_where_two_refinements_gain_too_little(
    errors: list[float], free: int
) -> None:
    assert count_before_floor(errors) == free


@given(st.floats(-6, 6), st.floats(1e-6, 1e6))
def test_relative_errors_do_not_depend_on_units(power: float, offset: float) -> None:
    unit = 10.0**power
    value = REFERENCE + offset * 1e-8
    assert max_error(unit * value, unit * REFERENCE) == pytest.approx(max_error(value, REFERENCE))


def test_the_pointwise_error_leaves_out_zero_crossings() -> None:
    value = REFERENCE + 1e-3
    crossing = np.argmin(np.abs(REFERENCE[5:])) + 5
    assert math.isnan(pointwise_history(value, REFERENCE)[crossing])
    assert pointwise_error(value, REFERENCE) <= 1e-3 / 0.01 / np.abs(REFERENCE).max() + 1e-12
    assert pointwise_error(value, REFERENCE) > max_error(value, REFERENCE)


def test_the_pointwise_error_counts_from_a_hundredth_of_the_largest_reference_on() -> None:
    reference = np.array([2.0, 0.0201, 0.0199])
    value = np.array([2.0, 1.5 * 0.0201, 3.0 * 0.0199])
    assert pointwise_error(value, reference) == pytest.approx(0.5)
    assert pointwise_history(value, reference) == pytest.approx([0.0, 0.5, math.nan], nan_ok=True)


def test_a_reference_of_zeros_has_no_relative_error() -> None:
    with pytest.raises(ValueError, match=r"max\|reference\| = 0.0"):
        max_error(REFERENCE, np.zeros_like(REFERENCE))


@given(st.floats(0.5, 4.0), st.floats(1e-3, 1e3))
def test_a_power_law_gives_back_its_order(order: float, constant: float) -> None:
    steps = [1e-2, 5e-3, 1e-3, 2e-4]
    fitted = observed_order(steps, [constant * h**order for h in steps])
    assert fitted is not None
    assert fitted.order == pytest.approx(order, abs=1e-9)
    assert fitted.spread == pytest.approx(0.0, abs=1e-6)


def test_scatter_shows_in_the_spread_of_the_order() -> None:
    fitted = observed_order([1.0, 0.1, 0.01], [1.0, 0.02, 1e-4])
    assert fitted is not None
    x = np.log([1.0, 0.1, 0.01])
    slope, covariance = np.polyfit(x, np.log([1.0, 0.02, 1e-4]), 1, cov=True)
    assert fitted.order == pytest.approx(slope[0])
    assert fitted.spread == pytest.approx(math.sqrt(covariance[0, 0]))


def test_one_step_or_errors_of_zero_give_no_order() -> None:
    assert observed_order([0.1, 0.1], [1.0, 2.0]) is None
    assert observed_order([0.1, 0.01], [1.0, 0.0]) is None

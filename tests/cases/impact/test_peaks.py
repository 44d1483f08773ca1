"""Claims about the largest values of smooth data and their rates, by hand."""

import numpy as np
import pytest

from cases.impact.parts._peaks import growth, smooth_maximum

PARABOLA = 3.0 - (np.arange(6.0) - 2.25) ** 2


def test_the_top_of_a_parabola_lies_between_rows() -> None:
    assert smooth_maximum(PARABOLA) == pytest.approx(3.0)


@pytest.mark.parametrize("rows", [PARABOLA[2:], PARABOLA[:3]])
def test_at_an_end_the_parabola_goes_through_the_last_three_rows(rows: np.ndarray) -> None:
    """Its top lies in the first row's stead, within a quarter of the spacing, or beyond."""
    assert smooth_maximum(rows) == pytest.approx(3.0)


def test_rows_that_grow_to_the_end_have_their_largest_of_the_three() -> None:
    assert smooth_maximum(np.array([0.0, 1.0, 4.0, 9.0])) == 4.0  # no top: it bends upwards


def test_growth_is_that_of_a_polynomial_of_degree_four_at_its_own_times() -> None:
    t = 0.5 * np.arange(7.0)
    assert growth(t**4 - t**3 + 2 * t, 0.5) == pytest.approx((4 * t**3 - 3 * t**2 + 2)[2:-2])

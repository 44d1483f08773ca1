"""Claims about event location: the first descent of a polynomial, and none where it grazes zero."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vv.engines.exact.roots import first_descent_below_zero

BAND = 1e-13
ROOTS = st.lists(st.floats(0.02, 3.0), min_size=1, max_size=6)


def from_roots(roots: list[float]) -> list[float]:
    """Coefficients, lowest first, of the product of (1 - x/root), which is 1 at x = 0."""
    c = np.ones(1)
    for root in roots:
        c = np.convolve(c, [1.0, -1.0 / root])
    return [float(x) for x in c]


@given(ROOTS)
def test_the_first_fall_is_found_whatever_comes_after(roots: list[float]) -> None:
    apart = [root + 0.05 * rank for rank, root in enumerate(sorted(roots[:4]))]
    found = first_descent_below_zero(from_roots(apart), BAND, 1.0)
    assert found == (pytest.approx(apart[0], rel=1e-8) if apart[0] < 1 else None)


@pytest.mark.parametrize("apart", [1e-2, 1e-4, 1e-6])
def test_two_falls_close_together_are_not_taken_for_none(apart: float) -> None:
    found = first_descent_below_zero(from_roots([0.4, 0.4 + apart, 0.9]), BAND, 1.0)
    assert found == pytest.approx(0.4, abs=1e-3 * apart)


@given(ROOTS)
def test_a_polynomial_that_only_touches_zero_does_not_fall(roots: list[float]) -> None:
    touching = from_roots([root for root in roots[:3] for _ in range(2)])
    rounding = 64 * np.finfo(float).eps * sum(map(abs, touching))
    assert first_descent_below_zero(touching, rounding, 1.0) is None


@pytest.mark.parametrize("depth", [0.0, 1e-14])
def test_a_minimum_within_the_band_is_a_touch_and_one_below_it_a_fall(depth: float) -> None:
    touching = from_roots([0.5, 0.5])
    assert first_descent_below_zero([touching[0] - depth, *touching[1:]], BAND, 1.0) is None
    fallen = first_descent_below_zero([touching[0] - 4 * BAND, *touching[1:]], BAND, 1.0)
    assert fallen == pytest.approx(0.5 * (1 - np.sqrt(4 * BAND)), rel=1e-9)


def test_what_starts_at_zero_and_falls_does_so_at_once() -> None:
    assert first_descent_below_zero([0.0, -1.0], BAND, 1.0) == 0.0
    assert first_descent_below_zero([0.0, 0.0, -1.0], BAND, 1.0) == pytest.approx(0.0, abs=1e-20)
    assert first_descent_below_zero([-1e-15, 0.0, 1e-3, -1.0], BAND, 1.0) == pytest.approx(
        1e-3, rel=1e-5
    )


@pytest.mark.parametrize("start", [0.0, 1e-16, -1e-16])
def test_what_starts_at_zero_and_rises_falls_only_when_it_comes_back(start: float) -> None:
    assert first_descent_below_zero([start, 1.0, -1.25], BAND, 1.0) == pytest.approx(0.8, rel=1e-12)
    assert first_descent_below_zero([start, 1.0, -0.5], BAND, 1.0) is None


def test_a_constant_does_not_fall() -> None:
    assert first_descent_below_zero([1.0], BAND, 1.0) is None
    assert first_descent_below_zero([0.0, 0.0], BAND, 1.0) is None

"""Claims about guards of events in `exact`: their values, and what of them counts as rounding."""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
import pytest

from vv.engines.exact.guards import GUARD_ROUNDING, _fall
from vv.scene import Vector

ONE, OTHER, PART, PACE = -2.0, -3.0, 0.5, 0.7  # a guard of two lengths and their rates
SIZES, RATES = np.array([4.0, 5.0]), np.array([30.0, 20.0])  # m
ROUNDING = GUARD_ROUNDING * (PART * (2 * 4.0 + 3 * 5.0) + PACE * (2 * 30.0 + 3 * 20.0))


def _fallen(lengths: Vector, offset: float, end: float) -> float:
    work = np.zeros(lengths.shape[1])
    return _fall(lengths, SIZES, RATES, 0, ONE, 1, OTHER, offset, PART, PACE, end, work)


fallen: Any = numba.njit(_fallen)


@pytest.mark.parametrize(("below", "falls"), [(0.98, False), (1.02, True)])
def test_a_guard_below_zero_by_its_rounding_is_zero(below: float, falls: bool) -> None:
    """That of both lengths and of both their rates counts, whatever their signs."""
    lengths = np.zeros((2, 4))
    assert (fallen(lengths, -below * ROUNDING / PART, 1.0) == 0.0) is falls


@pytest.mark.parametrize("end", [0.1, 1.0])
def test_a_guard_falls_where_lengths_and_their_rates_say(end: float) -> None:
    """Lengths are x + x^2 and 2 x^2 [m]; as a quadratic the guard has one positive root."""
    lengths = np.array([[0.0, 1.0, 1.0, 0.0], [0.0, 0.0, 2.0, 0.0]])
    guard = np.zeros(4)
    y = ONE * lengths[0] + OTHER * lengths[1]
    guard[:] = PART * y
    guard[:3] += PACE * np.array([1.0, 2.0, 3.0]) * y[1:]
    guard[0] += PART * 8.0
    (root,) = (r.real for r in np.roots(guard[:3][::-1]) if r.real > 0)
    assert 0.1 < root < 1.0
    found = fallen(lengths, 8.0, end)
    assert found == pytest.approx(root, rel=1e-13) if root < end else found > end

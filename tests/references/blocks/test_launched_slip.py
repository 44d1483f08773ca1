"""Claims about how the second route of the incline begins a slip whose direction turns."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from reference_solutions.checks.blocks.incline import _launched

Array = NDArray[np.float64]
PULL, LIMIT, TURN = 3.0, 2.0, 0.4  # m/s^2, m/s^2, rad/s
BEGIN = 2.0  # s


def turning(t: ArrayLike) -> tuple[Array, Array, Array]:
    """A pull of constant size, along x as the slip begins, and its limit of friction."""
    angle = TURN * (np.asarray(t) - BEGIN)
    return PULL * np.cos(angle), PULL * np.sin(angle), np.full_like(angle, LIMIT)


def test_a_slip_that_begins_follows_the_pull_at_a_share_of_its_turn() -> None:
    """A heading of f times the pull's keeps up if |T| (1 - f) = f (|T| - F): here f = 3/4."""
    start = np.array([5.0, 7.0])
    time, (x, y, speed, heading) = _launched(turning, BEGIN, start, 1.0)
    span = time - BEGIN
    assert span == pytest.approx(1e-5)
    assert heading == pytest.approx(0.75 * TURN * span, rel=1e-6)
    assert speed == pytest.approx((PULL - LIMIT) * span)
    gone = (PULL - LIMIT) * span**2 / 2.0
    assert [x - 5.0, y - 7.0] == pytest.approx([gone, gone * heading], abs=1e-15)

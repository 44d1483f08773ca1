"""Claims about falls under a constant force: their time has all its digits."""

from __future__ import annotations

import math
from decimal import Decimal, localcontext

import pytest

from vv.engines.exact.line.glide import falls
from vv.engines.kernels.compiled import compiled

HEIGHT, EPS = 1e-12, 2.0**-52


@compiled
def fallen(x: float, v: float, a: float) -> float:
    """When it falls through nil without drag."""
    return falls(x, v, a, 0.0, 1e-30, math.inf)


def due(x: float, v: float, a: float) -> float:
    """The time of the fall without drag, by the root with fifty digits."""
    with localcontext(prec=50):
        height, speed, pull = Decimal(x), Decimal(v), Decimal(a)
        return float((speed + (speed * speed - 2 * pull * height).sqrt()) / -pull)


@pytest.mark.parametrize(("v", "a"), [(1.0, -1.0), (-1.0, -1.0), (0.0, -1.0), (-1.0, 0.25)])
def test_a_fall_from_low_down_loses_no_digit(v: float, a: float) -> None:
    """Of both forms of the root one takes the difference of two numbers that are almost alike."""
    found = fallen(HEIGHT, v, a)
    assert found == pytest.approx(due(HEIGHT, v, a), rel=4 * EPS)

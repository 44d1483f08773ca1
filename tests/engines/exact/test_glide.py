"""Claims about falls under a constant force: their time has all its digits."""

from __future__ import annotations

import math
from decimal import Decimal, localcontext

import pytest

from vv.engines.exact.line.glide import fall_time
from vv.engines.kernels.compiled import compiled

HEIGHT, EPS = 1e-12, 2.0**-52


@compiled
def fallen(x: float, v: float, a: float, n: float) -> float:
    """When it falls through nil, if within nine seconds where drag slows it."""
    return fall_time(x, v, a, n, 1e-30, math.inf if n == 0.0 else 9.0)


def due(x: float, v: float, a: float) -> float:
    """The time of the fall without drag, by the root with fifty digits."""
    with localcontext(prec=50):
        height, speed, pull = Decimal(x), Decimal(v), Decimal(a)
        return float((speed + (speed * speed - 2 * pull * height).sqrt()) / -pull)


@pytest.mark.parametrize(("v", "a"), [(1.0, -1.0), (-1.0, -1.0), (0.0, -1.0), (-1.0, 0.25)])
def test_a_fall_from_low_down_loses_no_digit(v: float, a: float) -> None:
    """Of both forms of the root one takes the difference of two numbers that are almost alike."""
    found = fallen(HEIGHT, v, a, 0.0)
    assert found == pytest.approx(due(HEIGHT, v, a), rel=4 * EPS)


@pytest.mark.parametrize("n", [0.0, 0.2])
@pytest.mark.parametrize(
    ("v", "a", "at_once"),
    [(-1.0, 1.0, True), (0.0, -1.0, True), (0.0, 0.0, False), (0.0, 1.0, False), (1.0, 1.0, False)],
)
def test_what_is_at_nil_falls_at_once_if_it_moves_or_is_pulled_down(
    v: float, a: float, at_once: bool, n: float
) -> None:
    assert fallen(0.0, v, a, n) == (0.0 if at_once else math.inf)


@pytest.mark.parametrize("n", [0.0, 0.2])
def test_what_is_thrown_up_from_nil_falls_when_it_comes_back(n: float) -> None:
    found = fallen(0.0, 1.0, -1.0, n)
    way = found - found**2 / 2 if n == 0.0 else 3.5 * 2.5 * -math.expm1(-0.4 * found) - 2.5 * found
    assert found > 1.0
    assert way == pytest.approx(0.0, abs=1e-14)

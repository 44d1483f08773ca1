"""Claims about prescribed motions in kernels, and about vectors of three: truths by hand."""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
import pytest

from tests.support.plain import plain
from vv.engines.kernels.arrays import all_finite, larger, least_of, marked, smaller, square_of
from vv.engines.kernels.drive import NO_MOTION, drive, drives, mean, one_of, rate, travel, value
from vv.engines.kernels.triples import Triple, add_scaled, cross, dot
from vv.scene import Harmonic, Pulse, Vector

AMPLITUDE, FREQUENCY, PHASE = np.array([0.3, 0.0, -2.0]), np.array([2.0, 9.0, 0.7]), [0.4, 9.0, 1.3]
WAVE = Harmonic(AMPLITUDE, FREQUENCY, np.array(PHASE))


def by_hand(t: float) -> Vector:
    """Two sines, along x and z."""
    return np.asarray(AMPLITUDE * np.sin(2 * np.pi * FREQUENCY * t + np.array(PHASE)))


def _seen(drive: Any, t: float, step: float) -> Any:
    return value(drive, t), travel(drive, t), rate(drive, t), mean(drive, t, step)


seen: Any = numba.njit(_seen)


@pytest.mark.parametrize("t", [0.0, 0.11, 2.3])
def test_a_motion_its_way_its_rate_and_its_mean_are_those_of_its_sines(t: float) -> None:
    step, small = 0.13, 1e-6
    at, way, pace, middle = seen(drive(WAVE), t, step)
    assert at == pytest.approx(by_hand(t))
    assert way == pytest.approx(by_hand(t) - by_hand(0.0), abs=1e-12)
    slope = (by_hand(t + small) - by_hand(t - small)) / (2 * small)
    assert pace == pytest.approx(slope, rel=1e-7)
    parts = t + step * (np.arange(20_000) + 0.5) / 20_000
    assert middle == pytest.approx(np.mean([by_hand(one) for one in parts], axis=0), rel=1e-7)


def test_a_pulse_that_ends_within_a_step_counts_until_then() -> None:
    until, t, step = 0.2, 0.15, 0.2
    pulse = drive(Pulse(WAVE, until))
    parts = t + 0.05 * (np.arange(20_000) + 0.5) / 20_000
    due = 0.05 / step * np.mean([by_hand(one) for one in parts], axis=0)
    assert seen(pulse, t, step)[3] == pytest.approx(due, rel=1e-7)
    assert seen(pulse, until, step)[0] == pytest.approx(by_hand(until))
    assert seen(pulse, until + 1e-9, step)[0] == (0.0, 0.0, 0.0)
    assert seen(pulse, until + 1e-9, step)[3] == (0.0, 0.0, 0.0)


def _one(joined: Any, starts: Any, k: int) -> Any:
    part = one_of(joined, starts, k)
    return value(part, 0.3), len(part.omega)


def test_each_of_several_motions_is_itself() -> None:
    other = Harmonic(np.array([0.0, 1.0, 0.0]), np.array([0.0, 3.0, 0.0]))
    joined, starts = drives((WAVE, None, other, NO_MOTION))
    kernel: Any = numba.njit(_one)
    found = [kernel(joined, starts, k) for k in range(4)]
    assert [many for _, many in found] == [2, 0, 1, 0]
    assert found[0][0] == pytest.approx(by_hand(0.3))
    assert found[2][0] == pytest.approx((0.0, np.sin(6 * np.pi * 0.3), 0.0))


def _combined(a: Triple, b: Triple) -> Any:
    return add_scaled(a, 3.0, b), dot(a, b), cross(a, b)


def test_sums_and_products_of_vectors_are_those_of_numpy() -> None:
    a, b = (1.0, -2.0, 0.5), (4.0, 0.3, -7.0)
    kernel: Any = numba.njit(_combined)
    added, product, across = kernel(a, b)
    assert added == pytest.approx(np.add(a, 3.0 * np.array(b)))
    assert product == pytest.approx(np.dot(a, b))
    assert across == pytest.approx(np.cross(a, b))


def test_small_functions_of_numbers_are_what_they_say() -> None:
    assert plain(square_of)(-3.0) == 9.0
    assert [plain(larger)(*pair) for pair in ((1.0, 2.0), (2.0, 1.0))] == [2.0, 2.0]
    assert [plain(smaller)(*pair) for pair in ((1.0, 2.0), (2.0, 1.0))] == [1.0, 1.0]
    least = plain(least_of)
    assert (least(np.array([3.0, -1.0, 2.0])), least(np.zeros(0))) == (-1.0, np.inf)
    numbers: tuple[list[float], ...] = (
        [1.0, -2.0],
        [],
        [1.0, np.inf],
        [-np.inf, 0.0],
        [np.nan, 1.0],
    )
    assert [plain(all_finite)(np.array(one)) for one in numbers] == [True, True, *[False] * 3]
    assert [plain(marked)(np.array(mask)) for mask in ([False, True, False], [False])] == [
        True,
        False,
    ]

"""Claims about sines over a part of a cell, and about the first fall of a guard made of them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from vv.engines.exact.slide.arc import arc, first_fall, look
from vv.scene import Vector

pytestmark = pytest.mark.usefixtures("in_python")
BAND = 1e-13
TURN = np.array([np.pi / 2, 0.7])  # rad in a cell


def guard(seed: int) -> tuple[bool, float, Vector, Vector]:
    """Whether it is an integral, its start, its row, and the phases of its sines."""
    r = np.random.default_rng(seed)
    slips = bool(r.integers(2))
    start = r.uniform(0.0, 1.0) * r.integers(2) if slips else 0.0
    return slips, start, r.uniform((-1, -3, -1), (1, 3, 1)), r.uniform(0, 6.3, 2)


def value(slips: bool, start: float, row: Vector, phase: Vector, x: Vector) -> Vector:
    angle = phase + np.multiply.outer(x, TURN)
    if not slips:
        return np.asarray(row[0] + np.sin(angle) @ row[1:])
    return np.asarray(start + row[0] * x + (np.cos(phase) - np.cos(angle)) @ (row[1:] / TURN))


@pytest.mark.parametrize("angle", [0.0, 1e-9, 1e-3, 0.4, 1.1, np.pi / 2])
def test_an_arc_is_that_of_sine_and_cosine(angle: float) -> None:
    even, odd = arc(angle)
    assert even == pytest.approx(0.5 * np.sinc(angle / 2 / np.pi) ** 2, rel=4e-16)
    assert angle - angle**3 * odd == pytest.approx(math.sin(angle), rel=4e-16, abs=0.0)


@pytest.mark.parametrize("seed", range(8))
def test_a_look_gives_a_guard_and_its_derivatives(seed: int) -> None:
    slips, start, row, phase = guard(seed)
    wave, h = np.array([np.sin(phase), np.cos(phase)]), 1e-3
    for x in (0.0, 0.3, 0.8):
        near = np.asarray(x + h * np.arange(-3, 4), float)
        p, slope, curve, third = look(slips, start, row, TURN, wave, x)
        terms = np.polynomial.polynomial.polyfit(near - x, value(slips, start, row, phase, near), 5)
        assert p == pytest.approx(terms[0], abs=1e-13)
        assert [slope, curve, third] == pytest.approx(terms[1:4] * [1, 2, 6], abs=2e-4)


@pytest.mark.parametrize("seed", range(100))
def test_the_first_fall_is_where_a_guard_first_falls_through_zero(seed: int) -> None:
    slips, start, row, phase = guard(seed)
    wave = np.array([np.sin(phase), np.cos(phase)])
    bound = float((np.abs(row[1:]) * TURN ** (3 if slips else 4)).sum())
    fall = first_fall(slips, start, row, bound, TURN, wave, BAND, 1.0)
    x = np.linspace(0.0, 1.0, 20001)
    below = np.flatnonzero(value(slips, start, row, phase, x) < -BAND)
    if not len(below):
        assert fall > 1.0
    elif below[0] <= 1:
        assert fall <= x[1]
    else:
        assert x[below[0] - 1] <= fall <= x[below[0]]
        assert abs(value(slips, start, row, phase, np.array(fall))) < 1e-15 * 20


@pytest.mark.parametrize("deep", [0.3, 3.0])
def test_a_guard_that_only_touches_zero_does_not_fall(deep: float) -> None:
    """1 - (1 + d) sin has its minimum -d in the middle of a cell."""
    row, wave = (
        np.array([1.0, -1.0 - deep * BAND, 0.0]),
        np.array([[np.sqrt(0.5), 0.0], [np.sqrt(0.5), 1.0]]),
    )
    bound = float((np.abs(row[1:]) * TURN**4).sum())
    fall = first_fall(False, 0.0, row, bound, TURN, wave, BAND, 1.0)
    assert (fall <= 1.0) == (deep > 1)
    assert fall > 1.0 or fall == pytest.approx(0.5, abs=1e-6)


def test_a_slip_from_rest_is_no_fall() -> None:
    row, wave = np.array([0.0, 1.0, 0.0]), np.array([[0.0, 0.0], [1.0, 1.0]])
    assert first_fall(True, 0.0, row, float(TURN[0] ** 3), TURN, wave, BAND, 1.0) > 1.0

"""Claims about directions of slip that turns within a step, and about first roots."""

from __future__ import annotations

import numpy as np
import pytest

from vv.engines.rigid.limits import STILL
from vv.engines.rigid.slip import (
    SLOW,
    bend,
    first_root,
    least_slip_speed,
    mean_direction,
    zero_after,
)
from vv.scene import Vector

pytestmark = pytest.mark.usefixtures("in_python")
RIGHT, UP = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])
NODES, WEIGHTS = np.polynomial.legendre.leggauss(200)


def mean_of(before: Vector, after: Vector) -> Vector:
    """The mean of the directions between two velocities, by Gauss' rule of 200 points."""
    between = before + 0.5 * (NODES[:, None] + 1.0) * (after - before)
    return np.asarray(0.5 * WEIGHTS @ (between / np.linalg.norm(between, axis=1, keepdims=True)))


def unit(a: Vector) -> Vector:
    """The direction of a vector."""
    return np.asarray(a / np.linalg.norm(a))


@pytest.mark.parametrize(("span", "due"), [(1e-3, 3e-8), (1e3, STILL * 5e4)])
def test_slip_is_slower_than_rounding_of_a_step_or_of_the_solution(span: float, due: float) -> None:
    assert least_slip_speed(span, 50.0, 3e-9) == pytest.approx(due)


@pytest.mark.parametrize("size", [1e-5, 1.0, 1e4])
@pytest.mark.parametrize("seed", range(4))
def test_the_mean_direction_is_the_mean_of_all_directions(seed: int, size: float) -> None:
    before, after = size * np.random.default_rng(seed).normal(size=(2, 3)) + [size, 0, 0]
    found = mean_direction(tuple(before), tuple(after))
    assert found == pytest.approx(mean_of(before, after), abs=1e-8)


@pytest.mark.parametrize("size", [1e-5, 1.0, 1e4])
@pytest.mark.parametrize("angle", [0.0, 1e-8, 1e-6, 1e-3])
def test_a_slip_that_hardly_turns_keeps_its_direction(angle: float, size: float) -> None:
    """One that turns by 1e-6 while it slows to a tenth has a mean that is not that of its ends."""
    before = size * np.array([2.0, 1.0, 0.0])
    after = 0.1 * (before + angle * size * np.array([-1.0, 2.0, 0.0]))
    found = np.array(mean_direction(tuple(before), tuple(after)))
    due = mean_of(before, after)
    assert np.abs(found - due).max() <= max(1e-3 * angle, 1e-8)


def halves(before: Vector, sag: Vector, after: Vector, pull: float) -> Vector:
    """The mean direction over both halves of a step, whose middle friction moves."""
    middle = 0.5 * (before + after) + sag
    turned = 0.25 * pull * (mean_of(middle, after) - mean_of(before, middle))
    return 0.5 * (mean_of(before, middle + turned) + mean_of(middle + turned, after))


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("seed", range(4))
def test_a_bend_is_the_mean_direction_less_that_of_the_ends(seed: int, size: float) -> None:
    random = np.random.default_rng(seed)
    before, after = size * (random.normal(size=(2, 3)) + 4.0 * RIGHT)
    sag, pull = size * random.uniform(-0.3, 0.3, 3), 0.3 * size
    due = halves(before, sag, after, pull) - 0.5 * unit(before) - 0.5 * unit(after)
    assert bend(tuple(before), tuple(sag), tuple(after), pull) == pytest.approx(due, abs=1e-9)


@pytest.mark.parametrize(("part", "bends"), [(0.98, True), (1.02, False)])
@pytest.mark.parametrize("slow", ["first", "middle", "last"])
def test_slip_that_friction_could_reverse_does_not_bend(
    slow: str, part: float, bends: bool
) -> None:
    """The slowest of three velocities, 0.5 m/s, is compared with SLOW times the pull."""
    first, last = (2.0 * RIGHT + UP, 3.0 * RIGHT)
    if slow == "first":
        first = 0.3 * RIGHT + 0.4 * UP
    elif slow == "last":
        last = 0.4 * RIGHT + 0.3 * UP
    middle = 0.3 * RIGHT - 0.4 * UP if slow == "middle" else 2.0 * RIGHT - UP
    sag = middle - 0.5 * (first + last)
    found = bend(tuple(first), tuple(sag), tuple(last), part * 0.5 / SLOW)
    assert (np.linalg.norm(found) > 1e-3) == bends
    if not bends:
        assert found == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("size", [1e-4, 1.0, 1e4])
def test_slip_along_one_line_bends_only_if_its_middle_is_off_that_line(size: float) -> None:
    first, last, none = size * RIGHT, size * 2.0 * RIGHT, (0.0, 0.0, 0.0)
    assert bend(tuple(first), none, tuple(last), 0.0) == none
    assert bend(tuple(first), tuple(size * 1e-8 * UP), tuple(last), 0.0) == none
    aside = bend(tuple(first), tuple(size * 0.5 * UP), tuple(last), 0.0)
    assert aside[1] > 0.1
    turns = bend(tuple(first), tuple(-0.5 * size * 1e-5 * UP), tuple(last + size * 1e-5 * UP), 0.0)
    assert turns != none


@pytest.mark.parametrize("seed", range(30))
def test_a_first_root_is_the_least_of_those_of_the_parabola(seed: int) -> None:
    a, b, c = np.random.default_rng(seed).normal(size=3) * [1.0, 2.0, 1.0]
    a = abs(a)
    roots = np.roots([c, b, a])
    due = min((r.real for r in roots if abs(r.imag) < 1e-12 and r.real >= 0), default=np.inf)
    assert first_root(a, b, c) == pytest.approx(due)


@pytest.mark.parametrize(("first", "second"), [(2.0, 5.0), (2.0, -1.0), (-3.0, 3.5)])
@pytest.mark.parametrize("t", [(0.1, 0.4, 0.9), (0.0, 1.2, 1.3)])
def test_a_parabola_through_three_points_has_its_first_zero_after_them(
    first: float, second: float, t: tuple[float, float, float]
) -> None:
    """It is c (x - first)(x - second), not negative at the last point, and of either sign of c."""
    after = [x for x in (first, second) if x > t[2]]
    c = 0.7 if (t[2] - first) * (t[2] - second) > 0.0 else -0.7
    points = [(x, c * (x - first) * (x - second)) for x in t]
    assert zero_after(*points[0], *points[1], *points[2]) == pytest.approx(min(after))
    below = 0.5 + 0.3 * np.array(t) ** 2  # it has no zero
    assert zero_after(t[0], below[0], t[1], below[1], t[2], below[2]) == np.inf


def test_a_line_through_two_points_has_its_zero_after_them() -> None:
    assert zero_after(0.4, 9.0, 0.4, 1.5, 1.0, 0.6) == pytest.approx(1.4)
    assert zero_after(0.4, 9.0, 0.4, 0.6, 1.0, 1.5) == np.inf

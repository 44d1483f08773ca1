"""Claims about friction of contacts that slip in DEM, which have truths by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from vv.engines.dem.contact.friction import (
    at_limit,
    share_closed,
    slide_in_step,
    slip_direction,
    slip_number,
    twist_both,
)
from vv.engines.dem.contact.touch import Touch
from vv.engines.kernels.compiled import compiled
from vv.engines.kernels.triples import NOWHERE, Triple

UP = (0.0, 0.0, 1.0)


@compiled
def aimed(old: Triple, slide: Triple, change: Triple, x: float) -> Triple:
    trial = (old[0] - slide[0], old[1] - slide[1], old[2] - slide[2])
    return slip_direction(old, trial, slide, change, (5.0, 5.0), x, math.exp(-x))


@pytest.mark.parametrize("x", [0.1, 0.5, 4.0])
def test_slip_that_grows_turns_friction_as_steady_slip_does(x: float) -> None:
    """Of the change of the slide only what is across it counts."""
    old, slide, across = (3.0, 4.0, 0.0), np.array([-0.1, -0.3, 0.0]), np.array([0.06, -0.02, 0.0])
    steady = aimed(old, tuple(slide), tuple(across), x)
    assert aimed(old, tuple(slide), tuple(across + 0.4 * slide), x) == pytest.approx(steady)
    assert aimed(old, tuple(slide), tuple(0.4 * slide), x) != pytest.approx(steady, rel=1e-5)


@compiled
def held_at(
    old: Triple, pull: Triple, slide: Triple, ks: float, cap: float
) -> tuple[Triple, float]:
    return at_limit(old, pull, slide, ks, cap)


@pytest.mark.shows("Its energy is slip times the mean of the forces before and after a step")
def test_friction_at_its_limit_takes_the_mean_force_times_the_slip() -> None:
    """The slip is the slide but for what stretches the spring."""
    old, pull, slide = (
        np.array([2.0, 0.0, 1.0]),
        np.array([3.0, 4.0, 0.0]),
        np.array([-0.1, -0.3, 0]),
    )
    new, taken = held_at(tuple(old), tuple(pull), tuple(slide), 50.0, 2.5)
    due = 2.5 * pull / 5.0
    assert new == pytest.approx(due)
    assert taken == pytest.approx(-0.5 * (old + due) @ (slide + (due - old) / 50.0))


def angle_after(x: float, start: float, turns: float) -> float:
    """The angle of a force at its limit after a step, from minus the slip at the middle of it.

    start: that at the beginning; turns: by how much the slip turns in the step [rad].
    """
    old = (5.0 * math.cos(start), 5.0 * math.sin(start), 0.0)
    found = aimed(old, (-0.1, 0.0, 0.0), (0.0, -0.1 * turns, 0.0), x)
    return math.atan2(found[1], found[0])


@pytest.mark.parametrize("x", [0.009, 0.3, 2.0, 8.0])
@pytest.mark.parametrize("start", [1.2, -0.4])
def test_steady_slip_turns_a_force_as_its_law_says(x: float, start: float) -> None:
    """t' = -x sin t: a step multiplies tan t/2 by exp(-x)."""
    due = 2.0 * math.atan(math.tan(0.5 * start) * math.exp(-x))
    assert angle_after(x, start, 0.0) == pytest.approx(due)


@pytest.mark.parametrize("x", [0.009, 0.3, 2.0, 8.0])
def test_slip_that_turns_takes_the_force_along_as_its_law_says(x: float) -> None:
    """f' = -x (f - turns (t - 1/2)), for small angles, has a solution in closed form."""
    start, turns = 2e-5, 1e-5
    ahead = turns / 2.0 + turns / x
    due = turns / 2.0 - turns / x + (start + ahead) * math.exp(-x)
    assert angle_after(x, start, turns) == pytest.approx(due, abs=1e-13)


@compiled
def slipping(slide: Triple, ks: float, caps: tuple[float, float]) -> float:
    return slip_number(slide, ks, caps)


@compiled
def spun(old: Triple, slide: Triple, twist: float) -> tuple[Triple, Triple]:
    return twist_both(old, slide, UP, twist)


def test_slip_is_counted_in_stretches_at_the_mean_limit_and_turns_with_the_twist() -> None:
    assert slipping((0.3, 0.0, -0.4), 20.0, (1.0, 4.0)) == pytest.approx(20.0 * 0.5 / 2.5)
    old, slide = spun((1.0, 0.0, 0.0), (2.0, 0.0, 0.0), 0.02)
    assert old == pytest.approx((math.cos(0.02), math.sin(0.02), 0.0), rel=1e-4)
    assert np.linalg.norm(old) == pytest.approx(1.0, rel=1e-15)
    assert slide == pytest.approx((2.0, 0.5 * 0.02 * 2.0, 0.0))


@compiled
def closed_for(overlap: float, opened: float) -> float:
    return share_closed(overlap, opened)


def test_a_contact_is_closed_for_as_long_in_a_step_as_it_overlaps() -> None:
    """By how much the gap grew, the overlap before was more or less."""
    assert closed_for(2.0, 3.0) == closed_for(2.0, -2.0) == 1.0
    assert closed_for(1.0, -4.0) == 0.25


def test_what_does_not_slide_or_turns_about_has_its_trial_force() -> None:
    old = (3.0, 4.0, 0.0)
    assert aimed(old, NOWHERE, (0.1, 0.0, 0.0), 0.5) == old
    assert aimed(old, (6.0, 8.0, 0.0), NOWHERE, 0.5) == (-3.0, -4.0, 0.0)


@compiled
def slid(touch: Touch) -> tuple[Triple, Triple]:
    return slide_in_step(touch, 0.01)


def test_a_contact_slides_across_its_normal_for_as_long_as_it_is_closed() -> None:
    """It closes after three quarters of a step of 10 ms."""
    m, relative, changed = (
        np.array([0.6, 0.0, 0.8]),
        np.array([1.0, 2.0, 3.0]),
        np.array([4.0, 1, -2]),
    )
    whole = Touch(1.0, -4.0, UP, UP, tuple(m), (0.0, 0.0), tuple(relative), tuple(changed), 0.0)
    across = np.eye(3) - np.outer(m, m)
    slide, change = slid(whole)
    assert slide == pytest.approx(0.01 * 0.25 * across @ relative)
    assert change == pytest.approx(0.01 * 0.25 * across @ changed)


def test_a_force_below_its_limit_counts_as_one_at_the_limit_where_it_opposes_slip() -> None:
    """2 E F/cap + (1 - E^2 + cos t (1 - E)^2) d, with the size of F for its limit elsewhere."""
    fading = math.exp(-0.5)
    for old, size in (((1.0, 2.0, 0.0), 5.0), ((-1.0, 2.0, 0.0), math.sqrt(5.0))):
        cosine = old[0] / math.sqrt(5.0)
        gained = 1.0 - fading**2 + cosine * (1.0 - fading) ** 2
        due = 2.0 * fading / size * np.array(old) + [gained, 0.0, 0.0]
        assert aimed(old, (-0.1, 0.0, 0.0), NOWHERE, 0.5) == pytest.approx(due)

"""Claims about when slip of a point mass begins and ends, with truths by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from vv.engines.kernels.drive import NO_MOTION, drive, rate, travel
from vv.engines.rigid.limits import BEGINS, CUTS, GRIP, NEARLY, STILL
from vv.engines.rigid.point.kernel import (
    add_works,
    least_begun_slip,
    may_slip,
    slip_began,
    slip_ended,
    slips_after,
    time_to_event,
)
from vv.engines.rigid.point.trial import ZERO, Ground, Touch
from vv.scene import Harmonic, Pulse, Vector

pytestmark = pytest.mark.usefixtures("in_python")
RIGHT, UP = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
SPAN, PULL, BRAKING, FINE, MU, G = 1e-2, 12.0, 5.0, 1e-9, 0.4, 10.0
HERTZ = 0.5
PUSH = Harmonic(np.array([8.0, 0.0, 0.0]), np.array([HERTZ, 0.0, 0.0]))


def ground(**changes: Any) -> Ground:
    """A level plane at rest on which a mass is pushed to the right by 8 sin(pi t) m/s2."""
    given: dict[str, Any] = {
        "gravity": (0.0, 0.0, -G), "load": ZERO, "normal": UP, "gap": 0.0, "mu": MU,
        "base": drive(NO_MOTION), "shaking": drive(PUSH), "hold": np.eye(3), "pull": PULL,
        "braking": BRAKING, "fine": FINE, "quick": 1.0, **changes,
    }  # fmt: skip
    return Ground(**given)


@pytest.mark.parametrize(("part", "ended"), [(0.98, True), (1.02, False), (-5.0, True)])
@pytest.mark.parametrize("fine", [FINE, 1e-15])
def test_a_slip_has_ended_that_is_slower_than_rounding_or_reversed(
    part: float, ended: bool, fine: float
) -> None:
    least = max(10.0 * fine, STILL * BRAKING * SPAN)
    made = ground(fine=fine)
    touch = Touch((part * least, 1.0, 0.0), 1.0, ZERO)
    assert bool(slip_ended(made, touch, True, RIGHT, SPAN)) == ended
    assert not slip_ended(made, touch, False, RIGHT, SPAN)
    assert not slip_ended(made, touch._replace(p=0.0), True, RIGHT, SPAN)
    assert not slip_ended(made, touch, True, ZERO, SPAN)


@pytest.mark.parametrize(("part", "began"), [(0.98, False), (1.02, True), (-1.02, True)])
@pytest.mark.parametrize("fine", [FINE, 1e-5])
def test_a_slip_has_begun_that_is_faster_than_a_part_of_the_velocity_gained(
    part: float, began: bool, fine: float
) -> None:
    least = max(NEARLY * PULL * SPAN, 10.0 * fine)
    made = ground(fine=fine)
    assert least_begun_slip(made, SPAN) == pytest.approx(least)
    touch = Touch((0.6 * part * least, 0.8 * part * least, 7.0), 1.0, ZERO)
    assert bool(slip_began(made, touch, True, ZERO, SPAN)) == began
    assert not slip_began(made, touch, False, ZERO, SPAN)
    assert not slip_began(made, touch._replace(p=0.0), True, ZERO, SPAN)
    assert not slip_began(made, touch, True, RIGHT, SPAN)


@pytest.mark.parametrize(("part", "may"), [(0.98, False), (1.02, True), (-1.02, True)])
def test_what_sticks_may_slip_where_something_moves_and_friction_is_used(
    part: float, may: bool
) -> None:
    p = 3.0
    touch = Touch(ZERO, p, (0.6 * part * GRIP * MU * p, 0.8 * part * GRIP * MU * p, 0.0))
    for moving in (ground(), ground(base=drive(PUSH), shaking=drive(NO_MOTION))):
        assert bool(may_slip(moving, touch, True, ZERO)) == may
        assert not may_slip(moving, touch, False, ZERO)
        assert not may_slip(moving, touch, True, RIGHT)
    assert not may_slip(ground(shaking=drive(NO_MOTION)), touch, True, ZERO)


BEGINS_AT = np.arcsin(MU * G / 8.0) / np.pi  # s, when the push exceeds friction


@pytest.mark.parametrize(("after", "slips"), [(0.0, False), (0.01, False), (0.03, True)])
def test_a_mass_slips_after_a_time_if_it_is_then_pushed_too_much(after: float, slips: bool) -> None:
    """It sticks until 1/6 s; from 0.15 s on it begins to slip within 0.02 s."""
    assert pytest.approx(1.0 / 6.0) == BEGINS_AT
    now = 0.15
    assert bool(slips_after(ground(), ZERO, ZERO, now, after, SPAN)) == slips
    assert slips_after(ground(), ZERO, ZERO, 0.17, 0.0, SPAN)
    brief = Pulse(PUSH, 0.175)  # in the short trial after it, nothing pushes
    assert not slips_after(ground(shaking=drive(brief)), ZERO, ZERO, now, 0.1, SPAN)


@pytest.mark.parametrize("up", [0.0, 0.1])
def test_a_mass_that_begins_to_slip_has_gone_with_its_plane_until_then(up: float) -> None:
    """It sticks from 0.15 s to 0.17 s, when the push exceeds friction; the plane may rise."""
    base = drive(Harmonic(np.array([0.0, 0.0, up]), np.full(3, 0.2)))
    made, now = ground(base=base), 0.15
    x, v = travel(base, now), rate(base, now)
    assert slips_after(made, x, v, now, 0.02, SPAN)
    assert not slips_after(made, x, v, now, 0.01, SPAN)


@pytest.mark.parametrize("ahead", [0.3, 0.62, 0.97])
def test_the_begin_of_a_slip_is_found_within_a_part_of_a_step(ahead: float) -> None:
    now = BEGINS_AT - ahead * SPAN
    found = time_to_event(ground(), ZERO, ZERO, now, SPAN, SPAN, ZERO, True) / SPAN
    assert 0.0 <= ahead - found + 1e-3 <= 2.0**-BEGINS + 0.02
    assert time_to_event(ground(), ZERO, ZERO, BEGINS_AT + SPAN, SPAN, SPAN, ZERO, True) == 0.0


@pytest.mark.parametrize("stops", [0.3, 0.77, 3e-6, 1e-10])
def test_the_end_of_a_slip_is_found_by_halving(stops: float) -> None:
    """On a plane on which nothing pushes, at mu g; what ends within CUTS has ended at once."""
    made, speed = ground(shaking=drive(NO_MOTION)), stops * SPAN * MU * G
    found = time_to_event(made, ZERO, (speed, 0.0, 0.0), 0.0, SPAN, SPAN, RIGHT, False) / SPAN
    assert found == (0.0 if stops < CUTS else pytest.approx(stops, abs=5e-7))


def test_works_are_those_of_impulses_at_mean_velocities() -> None:
    spent: Vector = np.array([1.0, 2.0, 3.0, 4.0, 5.0])
    touch = Touch((0.5, -0.7, 0.2), 3.0, (-0.4, 0.9, 0.0))
    u, base = np.array([1.5, 0.1, -0.8]), np.array([0.3, 0.6, 0.9])
    add_works(spent, touch, tuple(u), tuple(base), UP)
    mean = 0.5 * (u + touch.u)
    push = np.array(touch.rub) + 3.0 * np.array(UP)
    due = [1.0 - mean @ touch.rub, 2.0 - 3.0 * mean[2], 3.0 + push @ base, 4.0, 5.0]
    assert spent == pytest.approx(due)

"""Claims about the choice between sticking and slip, and between two directions of it: by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.support.plain import plain
from vv.engines.dem.contact import friction
from vv.engines.dem.contact.touch import Touch
from vv.scene import Vector

UP, NONE = (0.0, 0.0, 1.0), (0.0, 0.0, 0.0)
KS, DT = 50.0, 0.01


def touch(slide: Vector, change: Vector, overlap: float = 1.0, opened: float = 0.0) -> Touch:
    """A contact that slides by so much [m] in a step, and by `change` more than in the last one."""
    rates = (0.0, 0.0)
    return Touch(overlap, opened, UP, UP, UP, rates, tuple(slide / DT), tuple(change / DT), None)


def found(spring: Vector, slide: Vector, caps: tuple[float, float]) -> tuple[Vector, float]:
    force, taken = plain(friction.shear_force)(
        tuple(spring), touch(slide, np.zeros(3)), KS, caps, DT
    )
    return np.array(force), taken


SPRING, SLIDE = np.array([2.0, -1.0, 0.0]), np.array([-0.04, 0.06, 0.0])
TRIAL = SPRING - KS * SLIDE


@pytest.mark.parametrize(("part", "sticks"), [(1.0001, True), (0.9999, False)])
def test_a_contact_sticks_up_to_its_limit_at_the_end_of_the_step(part: float, sticks: bool) -> None:
    """The limit before the step, which is larger or smaller, does not matter for that."""
    cap = part * float(np.linalg.norm(TRIAL))
    for before in (0.5 * cap, 2.0 * cap):
        force, taken = found(SPRING, SLIDE, (before, cap))
        assert (taken == 0.0) == sticks
        assert np.linalg.norm(force) == pytest.approx(min(cap, float(np.linalg.norm(TRIAL))))
        if sticks:
            assert force == pytest.approx(TRIAL)


@pytest.mark.parametrize("cap", [1.0, 3.0])
def test_slip_turns_its_force_by_the_exponential_of_the_slide(cap: float) -> None:
    """tan of half the angle to minus the slide falls by exp(-x), x = 2 ks s/(sum of limits)."""
    size = float(np.linalg.norm(SPRING))
    force, taken = found(SPRING, SLIDE, (size, cap))
    way = -SLIDE / np.linalg.norm(SLIDE)

    def angle(a: Vector) -> float:
        return math.atan2(float(np.cross(way, a)[2]), float(way @ a))

    x = 2.0 * KS * float(np.linalg.norm(SLIDE)) / (size + cap)
    assert math.tan(angle(force) / 2) == pytest.approx(math.tan(angle(SPRING) / 2) * math.exp(-x))
    slip = SLIDE + (force - SPRING) / KS
    assert taken == pytest.approx(-0.5 * (SPRING + force) @ slip)
    assert taken > 0.0


def test_where_slip_would_give_energy_its_force_is_along_the_trial_force() -> None:
    """A weak spring that is pulled across and then back: the exact direction overshoots."""
    old, slide = np.array([0.1, 0.9, 0.0]), np.array([0.01, 0.02, 0.0])
    trial, caps = old - KS * slide, (9.0, 0.05)
    given = tuple(old), tuple(trial), tuple(slide)
    aim = plain(friction.slip_direction)(*given, NONE, caps, 0.2, math.exp(-0.2))
    along = [plain(friction.at_limit)(given[0], way, given[2], KS, 0.05) for way in (aim, trial)]
    for change in (np.zeros(3), np.array([-0.5, 0.3, 0.0]), np.array([0.5, -0.3, 0.0])):
        args = (*given, tuple(change), KS, caps, 0.2, math.exp(-0.2))
        aim = plain(friction.slip_direction)(*given, tuple(change), caps, 0.2, math.exp(-0.2))
        first = plain(friction.at_limit)(given[0], aim, given[2], KS, 0.05)
        due = first if first[1] >= 0.0 else along[1]
        assert plain(friction.slip_force_with)(*args) == due


def test_a_step_in_which_a_contact_closes_charges_its_spring_for_the_rest_alone() -> None:
    """It closes after three quarters of the step."""
    given = touch(SLIDE, np.zeros(3), overlap=1.0, opened=-4.0)
    force, taken = plain(friction.shear_force)(NONE, given, KS, (0.0, 1e9), DT)
    assert force == pytest.approx(-0.25 * KS * SLIDE)
    assert taken == 0.0


def test_a_twist_turns_the_old_force_wholly_and_the_slide_by_half() -> None:
    given = touch(SLIDE, np.zeros(3))._replace(twist=0.02)
    old, slide, trial = plain(friction.trial_force)(tuple(SPRING), given, tuple(SLIDE), KS)
    across = np.cross(UP, SLIDE)
    assert slide == pytest.approx(SLIDE + 0.01 * across)
    assert old == pytest.approx(SPRING + 0.02 * np.cross(UP, SPRING), rel=1e-3)
    assert np.linalg.norm(old) == pytest.approx(np.linalg.norm(SPRING))
    assert trial == pytest.approx(np.array(old) - KS * np.array(slide))


@pytest.mark.parametrize("x", [0.9 * friction.SMALL, 1.1 * friction.SMALL, 0.5, 3.0])
def test_a_slide_that_turns_counts_with_its_direction_late_in_the_step(x: float) -> None:
    """By coth(x/2)/2 - 1/x of its change across itself, which is x/12 for short steps."""
    old, trial = np.array([2.0, -1.0, 0.3]), np.array([2.1, -1.1, 0.3])
    slide, change = np.array([-0.3, 0.2, 0.0]), np.array([0.05, 0.11, 0.02])
    fading, caps = math.exp(-x), (2.6, 2.5)
    late = 0.5 / math.tanh(x / 2.0) - 1.0 / x if x > 0.1 else x / 12.0
    aim = slide + late * (change - (change @ slide) / (slide @ slide) * slide)
    d, f = -aim / np.linalg.norm(aim), old / caps[0]
    cosine = d @ old / np.linalg.norm(old)
    due = 2.0 * fading * f + (1.0 - fading**2 + cosine * (1.0 - fading) ** 2) * d
    given = [tuple(a) for a in (old, trial, slide, change)]
    found = plain(friction.slip_direction)(*given, caps, x, fading)
    assert cosine > 0.0
    assert found == pytest.approx(due, rel=1e-6, abs=1e-9)
    back, still = tuple(-old), (0.0, 0.0, 0.0)
    assert plain(friction.slip_direction)(given[0], back, *given[2:], caps, x, fading) == back
    assert plain(friction.slip_direction)(*given[:2], still, still, caps, x, fading) == given[1]

"""Claims about trial steps of a point mass that slides: the turn of its slip, and half steps."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.engines.rigid.by_hand.point.test_point_trials import (
    ACROSS,
    BASE,
    NORMAL,
    NOW,
    SPAN,
    ground,
    path,
)
from vv.engines.kernels.drive import NO_MOTION, drive
from vv.engines.rigid.limits import AGREE, BENDS, MOSTLY
from vv.engines.rigid.point.trial import (
    ZERO,
    Ground,
    Touch,
    free_velocity,
    gap_at,
    resolved_part,
    sag_by_motions,
    slip_turns,
    tangential,
    trial_step,
    two_half_steps,
    with_contact,
)
from vv.engines.rigid.slip import bend
from vv.scene import Harmonic, Vector

pytestmark = pytest.mark.usefixtures("in_python")


def sliding(made: Ground, speed: float) -> tuple[Any, Vector, Any]:
    """A mass on the plane that slides askew: its place, velocity and direction of slip."""
    slip = speed * np.array([0.0, 0.6, 0.0]) + 0.8 * speed * ACROSS
    x = path(BASE, 0, NOW) - made.gap * NORMAL
    return tuple(x), slip + path(BASE, 1, NOW), tuple(slip / speed)


@pytest.mark.parametrize("speed", [1.0, 3.0])
def test_friction_of_a_trial_follows_the_slip_that_it_causes(speed: float) -> None:
    """Its turn is the bend by its own result, up to what BENDS iterations leave."""
    made = ground(hold=np.eye(3))
    x, v, d = sliding(made, speed)
    touch = trial_step(made, x, tuple(v), NOW, SPAN, d)
    free = np.array(free_velocity(made, tuple(v), NOW, SPAN)) - path(BASE, 1, NOW + SPAN)
    need = -max(gap_at(made, x, NOW), 0.0) / SPAN
    before = tangential(made, tuple(v - path(BASE, 1, NOW)))
    sag = sag_by_motions(made, NOW, SPAN)
    turn = bend(before, sag, tangential(made, touch.u), made.mu * touch.p)
    due = with_contact(made, tuple(free), need, d, turn)
    assert np.linalg.norm(turn) > 1e-4
    assert touch.u == pytest.approx(due.u, abs=0.1**BENDS)
    assert touch.rub == pytest.approx(due.rub, abs=0.1**BENDS)


def test_a_slip_that_reverses_in_a_trial_has_no_turn() -> None:
    made = ground(hold=np.eye(3), mu=0.1)
    x, _, _ = sliding(made, 1.0)
    pushed = np.array(trial_step(made, x, tuple(path(BASE, 1, NOW)), NOW, SPAN, ZERO).u)
    d = tuple(-pushed / np.linalg.norm(pushed))
    v = path(BASE, 1, NOW) - 0.01 * pushed + 0.002 * np.cross(NORMAL, pushed)
    touch = trial_step(made, x, tuple(v), NOW, SPAN, d)
    free = np.array(free_velocity(made, tuple(v), NOW, SPAN)) - path(BASE, 1, NOW + SPAN)
    due = with_contact(made, tuple(free), 0.0, d, ZERO)
    assert np.dot(touch.u, d) < 0.0
    assert touch.u == pytest.approx(due.u, abs=1e-9)


@pytest.mark.parametrize("speed", [1e-6, 0.8])
def test_two_half_steps_are_a_trial_after_a_trial(speed: float) -> None:
    """The second one has a direction of slip unless it is slower than rounding."""
    made = ground(hold=np.eye(3), mu=1.2)
    x, v, d = sliding(made, speed)
    half = 0.5 * SPAN
    first = trial_step(made, x, tuple(v), NOW, half, d)
    end = np.array(first.u) + path(BASE, 1, NOW + half)
    there = np.array(x) + 0.5 * half * (v + end)
    slip = np.array(tangential(made, first.u))
    fast = np.linalg.norm(slip)
    second = tuple(slip / fast) if fast > 1e-8 else ZERO
    due = trial_step(made, tuple(there), tuple(end), NOW + half, half, second)
    found = two_half_steps(made, x, tuple(v), NOW, SPAN, d)
    assert isinstance(found, Touch)
    assert found.u == pytest.approx(due.u, abs=1e-12)


@pytest.mark.parametrize("quick", [0.5, 50.0])
@pytest.mark.parametrize("speed", [0.05, 0.15, 2.0])
def test_a_step_is_halved_until_two_halves_agree_with_it(speed: float, quick: float) -> None:
    """Up to a part of the velocity that friction gains in a whole step dt."""
    made, dt = ground(hold=np.eye(3), mu=0.3, quick=quick), 1.5 * SPAN
    x, v, d = sliding(made, speed)
    part = min(AGREE * (quick * dt) ** 2, MOSTLY)

    def off(span: float) -> float:
        touch = trial_step(made, x, tuple(v), NOW, span, d)
        two = two_half_steps(made, x, tuple(v), NOW, span, d)
        apart = np.subtract(tangential(made, two.u), tangential(made, touch.u))
        return float(np.linalg.norm(apart) / (part * made.mu * touch.p * dt / span))

    whole = trial_step(made, x, tuple(v), NOW, SPAN, d)
    found = resolved_part(made, x, tuple(v), NOW, SPAN, dt, d, whole)
    halvings = round(np.log2(SPAN / found))
    assert found == SPAN / 2**halvings
    before = tangential(made, tuple(v - path(BASE, 1, NOW)))
    turns = slip_turns(made, NOW, SPAN, before, tangential(made, whole.u))
    assert (halvings > 0) == (off(SPAN) > 1.0 and turns)
    if halvings:
        assert off(2.0 * found) > 1.0


def test_a_trial_without_a_direction_of_slip_has_no_turn() -> None:
    """Though the mass slides before and after: it has just stopped, or slides anew."""
    made = ground(hold=np.eye(3))
    x, v, _ = sliding(made, 2.0)
    touch = trial_step(made, x, tuple(v), NOW, SPAN, ZERO)
    free = np.array(free_velocity(made, tuple(v), NOW, SPAN)) - path(BASE, 1, NOW + SPAN)
    due = with_contact(made, tuple(free), 0.0, ZERO, ZERO)
    assert np.linalg.norm(tangential(made, touch.u)) > 0.5
    assert touch.u == pytest.approx(due.u, abs=1e-9)


def test_a_step_in_which_slip_hardly_turns_is_not_halved() -> None:
    """Seen from a plane that moves at 9 m/s; two halves differ from the step by more than asked."""
    fast = Harmonic(np.array([0.0, 3.0, 0.0]), np.full(3, 0.5), np.zeros(3))
    made = ground(hold=np.eye(3), mu=0.3, quick=1e-4, base=drive(fast), shaking=drive(NO_MOTION))
    rate = np.array([0.0, 3.0 * np.pi * np.cos(np.pi * NOW), 0.0])
    slip = 5.0 * np.array([0.0, 0.6, 0.0]) + 4.0 * ACROSS
    x = np.array([0.0, 3.0 * np.sin(np.pi * NOW), 0.0]) - made.gap * NORMAL
    given: Any = (made, tuple(x), tuple(slip + rate), NOW)
    d: Any = tuple(slip / 5.0)
    step: Any = (*given, SPAN, d)
    whole = trial_step(*step)
    off = np.subtract(two_half_steps(*step).u, whole.u)
    assert np.linalg.norm(off) > AGREE * (1e-4 * SPAN) ** 2 * made.mu * whole.p
    part: Any = (*given, SPAN, SPAN, d, whole)
    assert resolved_part(*part) == SPAN

"""Claims about trial steps of a point mass on a plane that moves, with truths by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from vv.engines.kernels.drive import NO_MOTION, drive
from vv.engines.rigid.point.trial import (
    ZERO,
    Ground,
    free_velocity,
    gap_at,
    in_flight,
    landing_time,
    project_free,
    sag_by_motions,
    tangential,
    trial_step,
    with_contact,
)
from vv.scene import Harmonic, Vector

pytestmark = pytest.mark.usefixtures("in_python")
NORMAL = np.array([0.6, 0.0, 0.8])
ACROSS = np.array([0.8, 0.0, -0.6])
GRAVITY, LOAD = np.array([0.3, -0.2, -9.0]), np.array([0.1, 0.4, 0.5])
HOLD = np.eye(3) - np.outer([0.0, 1.0, 0.0], [0.0, 1.0, 0.0])
BASE = Harmonic(np.array([0.02, 0.01, 0.03]), np.array([3.0, 5.0, 2.0]), np.array([0.4, 1.0, 2.0]))
SHAKEN = Harmonic(np.array([2.0, 1.0, 3.0]), np.array([4.0, 2.0, 7.0]), np.array([0.1, 0.5, 1.2]))
NOW, SPAN = 0.07, 0.03  # s
X, V = np.array([0.013, -0.02, 0.011]), np.array([1.1, 0.3, -0.7])


def ground(**changes: Any) -> Ground:
    """A plane that moves below a mass that is shaken, whose locked direction is y."""
    given: dict[str, Any] = {
        "gravity": tuple(GRAVITY), "load": tuple(LOAD), "normal": tuple(NORMAL), "gap": 0.02,
        "mu": 0.4, "base": drive(BASE), "shaking": drive(SHAKEN), "hold": HOLD, "pull": 12.0,
        "braking": 5.0, "fine": 1e-9, "quick": 5.0, **changes,
    }  # fmt: skip
    return Ground(**given)


def path(motion: Harmonic, times: int, t: float) -> Vector:
    """A motion at a time, its displacement since t = 0 (0) or its rate (1)."""
    omega = 2.0 * np.pi * motion.frequency
    if times:
        return np.asarray(motion.amplitude * omega * np.cos(omega * t + motion.phase))
    return np.asarray(motion.amplitude * (np.sin(omega * t + motion.phase) - np.sin(motion.phase)))


def gained(begin: float, end: float) -> Vector:
    """The velocity that shaking gives, by quadrature."""
    omega = 2.0 * np.pi * SHAKEN.frequency
    return np.array([
        quad(lambda t, k=k: SHAKEN.amplitude[k] * np.sin(omega[k] * t + SHAKEN.phase[k]), begin,
             end)[0] for k in range(3)
    ])  # fmt: skip


def test_the_gap_is_along_the_normal_from_where_the_plane_is_now() -> None:
    due = 0.02 + NORMAL @ (X - path(BASE, 0, NOW))
    assert gap_at(ground(), tuple(X), NOW) == pytest.approx(due)


def test_parts_of_a_vector_are_those_in_the_plane_and_in_free_directions() -> None:
    assert tangential(ground(), tuple(V)) == pytest.approx(V - NORMAL @ V * NORMAL)
    turned = np.array([[0.5, 0.3, 0.1], [0.2, 0.7, 0.4], [0.9, 0.6, 0.8]])
    assert project_free(ground(hold=turned), tuple(V)) == pytest.approx(turned @ V)


def test_without_contact_forces_in_free_directions_change_the_velocity() -> None:
    due = V + HOLD @ (SPAN * (GRAVITY + LOAD) + gained(NOW, NOW + SPAN))
    assert free_velocity(ground(), tuple(V), NOW, SPAN) == pytest.approx(due)
    flown = in_flight(ground(), tuple(V), NOW, SPAN)
    assert flown.u == pytest.approx(due - path(BASE, 1, NOW + SPAN))
    assert (flown.p, flown.rub) == (0.0, ZERO)


@pytest.mark.parametrize("slides", [True, False])
@pytest.mark.parametrize("seed", range(6))
def test_friction_is_the_impulse_in_its_disc_nearest_to_the_one_that_sticks(
    seed: int, slides: bool
) -> None:
    random = np.random.default_rng(seed)
    u, need = random.normal(size=3) - 1.5 * NORMAL, random.normal()
    d, turn = (tangential(ground(), tuple(random.normal(size=3))) for _ in range(2))
    d = tuple(np.array(d) / np.linalg.norm(d)) if slides else ZERO
    turn = tuple(0.1 * np.array(turn)) if slides else ZERO
    p = max(0.0, need - u @ NORMAL)
    centre, radius = -0.4 * p * (0.5 * np.array(d) + turn), (0.2 if slides else 0.4) * p
    sticks = -(u - u @ NORMAL * NORMAL)
    off = sticks - centre
    rub = centre + off * min(1.0, radius / np.linalg.norm(off))
    touch = with_contact(ground(), tuple(u), need, d, turn)
    assert touch.p == pytest.approx(p)
    assert touch.rub == pytest.approx(rub, abs=1e-12)
    assert touch.u == pytest.approx(u + p * NORMAL + rub)


def test_a_slow_mass_sticks() -> None:
    touch = with_contact(ground(), tuple(-NORMAL + 0.1 * ACROSS), 0.5, ZERO, ZERO)
    assert touch.p == pytest.approx(1.5)
    assert touch.u == pytest.approx(0.5 * NORMAL)


def flight(made: Ground, v: Vector) -> Any:
    """The gap at the end of a trial of a length."""

    def gap(span: float) -> float:
        end = np.array(free_velocity(made, tuple(v), NOW, span))
        return float(gap_at(made, tuple(X + 0.5 * span * (v + end)), NOW + span))

    return gap


@pytest.mark.parametrize("moves", [True, False])
@pytest.mark.parametrize("v", [V, 1.5 * NORMAL + V, -9.0 * NORMAL])
def test_a_mass_lands_where_its_path_first_meets_the_plane(v: Vector, moves: bool) -> None:
    """Within 1.6 s, and not within half the time that it takes."""
    still = {} if moves else {"base": drive(NO_MOTION), "shaking": drive(NO_MOTION)}
    made = ground(gap=0.1, **still)
    gap, whole = flight(made, v), 1.6
    spans = np.linspace(0.0, whole, 4001)
    first = next(k for k, s in enumerate(spans) if gap(s) < 0.0)
    due = brentq(gap, spans[first - 1], spans[first], xtol=1e-14)
    found = landing_time(made, tuple(X), tuple(v), NOW, whole)
    assert found == pytest.approx(due, rel=1e-7)
    assert landing_time(made, tuple(X), tuple(v), NOW, 0.5 * due) == 0.5 * due


def test_a_mass_below_the_plane_that_goes_on_has_landed() -> None:
    made = ground(gap=-0.1, base=drive(NO_MOTION))
    assert landing_time(made, tuple(X), tuple(-NORMAL), NOW, 1.0) == 0.0
    assert landing_time(made, tuple(X), tuple(5.0 * NORMAL), NOW, 0.1) == 0.1


@pytest.mark.parametrize("gap", [0.0, -0.02, 0.02])
def test_a_trial_closes_its_gap_at_the_end(gap: float) -> None:
    """From rest on the plane; a gap that is open may be closed at a speed that just does so."""
    made = ground(gap=gap, mu=0.0)
    x = path(BASE, 0, NOW)
    touch = trial_step(made, tuple(x), tuple(V), NOW, SPAN, ZERO)
    free = np.array(free_velocity(made, tuple(V), NOW, SPAN)) - path(BASE, 1, NOW + SPAN)
    assert touch.p == pytest.approx(max(0.0, -max(gap, 0.0) / SPAN - free @ NORMAL))
    assert touch.u == pytest.approx(free + touch.p * NORMAL)


def test_the_sag_is_the_velocity_at_mid_step_less_the_mean_of_the_ends() -> None:
    shaken = gained(NOW, NOW + SPAN / 2) - 0.5 * gained(NOW, NOW + SPAN)
    ends = 0.5 * (path(BASE, 1, NOW) + path(BASE, 1, NOW + SPAN))
    sag = HOLD @ shaken - (path(BASE, 1, NOW + SPAN / 2) - ends)
    due = sag - sag @ NORMAL * NORMAL
    assert sag_by_motions(ground(), NOW, SPAN) == pytest.approx(due, abs=1e-12)

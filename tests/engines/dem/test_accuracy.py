"""Claims about the accuracy of the DEM engine: orders, energy, starts under force and at rest."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from adapters.dem import LEAPFROGS, SCHEMES
from cases.contact.single_contact import CASE
from tests.scenes.spheres.dem_contacts import PLAIN, STEPS, VARIANTS, error
from tests.support.adapters.small_asks import case_ask as asked
from vv.ask import Ask, Displacement, History, Knobs, Method, Run, Status, Velocity
from vv.engines import dem
from vv.engines.dem.solve import solve
from vv.scene import Contact, Scene, Spheres, Wall


@pytest.mark.parametrize("variant", VARIANTS)
def test_default_is_second_order_in_every_variant(variant: str) -> None:
    errors = [error(variant, dem.solve_default(asked(variant, dt))) for dt in STEPS]
    assert errors[STEPS.index(1e-3)] <= 1e-4
    assert errors[STEPS.index(1e-5)] <= 1e-8
    assert np.polyfit(np.log(STEPS), np.log(errors), 1)[0] == pytest.approx(2, abs=0.25)


@pytest.mark.parametrize("dt", STEPS)
@pytest.mark.parametrize("scheme", LEAPFROGS)
@pytest.mark.parametrize("test", PLAIN)
def test_energy_is_accounted_for_within_the_declared_bound(
    test: str, scheme: str, dt: float
) -> None:
    run = solve(asked(test, dt), LEAPFROGS[scheme])
    assert run.ledger is not None
    assert run.ledger.bound is not None
    assert 0 < run.ledger.unaccounted <= run.ledger.bound < 0.1 * run.ledger.peak
    assert (run.ledger.terms["friction dissipation"] > 0) == (test in ("T3", "T4"))
    assert (run.ledger.terms["drag dissipation"] > 0) == (test in ("T2", "T4"))


def test_t3_loses_to_friction_what_the_closed_form_says() -> None:
    ledger = dem.solve_default(asked("T3", 1e-4)).ledger
    p, y1 = CASE.defaults("T3"), 0.0220572826
    lost = 0.5 * 21650635.0946 * p["v_b"] ** 2 - 0.5 * p["ks"] * y1**2
    assert ledger is not None
    assert ledger.terms["friction dissipation"] == pytest.approx(lost, rel=1e-5)


def falling(speed: float) -> Ask:
    ball = Spheres(
        position=np.zeros((1, 3)),
        velocity=np.array([[0.0, 0.0, speed]]),
        radius=np.ones(1),
        mass=np.ones(1),
        free=np.array([[False, False, True]]),
    )
    scene = Scene((ball,), Contact(1e4), gravity=np.array([0.0, 0.0, -10.0]))
    return Ask(scene, History(1.0, 0.1), (Displacement(0), Velocity(0)), Knobs(0.01))


def test_a_start_under_force_is_exact_if_centred_and_half_a_step_late_as_published() -> None:
    ask = falling(3.0)
    for solved, late in ((dem.solve_default, 0.0), (dem.solve_published, 0.5 * 0.01 * 10.0)):
        run = solved(ask)
        height, speed = run.values[Displacement(0)][:, 2], run.values[Velocity(0)][:, 2]
        t = run.times
        np.testing.assert_allclose(height, 3 * t - 5 * t**2 - late * t, atol=1e-13)
        np.testing.assert_allclose(speed, 3 - 10 * t - late, atol=1e-13)
    assert SCHEMES[1].method_for(ask.scene.terms()) is Method.LATE_LEAPFROG


@pytest.mark.parametrize("height", [0.0, 0.1])
@pytest.mark.parametrize("free", [[False, True, False], [True, True, True]])
@pytest.mark.parametrize("solve", [dem.solve_default, dem.solve_published])
def test_a_ball_let_go_from_rest_falls(
    solve: Callable[[Ask], Run], free: list[bool], height: float
) -> None:
    ball = Spheres(
        position=np.array([[0.0, 0.1 + height, 0.0]]),
        velocity=np.zeros((1, 3)),
        radius=np.array([0.1]),
        mass=np.array([1.0]),
        free=np.array([free]),
    )
    floor = Wall(np.zeros(3), np.array([0.0, 1.0, 0.0]))
    gravity = np.array([0.0, -9.81, 0.0])
    scene = Scene((floor, ball), Contact(1e5), gravity=gravity)
    seen = (Displacement(1),)
    run = solve(Ask(scene, History(0.05, 1e-3), seen, Knobs(dt=1e-4)))
    assert run.status is Status.RAN
    assert run.values[seen[0]][-1, 1] < 0.0

"""Claims about the critical step that the DEM engine states: beyond it motions grow."""

from __future__ import annotations

import numpy as np
import pytest

from adapters.dem import LEAPFROGS
from tests.support.adapters.small_asks import case_ask as asked
from vv.ask import Ask, Displacement, History, Knobs, Status
from vv.engines import dem
from vv.engines.dem.solve import solve
from vv.scene import Contact, Scene, Spheres, Wall


@pytest.mark.parametrize("scheme", LEAPFROGS)
def test_beyond_the_critical_step_a_collision_diverges(scheme: str) -> None:
    ask = asked("T1", 1e-3)
    limit = dem.critical_step(ask.scene, LEAPFROGS[scheme])
    assert limit == pytest.approx(2 / 15.9384478053, rel=1e-10)
    run = solve(asked("T1", 1.001 * limit), LEAPFROGS[scheme])
    assert run.status is Status.DIVERGED
    assert "step 2, t = 0.25" in run.reason
    assert len(run.times) == 2


def squeezed(eta: float) -> Scene:
    """A ball pressed between two walls, free along x, so that both contacts remain closed."""
    ball = Spheres(
        position=np.zeros((1, 3)),
        velocity=np.array([[1e-6, 0.0, 0.0]]),
        radius=np.array([1.0]),
        mass=np.array([2.0]),
        free=np.array([[True, False, False]]),
    )
    east = Wall(np.array([0.99, 0.0, 0.0]), np.array([-1.0, 0.0, 0.0]))
    west = Wall(np.array([-0.99, 0.0, 0.0]), np.array([1.0, 0.0, 0.0]))
    return Scene((ball, east, west), Contact(1e4, ks=1e3, mu=0.5), eta=eta)


@pytest.mark.parametrize(("scheme", "eta"), [("default", 1e-9), ("published", 20.0)])
def test_the_critical_step_is_where_a_small_motion_starts_to_grow(scheme: str, eta: float) -> None:
    scene, leapfrog = squeezed(eta), LEAPFROGS[scheme]
    limit = dem.critical_step(scene, leapfrog)
    farthest = {}
    for factor in (0.999, 1.01, 1.5):
        dt = factor * limit
        ask = Ask(scene, History(2000 * dt, dt), (Displacement(0),), Knobs(dt))
        run = solve(ask, leapfrog)
        farthest[factor] = float(np.abs(run.values[Displacement(0)]).max())
    assert farthest[0.999] < 1e-6
    assert farthest[1.01] > 1e-3
    assert run.status is Status.DIVERGED


def test_lagged_viscosity_lowers_the_critical_step() -> None:
    scene = asked("T2", 1e-3).scene
    n, k = 6.9282032303, 15.9384478053
    lagged = 2 * ((n**2 + k**2) ** 0.5 - n) / k**2
    assert dem.critical_step(scene, dem.LAGGED) == pytest.approx(lagged, rel=1e-10)
    assert dem.critical_step(scene, dem.CENTRED) == pytest.approx(2 / k, rel=1e-10)


def test_spheres_that_are_held_and_overlap_make_no_step_critical() -> None:
    """Of many spheres without contacts, two that cannot move overlap."""
    x = np.arange(300.0)[:, None] * np.array([3.0, 0.0, 0.0])
    moves = (np.arange(300) < 298)[:, None] * np.ones(3, bool)
    x[299] = x[298] + np.array([1.9, 0.0, 0.0])
    apart = Spheres(x, np.zeros_like(x), np.ones(300), np.full(300, 2.0), moves)
    assert dem.critical_step(Scene((apart,), Contact(1e4)), dem.CENTRED) == pytest.approx(
        2.0 / np.sqrt(2e4 / 2.0)
    )

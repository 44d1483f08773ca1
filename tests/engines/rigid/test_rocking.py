"""Claims about blocks that rock on an edge: pendulums of second order that conserve energy."""

from __future__ import annotations

import functools
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cases.blocks.rocking import CASE as ROCKING
from cases.blocks.rocking_restitution import CASE as RESTITUTION
from tests.engines.rigid.test_motion import solved
from tests.scenes.blocks.block_scenes import ACROSS, DOWN, FLOOR, IN_PLANE, G, box
from vv.ask import Ask, Knobs, Status
from vv.case import Scalar, Series
from vv.engines import rigid
from vv.scene import Block, Contact, Scene, rotated, rotation_about_z

B, H, TILT, SWING = 0.2, 0.6, 0.2, 0.4  # half sides [m], rad, s: before it meets its other edge
RADIUS, SLENDER = np.hypot(B, H), np.arctan(B / H)


def tilted(**given: Any) -> Block:
    """A box at rest on one edge, which is the y axis."""
    c, s = np.cos(TILT), np.sin(TILT)
    axes = np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
    half = np.array([B, 0.3, H])
    return box("rocking", (half * [-1.0, 0.0, 1.0]) @ axes, half, axes, **given)


@functools.cache
def fallen() -> float:
    """The descent of the centre of an inverted pendulum in time (Housner 1963, Eq. 1)."""

    def rate(t: float, y: Any) -> list[float]:
        return [y[1], -3 * G / (4 * RADIUS) * np.sin(SLENDER - y[0])]

    end = solve_ivp(rate, (0.0, SWING), [TILT, 0.0], rtol=1e-11, atol=1e-13).y[0, -1]
    return float(RADIUS * (np.cos(SLENDER - end) - np.cos(SLENDER - TILT)))


def error(dt: float, azimuth: float = 0.0, **given: Any) -> float:
    """The error of the descent [m]; energy must be conserved meanwhile."""
    scene = Scene((FLOOR, tilted(**given)), Contact(np.inf, mu=2.0), gravity=DOWN)
    program = solved(rotated(scene, rotation_about_z(azimuth)), SWING, dt)
    assert np.abs(program.energies.sum(axis=1)).max() <= 1e-9 * program.energies[-1, 0]
    assert program.report[:, 0].max() <= 1e-12  # m/s
    return abs(float(program.arguments[0][-1, 0, 2]) - fallen())


@pytest.mark.parametrize(
    "given", [{"free": IN_PLANE, "free_spin": ACROSS}, {}, {"azimuth": 0.7}], ids=str
)
def test_a_block_rocks_like_a_pendulum_to_second_order(given: dict[str, Any]) -> None:
    coarse, fine = error(4e-3, **given), error(1e-3, **given)
    assert fine <= 2e-7
    assert np.log2(coarse / fine) / 2 >= 1.9


def rocked(variant: str, dt: float, mu: float = 0.6) -> float:
    """The largest error of a variant of the case, as the case measures it."""
    trial = ROCKING.declare(variant, ROCKING.defaults(variant) | {"mu": mu})
    study = trial.study
    run = rigid.solve(Ask(study.scene, study.goal, study.observables, Knobs(dt)))
    assert run.status is Status.RAN, run.reason
    way = trial.quantities[0]
    assert isinstance(way, Series)
    assert way.reference is not None
    exact = way.reference(run.times)
    return float(np.abs(way.observe(run) - exact).max() / np.abs(exact).max())


def test_three_impacts_are_met_at_second_order() -> None:
    """If impacts were noticed late, the error would be of first order: 1e-4 at 1e-3 s."""
    coarse, fine = rocked("released", 2e-3), rocked("released", 2.5e-4)
    assert fine <= 1e-6
    assert np.log2(coarse / fine) / 3 == pytest.approx(2.0, abs=0.15)


@pytest.mark.parametrize("b", [0.002, 0.004, 0.007])
def test_the_edge_of_a_slender_block_lands_within_a_step_however_slowly_it_falls(b: float) -> None:
    """It lands at 5 % of the velocity that weight gives in a step, which is 250 times its own."""
    p = RESTITUTION.defaults("aspect-3") | {"b": b}
    trial = RESTITUTION.declare("aspect-3", p)
    kept = trial.quantities[0]
    assert isinstance(kept, Scalar)
    run = rigid.solve(trial.study.ask(Knobs(1e-3)))
    assert kept.observe(run) == pytest.approx(kept.reference, rel=2e-6)


def test_a_block_just_below_the_threshold_comes_back_and_just_beyond_it_overturns() -> None:
    assert max(rocked("stands", 1e-3), rocked("topples", 1e-3)) <= 5e-4


@pytest.mark.parametrize("mu", [0.4, 5.0])
def test_an_impact_needs_no_more_friction_than_its_impulse_leans(mu: float) -> None:
    """The impulse leans by 0.24; earlier creep of the corner must not decide how friction acts."""
    assert rocked("released", 1e-3, mu) <= 2e-5


def test_a_corner_that_stays_loses_nothing_by_friction_whatever_the_step() -> None:
    """This holds also where the other corner lands: an impact has only the sum of its losses."""
    changed = {"b": 0.12, "h": 0.4, "part": 0.93, "duration": 0.9}
    p = {**ROCKING.defaults("released"), **changed}
    scene = ROCKING.declare("released", p).study.ask(Knobs(1e-3)).scene
    program = solved(scene, 0.9)
    rubbed, hit, arms = (program.energies[:, k] for k in (1, 2, 7))
    assert hit[-1] >= 1.0  # it has landed
    assert np.abs(rubbed).max() <= 1e-11
    assert np.diff(hit).min() >= -1e-12
    assert 1e-6 <= np.abs(arms).max() <= 1e-3  # of second order

"""Claims about rigid blocks that land: a step is cut there, so that none goes into the floor."""

from __future__ import annotations

import numpy as np
import pytest

from tests.engines.rigid.test_motion import solved
from tests.scenes.block_scenes import ACROSS, DOWN, FLOOR, HELD, IN_PLANE, G, box
from vv.ask import Ask, Displacement, History, Knobs
from vv.engines import rigid
from vv.engines.rigid import Program
from vv.scene import Contact, Scene

HALF, LEAN = np.array([0.5, 0.5, 2.5]), 1.2  # m; of the angle at which it stands on an edge


def toppled(mu: float, dt: float) -> Program:
    """A column of 1 x 5 m lets go just past its balance, and lands on its side at 10 m/s."""
    tilt = LEAN * np.arctan(HALF[0] / HALF[2])
    c, s = np.cos(tilt), np.sin(tilt)
    axes = np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
    column = box("column", (HALF * [-1.0, 0.0, 1.0]) @ axes, HALF, axes,
                 free=IN_PLANE, free_spin=ACROSS)  # fmt: skip
    return solved(Scene((FLOOR, column), Contact(np.inf, mu=mu), gravity=DOWN), 2.9, dt, 0.1)


@pytest.mark.parametrize("mu", [0.3, 0.6, 2.0])
@pytest.mark.parametrize("dt", [1e-3, 5e-3])
def test_a_column_that_topples_lands_on_the_floor_and_not_in_it(mu: float, dt: float) -> None:
    """Its tip goes 50 mm in a step of 5 ms: the mean of before and after would take it in by 18."""
    program = toppled(mu, dt)
    assert program.report[:, 2].max() <= 1e-4
    assert program.report[:, 0].max() <= 1e-6
    start, sunk = program.ask.scene.blocks[0].centroid()[2], program.arguments[0][-1, 0, 2]
    assert start + sunk == pytest.approx(HALF[0], abs=1e-9)


def test_where_a_toppled_column_lies_hangs_little_on_the_step() -> None:
    """Pushed out of the floor, it lay 2 mm apart."""
    lies = [toppled(2.0, dt).arguments[0][-1, 0, 0] for dt in (5e-3, 2e-3, 1e-3)]
    assert np.ptp(lies) <= 2e-4


@pytest.mark.parametrize(("part", "height"), [(0.5, 1.0), (0.6, 1.2), (1.1, 2.2)])
def test_a_step_beyond_half_a_flight_lifts_a_thrown_block_too_high(
    part: float, height: float
) -> None:
    """A block whose spin is locked, for which no step is cut: it rises for a whole step."""
    speed = 1.0  # m/s
    thrown = box("thrown", [0, 0, 0.5], [0.5, 0.5, 0.5], velocity=[0, 0, speed], free_spin=HELD)
    step = part * 2 * speed / G
    scene = Scene((FLOOR, thrown), Contact(np.inf, mu=0.5), gravity=DOWN)
    run = rigid.solve(Ask(scene, History(step, step), (Displacement(1),), Knobs(step)))
    highest = run.values[Displacement(1)][:, 2].max() / (speed**2 / (2 * G))
    assert highest == pytest.approx(height, rel=1e-6)

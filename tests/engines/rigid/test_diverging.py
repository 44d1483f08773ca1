"""Claims about blocks whose motion diverges: this is an outcome, however large a step is."""

from __future__ import annotations

import numpy as np
import pytest

from tests.cases.hard.test_standing import scene
from tests.scenes.blocks.block_scenes import DOWN, FLOOR, box
from vv.ask import Ask, Displacement, History, Knobs, Run, Status
from vv.engines import dda, rigid
from vv.engines.dda import Formulation
from vv.scene import Contact, Scene

WAYS = {"default": dda.DEFAULT, "lagged": dda.LAGGED, "published": dda.PUBLISHED}


def ended(run: Run, goal: History, dt: float) -> None:
    """Check that the run diverged and says when, and that it has only the rows before that."""
    assert run.status is Status.DIVERGED
    assert run.reason.startswith("by step ")
    assert len(run.times) <= goal.steps(dt)
    assert all(len(values) == len(run.times) for values in run.values.values())
    assert all(np.isfinite(values).all() for values in run.values.values())


@pytest.mark.parametrize("way", WAYS.values(), ids=WAYS)
@pytest.mark.parametrize(("kn", "dt"), [(1e10, 5e-3), (1e9, 1e-2)])
def test_an_arch_that_falls_in_long_steps_diverges(way: Formulation, kn: float, dt: float) -> None:
    """Of blocks displaced by 1e150 m, contact detection would find no opposite faces."""
    goal = History(1.0, 0.05)
    ask = Ask(scene("arch-thin", part=0.99), goal, (Displacement(5),), Knobs(dt, kn))
    ended(dda.solve(ask, way), goal, dt)


@pytest.mark.parametrize("speed", [1e160, 1e300])
def test_speeds_whose_squares_are_no_numbers_are_a_divergence(speed: float) -> None:
    """It diverges in the first row, so that the run has none."""
    thrown = box("thrown", [0, 0, 0.5], [0.5] * 3, velocity=speed * np.array([1.0, 2.0, -3.0]))
    pair = Scene((FLOOR, thrown, box("top", [0, 0, 1.5], [0.5] * 3)), Contact(np.inf), gravity=DOWN)
    ask = Ask(pair, goal := History(0.1, 0.05), (Displacement(1),), Knobs(1e-2, 1e9))
    for solve in (rigid.solve, dda.solve_default):
        ended(solve(ask), goal, 1e-2)

"""Claims about contacts that slip while they bounce: the bound holds a block that is stepped."""

import math

import numpy as np
import pytest

from cases.hard.knife_edge import CASE
from cases.hard.parts._bounced_slip import Held, slipped
from vv.ask import Ask, Knobs, Method
from vv.case import Exact, Scalar, evaluated
from vv.engines import dda

LONG, LIMIT, W = 1.0, 4.0, 300.0
STEEP = {"crossing": 62.5, "theta": 0.428, "mu": 0.491, "g": 5.91, "duration": 0.386}


def stepped(needed: float, dt: float) -> float:
    """What a block slips [m] whose friction varies by f cos wt, and which is pushed by 1 + f."""
    step, rate, slip = 2e-5, 0.0, 0.0
    for t in np.arange(0.0, LONG, step):
        left = (1.0 + (W * dt) ** 2 / 2.0) ** (-t / (2.0 * dt))
        spare = 1.0 - needed * (1.0 + left)
        rate = max(rate + step * LIMIT * (left * math.cos(W * t) - spare), 0.0)
        slip += step * rate
    return slip


@pytest.mark.parametrize("needed", [0.2, 0.35, 0.5])
@pytest.mark.parametrize("dt", [1e-4, 3e-5])
def test_a_block_on_a_shaken_base_slips_nearly_as_far_and_no_farther(
    needed: float, dt: float
) -> None:
    t = np.linspace(0.0, LONG, 4001)
    held = Held(t, np.full_like(t, LIMIT), np.full_like(t, needed))
    assert 0.6 < stepped(needed, dt) / slipped(held, W, dt) < 1.02


@pytest.mark.parametrize("dt", [1e-4, 2e-5])
def test_edges_slip_while_the_prism_bounces_and_the_bound_contains_it(dt: float) -> None:
    """With much friction the prism only sinks."""
    errors = []
    for mu in (STEEP["mu"], 50.0):
        trial = CASE.declare("topples", {**CASE.defaults("topples"), **STEEP, "mu": mu})
        study, away, knobs = trial.study, trial.quantities[-1], Knobs(dt, 1e8)
        assert isinstance(away, Scalar)
        assert isinstance(away.judge, Exact)
        run = dda.solve_default(Ask(study.scene, study.goal, study.observables, knobs))
        sinks = away.judge.tolerance(Method.PENALTY)
        errors.append(away.observe(run) / evaluated(away.scale))
        assert errors[-1] < sinks.uncut(knobs)
    assert errors[1] < sinks.value + sinks.late * dt < errors[0]

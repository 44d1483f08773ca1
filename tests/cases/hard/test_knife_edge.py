"""Claims about the case of a prism on a knife edge: the friction that it requires."""

from __future__ import annotations

import math

import numpy as np
import pytest

from cases.hard.knife_edge import CASE
from vv.ask import Ask, Knobs, Method
from vv.case import Exact, Level, Scalar, evaluated
from vv.engines import dda
from vv.scene import volume_and_centroid

P = {**CASE.defaults("topples"), "duration": 1e-4, "theta": 0.6}


def needed() -> float:
    """Friction over pressure at release, (1 - h lam^2/g) tan(theta), where it rotates at lam."""
    scene = CASE.declare("topples", {**P, "mu": 10.0}).study.scene
    upper = scene.blocks[1]
    arm = volume_and_centroid(upper.vertices, upper.faces)[1]
    about = float(scene.axes[0] @ upper.inertia @ scene.axes[0])
    share = upper.mass * (arm @ arm) / (about + upper.mass * (arm @ arm))
    return float((1.0 - share) * np.tan(P["theta"]))


def test_edges_slip_with_less_friction_than_the_turn_leaves_to_bear() -> None:
    CASE.declare("topples", {**P, "mu": 1.001 * needed()})
    with pytest.raises(ValueError, match="the edges slip"):
        CASE.declare("topples", {**P, "mu": 0.999 * needed()})


def distance(**given: float) -> tuple[Exact, list[float], float]:
    """The judge of the distance from the exact path, and errors of springs at the coarsest and the
    finest setting of the case over their bounds; the last is that over what springs sink alone.
    """
    trial = CASE.declare("topples", {**CASE.defaults("topples"), **given})
    study, away = trial.study, trial.quantities[-1]
    assert isinstance(away, Scalar)
    assert isinstance(away.judge, Exact)
    found = []
    for knobs in (study.rungs[Level.PAPER][0], study.rungs[Level.PAPER][-1]):
        run = dda.solve_default(Ask(study.scene, study.goal, study.observables, knobs))
        error = away.observe(run) / evaluated(away.scale)
        sinks = away.judge.tolerance(Method.PENALTY)
        found.append(error / sinks.uncut(knobs))
    assert knobs.dt is not None
    return away.judge, found, error / (sinks.value + sinks.late * knobs.dt)


@pytest.mark.parametrize(
    ("theta", "duration", "g"),
    [
        (0.1, 0.5, 9.81),
        (0.043, 0.93, 4.6),
        (0.067, 0.4, 26.0),
        (0.4, 0.3, 9.81),
        (0.617, 0.12, 9.0),
    ],
)
def test_springs_are_off_by_what_they_sink_and_by_half_a_step(
    theta: float, duration: float, g: float
) -> None:
    _, errors, sunk = distance(theta=theta, duration=duration, g=g)
    assert max(errors) < 1.0
    assert sunk > 0.4


def test_bounds_are_computed_from_the_fall() -> None:
    """m = 900 kg and m h^2/I = 0.48886; it topples at 3.46256/s and leans by 0.2905 in the end."""
    judge, errors, sunk = distance()
    assert errors[-1] == pytest.approx(sunk, rel=0.02)  # hardly anything slips
    sinks, early = judge.tolerance(Method.PENALTY), judge.tolerance(Method.FIRST_ORDER)
    x, way = 3.4625578 / 2, 0.0760846
    deep = 2 * 900.0 * 9.81 / 1e8 * (1 + 0.4888606 * math.sin(0.2904993)) / way
    late = 3.4625578 / 4 * (x * math.cosh(x) - math.sinh(x)) / (math.cosh(x) - 1)
    assert (sinks.value, sinks.late) == pytest.approx((deep, late), rel=1e-5)
    assert sinks.kn == 1e8
    half = 3.4625578e-3 / 2 * math.sinh(x) / (math.cosh(x) - 1)
    assert early.at(Knobs(1e-3)) == pytest.approx(half, rel=1e-6)


@pytest.mark.parametrize("duration", [1e-6, 1e-3])
def test_the_bound_of_short_falls_is_that_of_a_small_lam_t(duration: float) -> None:
    judge = CASE.declare("topples", {**P, "duration": duration}).quantities[-1].judge
    assert isinstance(judge, Exact)
    assert judge.tolerance(Method.PENALTY).late == pytest.approx(3.46**2 * duration / 6, rel=0.05)


def test_lagging_friction_is_judged_at_the_parameters_of_the_case() -> None:
    """Elsewhere it lets edges slip each time the springs let go, which no bound limits."""
    own, _, _ = distance()
    other, _, _ = distance(theta=0.11)
    assert own.tolerance(Method.LAGGING) == own.tolerance(Method.PENALTY)
    assert Method.LAGGING not in other.tolerances
    assert "slip, again and again" in other.not_judged[Method.LAGGING]

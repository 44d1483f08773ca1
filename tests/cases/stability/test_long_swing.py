"""Claims about undamped oscillations: theory, two routes, the leapfrog over a million periods."""

import dataclasses
import math
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions.checks.contact import leapfrog as stepped
from reference_solutions.contact import leapfrog as theory
from tests.support.turned_signs import caught, signs, turned
from vv.ask import Ask, Displacement, History, Knobs, Method, Observable, Run, Status, Velocity
from vv.case import Level
from vv.engines import dem
from vv.plan.project import find
from vv.records.record import measured
from vv.scene import Vector

CASE = find().load_case("long-swing")
TRIAL = CASE.declare("pressed", CASE.defaults("pressed"))
W = math.sqrt(5.5e9 / 21650635.0946)
ANGLES = (1e-2, 0.3, 1.0, 1.9)


@given(st.floats(1e-3, 1.99))
@settings(max_examples=60)
def test_the_two_routes_agree(angle: float) -> None:
    assert stepped.phase_per_step(angle) == pytest.approx(theory.phase_per_step(angle), rel=1e-9)
    assert stepped.stiffness(angle) == pytest.approx(theory.stiffness(angle), abs=1e-8)


def test_a_swing_is_too_fast_by_a_24th_of_the_square() -> None:
    assert theory.phase_per_step(0.01) / 0.01 - 1 == pytest.approx(0.01**2 / 24, rel=1e-4)


def test_a_million_periods_keep_the_shadow_energy_and_the_phase_of_theory() -> None:
    """The run has 25 million steps; outputs are dense enough to count the periods."""
    angle, period = 0.25, 2 * math.pi / W
    goal = History(1e6 * period, 100.3 * period)
    ask = Ask(TRIAL.study.scene, goal, (Displacement(1), Velocity(1)), Knobs(angle / W))
    run = dem.solve_default(ask)
    drift, _, _, phase, damping = (float(q.observe(run)) for q in TRIAL.quantities)
    assert run.steps > 25e6
    assert drift < 1e-11
    assert phase == pytest.approx(1.0, abs=1e-11)
    assert abs(damping) < 1e-17


def path(angle: float, x: Vector | float = 0.0, v: Vector | float = 0.0) -> Run:
    """The theoretical path of a leapfrog over 2000 steps of W dt = angle, with errors x and v."""
    n = np.arange(0, 2001, 20)
    turned_by, dt = theory.phase_per_step(angle) * n, angle / W
    moved = angle / math.sin(theory.phase_per_step(angle)) * np.sin(turned_by) / W + x
    along = np.array([1.0, 0.0, 0.0])
    values: dict[Observable, Vector] = {
        Displacement(1): moved[:, None] * along,
        Velocity(1): (np.cos(turned_by) + v)[:, None] * along,
    }
    return Run(Status.RAN, times=np.asarray(n * dt, float), values=values, steps=2000)


def verdicts(run: Run) -> list[str]:
    knobs = Knobs(float(run.times[-1]) / run.steps)
    quantities = TRIAL.quantities
    return [measured(run, q, Method.LEAPFROG, knobs)[0].verdict.value for q in quantities]


def test_a_path_by_theory_passes_at_every_step_with_one_step_more_or_without() -> None:
    for angle in (0.05, 0.1, 0.2, 0.4):
        run = path(angle)
        assert verdicts(run) == ["pass"] * 5
        assert verdicts(dataclasses.replace(run, steps=2001))[3] == "pass"


def test_energy_that_grows_by_a_part_in_1e10_and_a_wrong_rate_fail() -> None:
    grown = 1 + 1e-10 * np.linspace(0, 1, 101)
    run = path(0.1)
    values = {what: moved * grown[:, None] for what, moved in run.values.items()}
    assert verdicts(dataclasses.replace(run, values=values))[0] == "fail"
    late = dataclasses.replace(run, times=run.times * (1 + 2e-5))
    assert verdicts(late)[3] == "fail"
    far = dataclasses.replace(run, times=run.times * 0.98)
    assert verdicts(far)[2] == "fail"


def test_a_swing_that_decays_has_its_damping_ratio() -> None:
    run = path(0.1)
    faded = np.exp(-3e-6 * W * run.times)
    values = {what: moved * faded[:, None] for what, moved in run.values.items()}
    decaying = dataclasses.replace(run, values=values)
    assert TRIAL.quantities[4].observe(decaying) == pytest.approx(3e-6, rel=1e-3)
    assert verdicts(decaying)[4] == "fail"


def test_levels_grow_and_the_phase_stays_countable() -> None:
    """Between two outputs a leapfrog leads the exact oscillation by less than half a period."""
    study = TRIAL.study
    for knobs in study.rungs[Level.PAPER]:
        assert knobs.dt is not None
        angle = W * knobs.dt
        ahead = (theory.phase_per_step(angle) / angle - 1) * W * study.goal.interval
        assert ahead < 0.5 * math.pi


def same(route: ModuleType) -> bool:
    """Whether a route has the known phase and stiffness."""
    found = [(route.phase_per_step(a), route.stiffness(a)) for a in ANGLES]
    due = [(2 * math.asin(a / 2), 1 - a * a / 4) for a in ANGLES]
    return bool(np.allclose(found, due, rtol=1e-8))


@pytest.mark.parametrize("sign", signs(theory))
def test_any_wrong_sign_in_the_theory_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(theory, sign)))


@pytest.mark.parametrize("sign", signs(stepped, (), ("-1",)))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(stepped, sign)))


def test_a_step_beyond_the_limit_is_refused() -> None:
    with pytest.raises(ValueError, match=r"angle = 2.0 rad; from 2 on"):
        theory.phase_per_step(2.0)

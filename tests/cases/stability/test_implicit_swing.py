"""Claims about the implicit step of DDA: theory, the step itself, and the engine agree."""

import dataclasses
import math
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions.blocks import implicit_step as theory
from reference_solutions.checks.blocks import implicit_step as taken
from tests.support.turned_signs import caught, signs, turned
from vv.ask import Ask, Displacement, History, Knobs, Method, Run
from vv.case import Level, Trial
from vv.engines import dda
from vv.plan.project import find
from vv.records.record import measured
from vv.scene import Block, Contact, Scene, box_geometry, polyhedron_inertia

CASE = find().load_case("implicit-swing")


@given(st.floats(1e-3, 1e4))
@settings(max_examples=100)
def test_the_two_routes_agree(angle: float) -> None:
    assert np.abs(taken.roots(angle)).max() == pytest.approx(
        theory.spectral_radius(angle), rel=1e-7
    )
    if angle < 3.99:
        assert taken.damping_ratio(angle) == pytest.approx(theory.damping_ratio(angle), rel=1e-6)


def test_small_steps_damp_by_a_quarter_of_their_angle_and_large_ones_not_at_all() -> None:
    assert theory.damping_ratio(0.09213) == pytest.approx(0.023, rel=2e-3)
    assert theory.damping_ratio(1e-3) == pytest.approx(0.25e-3, rel=1e-6)
    assert theory.spectral_radius(4.0) == pytest.approx(1 / 3, rel=1e-15)
    assert 1 - theory.spectral_radius(1e4) == pytest.approx(8e-8, rel=1e-6)


PRINTED = [(1e-2, 0.22568), (1e-3, 0.031756), (1e-4, 0.0032726), (1e-5, 0.00032823)]


@pytest.mark.parametrize(("dt", "printed"), PRINTED)
def test_three_percent_of_kinetic_damping_leave_less_the_smaller_the_step(
    dt: float, printed: float
) -> None:
    """An acceleration of 1 m/s2 for 1 s should move the block by 0.5 m."""
    steps = round(1 / dt)
    closed = theory.damped_drive(1.0, dt, steps, 0.97)
    assert closed == pytest.approx(printed, rel=3e-5)
    assert taken.damped_drive(1.0, dt, steps, 0.97) == pytest.approx(closed, rel=1e-10)
    assert pushed(dt, steps) == pytest.approx(closed, rel=1e-10)
    assert theory.damped_drive(1.0, dt, steps, 1.0) == pytest.approx(0.5, rel=1e-12)


def pushed(dt: float, steps: int) -> float:
    """The displacement of a block under 1 m/s2 in the engine, with 3 % of kinetic damping."""
    vertices, faces = box_geometry(np.zeros(3), np.ones(3), np.eye(3))
    mass, inertia = polyhedron_inertia(vertices, faces, 1.0)
    still, free = np.zeros(3, bool), np.ones(3, bool)
    body = Block("box", vertices, faces, mass, inertia, np.zeros(3), free, still)
    scene = Scene((body,), Contact(math.inf), gravity=np.array([1.0, 0.0, 0.0]))
    ask = Ask(scene, History(1.0, steps * dt), (Displacement(0),), Knobs(dt, 1e8))
    run = dda.solve(ask, dataclasses.replace(dda.DEFAULT, dd=0.97))
    return float(run.values[Displacement(0)][-1, 0])


def judged(trial: Trial, run: Run) -> list[str]:
    rung = trial.study.rungs[Level.DEFAULT][1]
    return [measured(run, q, Method.PENALTY, rung)[0].verdict.value for q in trial.quantities]


@pytest.mark.parametrize("variant", ["complex", "near-four"])
def test_a_step_that_hands_on_a_millionth_less_fails(variant: str) -> None:
    trial = CASE.declare(variant, CASE.defaults(variant))
    ask = trial.study.ask(trial.study.rungs[Level.DEFAULT][1])
    assert judged(trial, dda.solve(ask, dda.DEFAULT)) == ["pass"] * 2
    damped = dataclasses.replace(dda.DEFAULT, dd=1 - 1e-6)
    assert judged(trial, dda.solve(ask, damped)) == ["fail"] * 2


def test_a_start_so_fast_that_the_tip_leaves_is_refused() -> None:
    with pytest.raises(ValueError, match=r"v = 0.1 m/s; from g/w = 0.0981 m/s on, the tip"):
        CASE.declare("complex", {**CASE.defaults("complex"), "v": 0.1})


def same(route: ModuleType) -> bool:
    """Whether a route has the roots, the damping and the damped motion of the other route."""
    if hasattr(route, "roots"):
        radii = [np.abs(route.roots(angle)).max() for angle in (0.3, 3.0, 30.0)]
    else:
        radii = [route.spectral_radius(angle) for angle in (0.3, 3.0, 30.0)]
    due = [np.abs(taken.roots(angle)).max() for angle in (0.3, 3.0, 30.0)]
    found = [route.damping_ratio(0.3), route.damped_drive(1.0, 0.1, 7, 0.9)]
    told = [taken.damping_ratio(0.3), taken.damped_drive(1.0, 0.1, 7, 0.9)]
    return bool(np.allclose([*radii, *found], [*due, *told], rtol=1e-9))


@pytest.mark.parametrize("sign", signs(theory))
def test_any_wrong_sign_in_the_theory_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(theory, sign)))


@pytest.mark.parametrize("sign", signs(taken))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(taken, sign)))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: theory.spectral_radius(0.0), r"angle = 0.0 rad; .*positive"),
        (lambda: theory.damping_ratio(4.0), r"angle = 4.0 rad; from 4 on"),
        (lambda: theory.damped_drive(1.0, 1.0, 1, 1.1), r"kept = 1.1; .*between"),
    ],
)
def test_what_theory_does_not_cover_is_refused(call: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()  # type: ignore[operator]

"""Claims about a chain on a base: its modes, its waves, and their reflection at a jump of mass."""

import math
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cases.stability.parts._pulse import Pulse, returned_energy
from reference_solutions.checks.contact import chain as stepped
from reference_solutions.contact import chain as closed
from tests.support.turned_signs import caught, signs, turned
from vv.ask import Ask, History, Knobs, Method
from vv.case import Exact, Level, Scalar, Series, Trial, evaluated
from vv.engines import dem
from vv.plan.project import find
from vv.scene import Scene

CASE = find().load_case("chain")
N, M, K = 100, 1.0, 1e6
PLACE = np.arange(1.0, N + 1.0)
PULSE = PLACE * np.exp(-((PLACE / 8) ** 2))
TIMES = np.linspace(0.0, 0.1, 11)


@pytest.mark.parametrize("j", [1, 3, 50, 99, 100])
def test_a_wave_at_the_frequency_of_a_mode_leaves_the_free_end_at_rest(j: int) -> None:
    w = closed.frequency(j, N, M, K)
    assert abs(stepped.residual(w, N, M, K)) < 1e-11
    assert abs(stepped.residual(1.0001 * w, N, M, K)) > 1e-6


def test_a_chain_thrown_in_a_mode_stays_in_it() -> None:
    w, shape = closed.frequency(7, N, M, K), closed.shape(7, N)
    u, v = stepped.motion(TIMES, shape, np.full(N, M), K)
    assert u == pytest.approx(np.outer(np.sin(w * TIMES) / w, shape), abs=1e-12 / w)
    assert v == pytest.approx(np.outer(np.cos(w * TIMES), shape), abs=1e-12)


@pytest.mark.parametrize("jump", [1.0, 4.0])
def test_the_two_routes_agree_on_a_pulse(jump: float) -> None:
    masses = np.where(PLACE > 50, jump, 1.0)
    routes = [route.motion(TIMES, PULSE, masses, K) for route in (closed, stepped)]
    for one, other in zip(*routes, strict=True):
        assert np.abs(one - other).max() < 1e-12 * np.abs(one).max()


@pytest.mark.parametrize("jump", [0.3, 1.0, 9.17])
def test_a_leapfrog_has_modes_of_other_frequencies_and_no_other_error(jump: float) -> None:
    masses, dt = np.where(PLACE > 50, jump, 1.0), 1.7e-4
    taken = stepped.leapfrog(300, PULSE, masses, K, dt)
    _, due = closed.leapfrog(dt * np.arange(301), PULSE, masses, K, dt)
    assert np.abs(taken - due).max() < 1e-12 * np.abs(PULSE).max()


def test_displacements_of_a_leapfrog_change_by_its_velocities_half_a_step_off() -> None:
    masses, dt = np.full(N, M), 1.7e-4
    u, v = closed.leapfrog(dt * np.arange(9), PULSE, masses, K, dt)
    between = np.diff(u, axis=0) / dt
    assert (between[1:] + between[:-1]) / 2 == pytest.approx(v[1:-1], abs=1e-10)


@given(st.floats(1e-3, 0.9), st.floats(1.1, 9.0))
@settings(max_examples=60)
def test_the_two_routes_agree_on_what_a_jump_sends_back(q: float, M: float) -> None:
    if math.sqrt(M) * math.sin(q / 2) < 0.999:
        assert stepped.reflected(q, 1.0, M) == pytest.approx(closed.reflected(q, 1.0, M, K))


def test_long_waves_leave_a_ninth_behind_and_short_ones_all() -> None:
    assert closed.reflected(1e-4, 1.0, 4.0, K) == pytest.approx(1 / 9, rel=1e-6)
    assert closed.reflected(1.5, 1.0, 4.0, K) == 1.0


def scalar(trial: Trial, name: str) -> Scalar:
    """The measured quantity of this name."""
    (found,) = (q for q in trial.quantities if isinstance(q, Scalar) and q.name == name)
    return found


def reference_of(trial: Trial, name: str) -> float:
    """The reference value of the quantity of this name."""
    reference = scalar(trial, name).reference
    assert reference is not None
    return evaluated(reference)


def test_the_pulse_leaves_behind_what_its_waves_do() -> None:
    """The energy of each wave number of the pulse is reflected by the coefficient of the jump."""
    trial = CASE.declare("jump", CASE.defaults("jump"))
    due = reference_of(trial, "returned")
    q = np.linspace(1e-3, 1.0, 2000)
    part = np.abs(np.sin(np.outer(q, PLACE)) @ PULSE) ** 2
    back = np.array([closed.reflected(one, 1.0, 4.0, K) for one in q])
    passed = np.cos(q / 2)  # flux of energy at the wave number q, by the group velocity
    assert due == pytest.approx((part * back * passed).sum() / (part * passed).sum(), rel=2e-3)


def test_the_pulse_goes_as_fast_as_its_waves_do() -> None:
    trial = CASE.declare("pulse", CASE.defaults("pulse"))
    due = reference_of(trial, "speed")
    q = np.linspace(1e-3, 1.0, 2000)
    part = np.abs(np.sin(np.outer(q, PLACE)) @ PULSE) ** 2
    speed = np.cos(q / 2)  # group velocity, in masses times sqrt(K/m)
    assert due == pytest.approx((part * speed).sum() / part.sum(), rel=2e-3)


def _largest(scene: Scene) -> float:
    """The largest stable step of the engine over that of two masses on their spring."""
    return dem.critical_step(scene, dem.CENTRED) * math.sqrt(K / M)


def test_the_engine_knows_the_highest_mode() -> None:
    scene = CASE.declare("mode-100", CASE.defaults("mode-100")).study.scene
    due = 2 / closed.frequency(N, N, M, K) * math.sqrt(K / M)
    assert _largest(scene) == pytest.approx(due, rel=5e-5)  # the accuracy of the iteration


def measured(jump: float, dt: float, part: float = 0.05) -> dict[str, tuple[float, float]]:
    """Quantity -> the error of the engine and its bound, at a jump and a step [s]."""
    trial = CASE.declare("jump", {**CASE.defaults("jump"), "jump": jump, "part": part})
    study, knobs = trial.study, Knobs(dt)
    run = dem.solve_default(Ask(study.scene, study.goal, study.observables, knobs))
    found = {}
    for one in trial.quantities:
        assert isinstance(one.judge, Exact)
        if isinstance(one, Series):
            assert one.reference is not None
            assert isinstance(one.scale, float)
            off = float(np.abs(one.observe(run) - one.reference(run.times)).max()) / one.scale
        else:
            off = abs(scalar(trial, one.name).observe(run) - reference_of(trial, one.name))
        found[one.name] = off, one.judge.tolerance(Method.LEAPFROG).at(knobs)
    return found


@pytest.mark.parametrize("jump", [0.05, 0.3, 0.8, 0.99, 1.03, 1.2, 2.0, 9.17, 30.0, 100.0])
@pytest.mark.parametrize("rung", [0, 1, 3])
def test_bounds_are_errors_of_a_leapfrog_at_every_jump(jump: float, rung: int) -> None:
    study = CASE.declare("jump", {**CASE.defaults("jump"), "jump": jump}).study
    knobs = study.rungs[Level.PAPER][rung]
    assert knobs.dt is not None
    for name, (error, bound) in measured(jump, knobs.dt).items():
        assert error < bound, name
        if bound > 2e-8 and jump < 100:  # below, rounding counts; beyond, coarser steps are worse
            assert error > 0.85 * bound, name


@pytest.mark.parametrize("jump", [0.8, 1.0, 1.03, 4.0, 9.17, 30.0])
@pytest.mark.parametrize("dt", [7e-4, 3e-4, 1.6e-4, 1.1e-4, 3e-5])
def test_bounds_hold_at_steps_that_are_none_of_the_case(jump: float, dt: float) -> None:
    assert all(error < bound for error, bound in measured(jump, dt).values())


@pytest.mark.parametrize(("jump", "within"), [(0.3, 3e-9), (1.0, 1e-11), (4.0, 3e-9)])
def test_one_output_more_hardly_changes_the_energy_that_returns(jump: float, within: float) -> None:
    """With sharp ends what returns along equal masses, 1e-9, changes by half."""
    pulse = Pulse(PULSE, np.where(PLACE > 50, jump, 1.0), K, History(0.1, 5e-4))
    path = pulse.path()
    due, *others = (
        returned_energy(t, path(t), 0.1)
        for t in (np.arange(0.0, 0.1, every) for every in (1e-5, 4.1e-4, 5e-4, 5.9e-4))
    )
    assert others == pytest.approx([due] * 3, abs=within)


def test_the_bound_holds_beside_the_smallest_motion_that_is_accepted() -> None:
    assert all(error < bound for error, bound in measured(4.0, 2.5e-5, 2.9e-4).values())
    with pytest.raises(ValueError, match="must be below 3e-07"):
        measured(4.0, 2.5e-5, 2.8e-4)


def test_a_wrong_mass_at_the_jump_is_seen() -> None:
    trial = CASE.declare("jump", CASE.defaults("jump"))
    wrong = CASE.declare("jump", {**CASE.defaults("jump"), "jump": 4.01}).study
    rung = trial.study.rungs[Level.DEFAULT][-1]
    run = dem.solve_default(Ask(wrong.scene, wrong.goal, wrong.observables, rung))
    assert scalar(trial, "returned").observe(run) - reference_of(trial, "returned") > 1e-4


def same(route: ModuleType) -> bool:
    """Whether a route has the known values for a chain of seven masses with a jump."""
    masses, thrown = np.where(np.arange(7) > 3, 2.0, 1.0), np.arange(7.0) ** 2
    t = np.linspace(0.0, 3.0, 4)
    due = stepped.motion(t, thrown, masses, 1.0)
    found = route.motion(t, thrown, masses, 1.0)
    good = all(np.allclose(one, other, atol=1e-9) for one, other in zip(found, due, strict=True))
    if hasattr(route, "residual"):
        moves = route.leapfrog(9, thrown, masses, 1.0, 0.3)
    else:
        moved, moves = route.leapfrog(0.3 * np.arange(10), thrown, masses, 1.0, 0.3)
        good = good and np.allclose(moved[1], 0.3 * thrown, atol=1e-12)
    good = good and np.allclose(moves, stepped.leapfrog(9, thrown, masses, 1.0, 0.3), atol=1e-9)
    if hasattr(route, "residual"):
        modes = [route.residual(closed.frequency(j, 7, 2.0, 3.0), 7, 2.0, 3.0) for j in (1, 7)]
        back = route.reflected(0.3, 1.0, 4.0) - 0.1218105725752977
        return good and bool(np.abs([*modes, back]).max() < 1e-9)
    modes = [stepped.residual(route.frequency(j, 7, 2.0, 3.0), 7, 2.0, 3.0) for j in (1, 7)]
    shape = route.shape(5, 7) / route.shape(5, 7)[0]
    bent = shape[1] - 2 + route.frequency(5, 7, 1.0, 1.0) ** 2  # equation of the first mass
    back = route.reflected(0.3, 1.0, 4.0, 1.0) - stepped.reflected(0.3, 1.0, 4.0)
    good = good and len(route.shape(5, 7)) == 7
    return good and bool(np.abs([*modes, bent, back]).max() < 1e-9)


@pytest.mark.parametrize("sign", signs(closed))
def test_any_wrong_sign_in_the_closed_forms_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(closed, sign)))


ONLY_ITS_SIZE_COUNTS = ("-np.array([np.exp(1j * q), 1.0])",)


@pytest.mark.parametrize("sign", signs(stepped, (), ONLY_ITS_SIZE_COUNTS))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(stepped, sign)))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: closed.frequency(0, 5, 1.0, 1.0), "j = 0; a chain of 5 has modes 1 to 5"),
        (lambda: closed.reflected(3.2, 1.0, 4.0, 1.0), r"q = 3.2 rad; .*between 0 and pi"),
        (lambda: closed.motion(0.0, np.ones(3), np.ones(2), 1.0), r"masses has shape \(2,\)"),
        (
            lambda: closed.leapfrog(0.0, np.ones(9), np.ones(9), 1.0, 1.1),
            r"dt = 1.1 s; a leapfrog diverges from 1.01",
        ),
        (lambda: CASE.declare("jump", {**CASE.defaults("jump"), "jump": 0.0}), "jump = 0.0; mass"),
        (lambda: CASE.declare("pulse", {**CASE.defaults("pulse"), "part": 0.3}), "part = 0.3"),
    ],
)
def test_what_is_out_of_range_is_refused(call: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()  # type: ignore[operator]


@pytest.mark.parametrize("mode", [50, 100])
@pytest.mark.parametrize("dt", [9.9e-4, 7e-4, 5e-4, 3e-4, 2e-4, 1e-4])
def test_bounds_of_a_frequency_hold_at_every_stable_step(mode: int, dt: float) -> None:
    """The first term of the series of the phase error is a seventh too small at w dt = 1."""
    variant = f"mode-{mode}"
    trial = CASE.declare(variant, CASE.defaults(variant))
    study, knobs = trial.study, Knobs(dt)
    run = dem.solve_default(Ask(study.scene, study.goal, study.observables, knobs))
    error = abs(scalar(trial, "frequency").observe(run) - 1.0)
    judge = scalar(trial, "frequency").judge
    assert isinstance(judge, Exact)
    assert 0.93 < error / judge.tolerance(Method.LEAPFROG).uncut(knobs) < 1.0

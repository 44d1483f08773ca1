"""Claims about a spring and a dashpot without tension: two routes agree, and codes follow."""

from __future__ import annotations

import dataclasses
from math import exp, pi, sqrt
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions.checks.contact import dashpot as integrated
from reference_solutions.contact import dashpot as closed
from tests.support.turned_signs import caught, signs, turned
from vv.ask import Ask, Knobs, Run, Status, Velocity
from vv.case import Scalar
from vv.engines import dem, exact
from vv.plan.project import find
from vv.scene import Contact, Scene, Spheres

PROJECT = find()
CASE = PROJECT.load_case("dashpot")
LAW = {"m": 3.0, "kn": 2e4, "v": 0.7}
T = np.linspace(0.0, 0.06, 301)


def agree(z: float, one: ModuleType, other: ModuleType) -> bool:
    """Whether the routes agree on the overlap, the restitution and the duration."""
    path = one.overlap(T, z=z, **LAW)
    due, e, lasting = other.collision(T, z=z, **LAW)
    apart = np.abs(path - due).max() / np.abs(due).max()
    m, kn = LAW["m"], LAW["kn"]
    return bool(
        apart < 1e-11
        and abs(one.restitution(z) - e) < 1e-11
        and abs(one.contact_time(m=m, kn=kn, z=z) / lasting - 1) < 1e-11
    )


@given(st.floats(0.0, 0.99))
@settings(max_examples=10)
def test_the_two_routes_agree(z: float) -> None:
    assert agree(z, closed, integrated)


@pytest.mark.parametrize("sign", signs(closed))
def test_any_wrong_sign_in_the_formula_is_caught(sign: int) -> None:
    assert caught(lambda: agree(0.4, turned(closed, sign), integrated))


@pytest.mark.parametrize("sign", signs(integrated, (), ("-1",)))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    assert caught(lambda: agree(0.4, closed, turned(integrated, sign)))


def test_what_catches_wrong_signs_lets_unchanged_copies_pass() -> None:
    assert agree(0.4, turned(closed, None), turned(integrated, None))


def test_critical_damping_and_more_are_refused() -> None:
    assert closed.restitution(1 - 1e-9) == pytest.approx(exp(-2), rel=1e-4)
    with pytest.raises(ValueError, match=r"z = 1.0; it must lie in \[0, 1\)"):
        closed.restitution(1.0)


def asked(z: float, dt: float | None = None) -> Ask:
    study = CASE.declare("z-0", {**CASE.defaults("z-0"), "z": z}).study
    return study.ask(Knobs(dt))


def returned(run: Run) -> float:
    assert run.status is Status.RAN, run.reason
    speed = run.values[Velocity(1)][:, 2]
    return float(-speed[-1] / speed[0])


@given(st.floats(0.01, 0.99))
@settings(max_examples=20)
def test_exact_and_dem_return_it_as_the_formula_says(z: float) -> None:
    due, step = closed.restitution(z), 5e-6
    assert abs(returned(exact.solve(asked(z))) - due) < 1e-13
    assert abs(returned(dem.solve_default(asked(z, step))) - due) < 1e-4 * due
    assert abs(returned(dem.solve_published(asked(z, step))) - due) < 2e-2 * due


@pytest.mark.parametrize("solve", [exact.solve, dem.solve_default, dem.solve_published])
def test_what_the_dashpot_takes_is_booked(solve: object) -> None:
    """It is the kinetic energy that the restitution removes, also of contacts that have ended."""
    run: Run = solve(asked(0.6, 5e-6))  # type: ignore[operator]
    ledger = run.ledger
    assert ledger is not None
    assert ledger.bound is not None
    assert ledger.unaccounted <= ledger.bound <= 2e-4 * ledger.peak
    lost = ledger.terms["drag dissipation"] / ledger.peak
    assert lost == pytest.approx(1 - returned(run) ** 2, abs=1e-4)


def test_a_contact_that_pulled_would_be_seen() -> None:
    """The restitution at the end of the overlap is smaller by far more than any tolerance."""
    z = 0.3
    assert exp(-pi * z / sqrt(1 - z * z)) < 0.9 * closed.restitution(z)


def test_a_code_that_does_not_see_the_wall_tells_no_time_in_contact() -> None:
    lasted = CASE.declare("z-0", CASE.defaults("z-0")).quantities[-1]
    assert isinstance(lasted, Scalar)
    run = Run(Status.RAN, times=np.arange(3.0), values={Velocity(1): np.full((3, 3), -0.01)})
    assert np.isnan(lasted.observe(run))


def test_two_spheres_meet_as_one_of_their_reduced_mass() -> None:
    m, M, z, kn = 1.0, 3.0, 0.5, 1e4
    reduced = m * M / (m + M)
    along = np.array([1.0, 0.0, 0.0])
    pair = Spheres(
        np.array([0 * along, 2 * along]), np.array([0 * along, -along]), np.ones(2),
        np.array([m, M]), np.array([[True, False, False]] * 2),
    )  # fmt: skip
    scene = Scene((pair,), Contact(kn, eta_n=2 * z * sqrt(kn * reduced)))
    ask = dataclasses.replace(
        asked(0.0), scene=scene, goal=dataclasses.replace(asked(0.0).goal, duration=0.1),
        observables=(Velocity(0), Velocity(1)),
    )  # fmt: skip
    run = exact.solve(ask)
    apart = run.values[Velocity(1)][-1] - run.values[Velocity(0)][-1]
    assert apart[0] == pytest.approx(closed.restitution(z), abs=1e-13)
    stepped = dem.solve_default(dataclasses.replace(ask, knobs=Knobs(1e-4)))
    apart = stepped.values[Velocity(1)][-1] - stepped.values[Velocity(0)][-1]
    assert apart[0] == pytest.approx(closed.restitution(z), rel=1e-4)


def test_the_lagging_dashpot_lowers_the_largest_stable_step() -> None:
    m, kn, z = 1.0, 1e6, 0.9
    w = sqrt(kn / m)
    limit = 2 * (sqrt((z * w) ** 2 + w**2) - z * w) / w**2
    scene = asked(z).scene
    assert dem.critical_step(scene, dem.LAGGED) == pytest.approx(limit, rel=1e-12)
    assert dem.critical_step(scene, dem.CENTRED) == pytest.approx(2 / w, rel=1e-12)


def test_viscous_contact_has_a_stiffness_and_is_not_negative() -> None:
    with pytest.raises(ValueError, match=r"kn = inf N/m.*a finite kn"):
        Contact(np.inf, eta_n=1.0)
    with pytest.raises(ValueError, match=r"Contact.eta_n = -1.0 N s/m; it must be zero or more"):
        Contact(1.0, eta_n=-1.0)


def test_liggghts_and_yade_are_given_the_dashpot_itself() -> None:
    ask = asked(0.5, 1e-5)
    liggghts = PROJECT.load_adapter("liggghts").native(ask, "default")
    assert "gamman_abs peratomtypepair 1 1000.0" in liggghts
    assert liggghts.count("absolute_damping on limitForce on") == 2  # between spheres, at the wall
    assert "'eta_n': 1000.0" in PROJECT.load_adapter("yade").native(ask, "default")
    plain = PROJECT.load_adapter("liggghts").native(asked(0.0, 1e-5), "default")
    assert "limitForce" not in plain

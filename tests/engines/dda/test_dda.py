"""Claims about the step of DDA, its ledger, and its adapter."""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from adapters.dda import ADAPTER, FORMULATIONS, SCHEMES
from tests.scenes.blocks.dda_scenes import (
    DOWN,
    FLOOR,
    G,
    asked,
    box,
    general,
    moved,
    rates,
    run,
    shaken,
    slope,
)
from vv.ask import Ask, History, Knobs, Run, Status
from vv.engines.dda import DEFAULT, LAGGED, PUBLISHED, Formulation, solve
from vv.engines.dda.solve import LEAPT
from vv.scene import Contact, Scene, Vector


def roots(O: float, way: Formulation) -> Vector:
    """The two roots of the step of a block on its penalty spring, from four of its velocities."""
    dt, kn = 1e-3, 1e9
    body = box((0.5, 0.5, 0.5), 4 * kn * dt**2 / O**2)
    thrown = dataclasses.replace(body, velocity=np.array([0, 0, 1e-3 * G * dt]))
    scene = Scene((FLOOR, thrown), Contact(math.inf), gravity=DOWN)
    v = rates(run(asked(scene, dt, kn, 3 * dt, dt), way))[:, 2]
    trace, det = np.linalg.solve([[v[1], -v[0]], [v[2], -v[1]]], v[2:4])
    return np.asarray(np.roots([1.0, -trace, det]))


@pytest.mark.shows("makes it first order and dissipates energy")
@settings(max_examples=30)
@given(st.floats(0.05, 3.9))
def test_a_bouncing_block_is_damped_by_the_published_spectral_radius(O: float) -> None:
    found = roots(O, DEFAULT)
    assert abs(found[0].imag) > 0
    assert np.abs(found).max() == pytest.approx((1 + O**2 / 2) ** -0.5, rel=1e-6)


@pytest.mark.parametrize("O", [4.1, 10.0, 100.0, 1e4])
def test_stiff_contacts_have_two_real_roots_that_go_back_to_one(O: float) -> None:
    q = O**2 / 2
    closed = np.roots([1.0, -(2 - q) / (1 + q), 1 / (1 + q)])
    found = roots(O, PUBLISHED)
    assert np.abs(found.imag).max() == 0
    assert np.sort(found) == pytest.approx(np.sort(closed), abs=1e-6)
    assert O < 1e4 or np.abs(found).max() == pytest.approx(1.0, abs=1e-6)


@pytest.mark.shows("makes it first order and dissipates energy")
def test_the_step_is_first_order_at_a_fixed_stiffness() -> None:
    """The run ends after the first slip; friction does not change its sign in it."""
    scene, kn, steps = slope(20, 22, A=5.0), 1e7, (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4)
    late, mean = errors(scene, kn, steps, LAGGED), errors(scene, kn, steps, DEFAULT)
    assert np.polyfit(np.log(steps), np.log(late), 1)[0] == pytest.approx(1.0, abs=0.2)
    assert (mean < late / 15).all()


def errors(scene: Scene, kn: float, steps: tuple[float, ...], way: Formulation) -> Vector:
    """The errors of displacements in runs with these steps [s], relative to a fine step."""
    paths = [moved(run(asked(scene, dt, kn, 0.4, 0.02), way)) for dt in (*steps, 1e-5)]
    return np.array([np.abs(path - paths[-1]).max() for path in paths[:-1]])


@pytest.mark.shows(
    "velocities are then off by dt/2 times the change in acceleration, and displacements by up "
    "to w^2 T dt/4 of their largest value",
    "`dda/default` evaluates shaking at the middle of a step",
)
@pytest.mark.parametrize("system", [run, general])
@pytest.mark.parametrize("way", [DEFAULT, LAGGED])
def test_shaking_is_felt_in_the_middle_of_a_step_and_by_replicas_at_its_end(
    system: Callable[[Ask, Formulation], Run], way: Formulation
) -> None:
    """Evaluated a part p into a step, shaking adds (p - 1/2) dt (a(t) - a(0)) to velocities."""
    scene, dt, omega, dip = slope(20, 0, A=5.0), 2e-3, 2 * math.pi, math.radians(20)
    done, along = system(asked(scene, dt, 1e8, 0.4, 0.1), way), 5.0 * math.cos(dip)
    t = done.times
    exact = t * G * math.sin(dip) + along / omega * (1 - np.cos(omega * t))
    due = (way.shaking_at - 0.5) * dt * along * np.sin(omega * t)
    off = rates(done) @ scene.axes[0] - exact
    assert off == pytest.approx(due, abs=along * omega * dt**2 / 6)


@pytest.mark.parametrize("scheme", FORMULATIONS)
@pytest.mark.parametrize("kn", [1e7, 1e9, 1e11])
def test_energy_is_accounted_for_and_never_created(scheme: str, kn: float) -> None:
    done = run(asked(shaken((0.2, 0.1, 0.1), (2, 4, 1), 0.6), 1e-3, kn, 1.0), FORMULATIONS[scheme])
    ledger = done.ledger
    assert ledger is not None
    assert ledger.bound is not None
    assert ledger.unaccounted <= ledger.bound < 1e-6 * ledger.peak
    assert ("energy created [J]" in ledger.audits) == (scheme in ("default", "published"))
    assert all(seen <= allowed for seen, allowed in ledger.audits.values())
    assert ledger.terms["friction dissipation"] > 0
    lost = [ledger.terms.get(name, 0.0) for name in ("numerical dissipation", LEAPT)]
    assert scheme == "generalised-alpha" or sum(lost) > 0


def test_friction_within_mu_n_is_audited_where_it_is_promised() -> None:
    """Friction that lags exceeds it by about a hundredth of the largest force, and is reported."""
    ask = asked(shaken((0.1, 0.1, 0.1), (2, 4, 1), 0.6), 1e-3, 1e9, 1.0)
    law = "Coulomb: friction beyond mu N [N]"
    for system in (run, general):
        sure, late = system(ask, DEFAULT), system(ask, LAGGED)
        assert sure.ledger is not None
        assert late.ledger is not None
        seen, allowed = sure.ledger.audits[law]
        assert seen <= allowed < 1e-3
        assert law not in late.ledger.audits
        for done in (sure.ledger, late.ledger):
            assert set(done.audits) >= {"error of the momentum balance [N]", "penetration [m]"}
            adrift, _ = done.audits["error of the momentum balance [N]"]
            assert (
                adrift > 0.0
            )  # rounding of a thousand steps; zero would mean that nothing is audited
    beyond = re.search(r"([0-9.]+) N beyond mu N", late.model.note if late.model else "")
    assert beyond is not None
    assert float(beyond[1]) > 10.0


def test_every_run_says_how_its_steps_went_and_what_stood_for_rigid_contact() -> None:
    model = run(asked(shaken((0.2, 0, 0), (2, 0, 0), 0.6), 1e-3, 1e9, 0.1), PUBLISHED).model
    assert model is not None
    for words in ("kn 1e+09", "ks 4e+08", "2000 steps of gravity", "iterations", "penetration"):
        assert words in model.note


@pytest.mark.parametrize(
    ("ask", "reason"),
    [
        (Ask(slope(28, 5), History(1, 0.1), (), Knobs(kn=1e8)), "needs a step"),
        (Ask(slope(28, 5), History(1, 0.1), (), Knobs(dt=1e-3)), "these settings give no kn"),
        (asked(slope(28, 5, free=np.array([1, 0, 0], bool)), 1e-3, 1e8, 1.0), "'box' is locked"),
        (asked(slope(28, 5), 2.0, 1e8, 1.0), "leaves no step"),
    ],
)
def test_what_cannot_be_run_honestly_is_refused(ask: Ask, reason: str) -> None:
    for scheme in SCHEMES:
        assert reason in (ADAPTER.refuses(ask, scheme.name) or "")
    assert solve(ask, DEFAULT).status is Status.REFUSED


def test_a_formulation_names_what_is_out_of_range() -> None:
    with pytest.raises(ValueError, match=r"Formulation.dd = 1.5 is out of range"):
        dataclasses.replace(DEFAULT, dd=1.5)


@pytest.mark.parametrize("scheme", FORMULATIONS)
def test_the_adapter_runs_what_it_describes(scheme: str, tmp_path: Path) -> None:
    ask = asked(slope(20, 22, A=5.0), 1e-3, 1e8, 0.2)
    (done,) = ADAPTER.run([ask], scheme, tmp_path, 0.0)
    assert done.status is Status.RAN
    assert done.model is not None
    assert done.model.unknowns == ADAPTER.describe(ask, scheme).unknowns == 3
    assert f"solve_{scheme.replace('-', '_')}(ask)" in ADAPTER.native(ask, scheme)


def test_the_point_mass_route_takes_a_few_microseconds_a_step(tmp_path: Path) -> None:
    ask = asked(shaken((0.1, 0.1, 0.1), (2, 4, 1), 0.6), 1e-3, 1e9, 5.0)
    (done,) = ADAPTER.run([ask], "default", tmp_path, 0.05)
    assert done.cost.solve_cpu / done.steps < 5e-6

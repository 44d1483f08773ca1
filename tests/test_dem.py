"""Claims about the DEM engine on single contacts: accuracy, minimal models, honesty, cost."""

from __future__ import annotations

import dataclasses
import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from adapters.dem import ADAPTER, LEAPFROGS, SCHEMES
from cases.single_contact import CASE
from vv import dem
from vv.adapter import Scheme, unsupported
from vv.ask import Ask, Displacement, History, Knobs, Method, Run, Status, Velocity
from vv.case import Series
from vv.compiled import cache_folder
from vv.dem.solve import Program, solve
from vv.dem.space import space
from vv.scene import Contact, Harmonic, Scene, Spheres, Term, Vector, Wall

ROOT = Path(__file__).parents[1]
HERE = ROOT / "vv" / "dem"
ANSWERS = json.loads(Path(__file__).with_name("answers.json").read_text())
VARIANTS = [variant.name for variant in CASE.variants]
PLAIN = ["T1", "T2", "T3", "T4"]
STEPS = (4e-3, 2e-3, 1e-3, 5e-4, 1e-4, 1e-5)
PUBLISHED = {"T1": 2.228e-5, "T2": 1.325e-2, "T3": 6.751e-5, "T4": 2.070e-2}
ORDERS = {"T1": (2, 0.25), "T2": (1, 0.02), "T3": (2, 0.25), "T4": (1, 0.02)}


def asked(variant: str, dt: float) -> Ask:
    return CASE.declare(variant, CASE.defaults(variant)).study.ask(Knobs(dt=dt))


def series(variant: str) -> Series:
    quantity = CASE.declare(variant, CASE.defaults(variant)).quantities[0]
    assert isinstance(quantity, Series)
    return quantity


def displacement(variant: str, run: Run) -> Vector:
    return series(variant).observe(run)


def error(variant: str, run: Run) -> float:
    """max|e| / max|y| against the closed form."""
    reference = series(variant).reference
    assert reference is not None
    exact = reference(run.times)
    return float(np.abs(displacement(variant, run) - exact).max() / np.abs(exact).max())


def transcribed(test: str, dt: float) -> Vector:
    """Li 2018, Eqs. 4-12, line by line for one coordinate; v^(-1/2) = v_0, |F_s| capped."""
    p = CASE.defaults(test)
    m = 2 * 3**0.5 * p["rho"] * p["r"] ** 2
    eta = p["eta"] if test in ("T2", "T4") else 0.0
    normal = test in ("T1", "T2")
    v = p["v_a"] if normal else p["v_b"]
    wall = CASE.declare(test, p).study.scene.walls
    Fmax = 0.0 if normal else p["mu"] * p["kn"] * (p["r"] + float(wall[0].point[0]))  # Eq. 7
    P = Fs = 0.0
    path = [P]
    for step in range(History(0.4, 1e-3).steps(dt)):
        if normal:
            Fc = p["kn"] * max(-P, 0.0)  # Eq. 4
        else:
            Fs -= p["ks"] * v * dt if step else 0.0  # Eqs. 5, 6
            Fc = Fs = min(max(Fs, -Fmax), Fmax)  # Eq. 8
        a = (Fc - eta * v) / m  # Eqs. 9, 10
        v += a * dt  # Eq. 11
        P += v * dt  # Eq. 12
        path.append(P)
    return np.array(path)


@pytest.mark.parametrize("test", PLAIN)
def test_published_shows_the_errors_and_orders_of_the_paper_s_scheme(test: str) -> None:
    errors = [error(test, dem.solve_published(asked(test, dt))) for dt in STEPS]
    assert errors[STEPS.index(1e-3)] == pytest.approx(PUBLISHED[test], rel=0.01)
    order, within = ORDERS[test]
    assert np.polyfit(np.log(STEPS), np.log(errors), 1)[0] == pytest.approx(order, abs=within)


@pytest.mark.parametrize("test", PLAIN)
@pytest.mark.parametrize("dt", STEPS)
def test_published_is_the_paper_s_equations_line_by_line(test: str, dt: float) -> None:
    ask = asked(test, dt)
    y = displacement(test, dem.solve_published(ask))
    path = transcribed(test, dt)[:: ask.goal.stride(dt)]
    assert np.abs(y - path).max() <= 1e-12 * np.abs(path).max()


@pytest.mark.parametrize("variant", VARIANTS)
def test_default_is_second_order_in_every_variant(variant: str) -> None:
    errors = [error(variant, dem.solve_default(asked(variant, dt))) for dt in STEPS]
    assert errors[STEPS.index(1e-3)] <= 1e-4
    assert errors[STEPS.index(1e-5)] <= 1e-8
    assert np.polyfit(np.log(STEPS), np.log(errors), 1)[0] == pytest.approx(2, abs=0.25)


@pytest.mark.parametrize("dt", STEPS)
@pytest.mark.parametrize("scheme", LEAPFROGS)
@pytest.mark.parametrize("test", PLAIN)
def test_energy_is_accounted_for_within_the_declared_bound(
    test: str, scheme: str, dt: float
) -> None:
    run = solve(asked(test, dt), LEAPFROGS[scheme])
    assert run.ledger is not None
    assert run.ledger.bound is not None
    assert 0 < run.ledger.unaccounted <= run.ledger.bound < 0.1 * run.ledger.peak
    assert (run.ledger.terms["friction dissipation"] > 0) == (test in ("T3", "T4"))
    assert (run.ledger.terms["drag dissipation"] > 0) == (test in ("T2", "T4"))


def test_t3_loses_to_friction_what_the_closed_form_says() -> None:
    ledger = dem.solve_default(asked("T3", 1e-4)).ledger
    p, y1 = CASE.defaults("T3"), 0.0220572826
    lost = 0.5 * 21650635.0946 * p["v_b"] ** 2 - 0.5 * p["ks"] * y1**2
    assert ledger is not None
    assert ledger.terms["friction dissipation"] == pytest.approx(lost, rel=1e-5)


def forced(ask: Ask) -> Ask:
    """T1 with every freedom of particle 2 and every term, made too small to be felt."""
    spheres = ask.scene.spheres
    moves = spheres.free.any(axis=1, keepdims=True) & np.ones(3, bool)
    load = np.full((len(spheres), 3), 1e-100)
    weak = Harmonic(np.full(3, 1e-100), np.ones(3))
    bodies = (
        dataclasses.replace(spheres, free=moves, free_spin=moves, load=load),
        Wall(np.array([0.0, -1e9, 0.0]), np.array([0.0, 1.0, 0.0]), weak),
    )
    contact = Contact(ask.scene.contact.kn, ks=1e9, mu=0.5)
    gravity = np.full(3, 1e-100)
    scene = Scene(bodies, contact, eta=1e-100, gravity=gravity, shaking=weak)
    return dataclasses.replace(ask, scene=scene)


def test_t1_with_all_freedoms_and_terms_is_the_same_to_rounding() -> None:
    ask = asked("T1", 1e-3)
    least, full = dem.prepare(ask, dem.CENTRED), dem.prepare(forced(ask), dem.CENTRED)
    assert (least.model.unknowns, full.model.unknowns) == (1, 6)
    others = {Term.OBLIQUE_LOCK, Term.BLOCK, Term.RIGID_CONTACT, Term.CARRIED}
    others |= {Term.CONTACT_VISCOSITY}
    others |= {Term.BOND, Term.BOND_SHEAR, Term.BREAKAGE}
    assert full.model.terms == ADAPTER.schemes[0].terms - others
    one, six = (displacement("T1", program.run(program.solve())) for program in (least, full))
    assert np.abs(one - six).max() <= 1e-13 * np.abs(one).max()


def test_the_minimal_model_of_t1_is_three_times_cheaper_a_step() -> None:
    ask = asked("T1", 1e-5)
    seconds = {}
    for name, question in (("least", ask), ("full", forced(ask))):
        program = dem.prepare(question, dem.CENTRED)
        program.warm()
        seconds[name] = min(_clocked(program) for _ in range(5))
    assert seconds["full"] > 3 * seconds["least"]


def _clocked(program: Program) -> float:
    began = time.perf_counter()
    program.solve()
    return time.perf_counter() - began


@pytest.mark.parametrize("scheme", LEAPFROGS)
@pytest.mark.parametrize("variant", ["T4", "T4-rotated"])
def test_the_general_model_holds_oblique_locks_to_rounding(variant: str, scheme: str) -> None:
    ask = asked(variant, 1e-3)
    least_model = dem.prepare(ask, LEAPFROGS[scheme])
    general = dataclasses.replace(least_model, system=space(ask.scene))
    y = displacement(variant, solve(ask, LEAPFROGS[scheme]))
    run = general.run(general.solve())
    # the overlap is the difference of lengths 450 times its size
    assert np.abs(displacement(variant, run) - y).max() <= 1e-12 * np.abs(y).max()
    least = solve(ask, LEAPFROGS[scheme]).ledger
    assert run.ledger is not None
    assert least is not None
    for term in ("kinetic", "shear elastic", "friction dissipation", "drag dissipation"):
        assert run.ledger.terms[term] == pytest.approx(least.terms[term], rel=1e-9)
    moved = run.values[Displacement(1)]
    assert np.abs(moved - np.outer(moved @ ask.scene.axes[1], ask.scene.axes[1])).max() < 1e-16


@pytest.mark.parametrize("scheme", SCHEMES, ids=lambda scheme: scheme.name)
def test_unknowns_are_those_of_the_committed_table(scheme: Scheme) -> None:
    name = scheme.name
    for variant in VARIANTS:
        ask = asked(variant, 1e-3)
        program = dem.prepare(ask, LEAPFROGS[name])
        passed = [a for a in program.arguments for u in program.system.unknowns if a is u]
        count = ANSWERS[f"dem/{name}"][f"single-contact:{variant}"]
        assert sum(array.size for array in passed) == count, variant
        assert ADAPTER.describe(ask, name).unknowns == count
        assert unsupported(scheme, ask.scene.terms()) == frozenset()


@pytest.mark.parametrize("scheme", LEAPFROGS)
def test_beyond_the_critical_step_a_collision_diverges(scheme: str) -> None:
    ask = asked("T1", 1e-3)
    limit = dem.critical_step(ask.scene, LEAPFROGS[scheme])
    assert limit == pytest.approx(2 / 15.9384478053, rel=1e-10)
    run = solve(asked("T1", 1.001 * limit), LEAPFROGS[scheme])
    assert run.status is Status.DIVERGED
    assert "step 2, t = 0.25" in run.reason
    assert len(run.times) == 2


def squeezed(eta: float) -> Scene:
    """A ball pressed between two walls, free along x, so that both contacts stay closed."""
    ball = Spheres(
        position=np.zeros((1, 3)),
        velocity=np.array([[1e-6, 0.0, 0.0]]),
        radius=np.array([1.0]),
        mass=np.array([2.0]),
        free=np.array([[True, False, False]]),
    )
    east = Wall(np.array([0.99, 0.0, 0.0]), np.array([-1.0, 0.0, 0.0]))
    west = Wall(np.array([-0.99, 0.0, 0.0]), np.array([1.0, 0.0, 0.0]))
    return Scene((ball, east, west), Contact(1e4, ks=1e3, mu=0.5), eta=eta)


@pytest.mark.parametrize(("scheme", "eta"), [("default", 1e-9), ("published", 20.0)])
def test_the_critical_step_is_where_a_small_motion_starts_to_grow(scheme: str, eta: float) -> None:
    scene, leapfrog = squeezed(eta), LEAPFROGS[scheme]
    limit = dem.critical_step(scene, leapfrog)
    farthest = {}
    for factor in (0.999, 1.01, 1.5):
        dt = factor * limit
        ask = Ask(scene, History(2000 * dt, dt), (Displacement(0),), Knobs(dt))
        run = solve(ask, leapfrog)
        farthest[factor] = float(np.abs(run.values[Displacement(0)]).max())
    assert farthest[0.999] < 1e-6
    assert farthest[1.01] > 1e-3
    assert run.status is Status.DIVERGED


def test_lagged_viscosity_lowers_the_critical_step() -> None:
    scene = asked("T2", 1e-3).scene
    n, k = 6.9282032303, 15.9384478053
    lagged = 2 * ((n**2 + k**2) ** 0.5 - n) / k**2
    assert dem.critical_step(scene, dem.LAGGED) == pytest.approx(lagged, rel=1e-10)
    assert dem.critical_step(scene, dem.CENTRED) == pytest.approx(2 / k, rel=1e-10)


def falling(speed: float) -> Ask:
    ball = Spheres(
        position=np.zeros((1, 3)),
        velocity=np.array([[0.0, 0.0, speed]]),
        radius=np.ones(1),
        mass=np.ones(1),
        free=np.array([[False, False, True]]),
    )
    scene = Scene((ball,), Contact(1e4), gravity=np.array([0.0, 0.0, -10.0]))
    return Ask(scene, History(1.0, 0.1), (Displacement(0), Velocity(0)), Knobs(0.01))


def test_a_start_under_force_is_exact_if_centred_and_half_a_step_late_as_published() -> None:
    ask = falling(3.0)
    for solved, late in ((dem.solve_default, 0.0), (dem.solve_published, 0.5 * 0.01 * 10.0)):
        run = solved(ask)
        height, speed = run.values[Displacement(0)][:, 2], run.values[Velocity(0)][:, 2]
        t = run.times
        np.testing.assert_allclose(height, 3 * t - 5 * t**2 - late * t, atol=1e-13)
        np.testing.assert_allclose(speed, 3 - 10 * t - late, atol=1e-13)
    assert SCHEMES[1].method_for(ask.scene.terms()) is Method.FIRST_ORDER


def test_what_cannot_be_run_honestly_is_refused_with_a_reason() -> None:
    ask = asked("T1", 1e-3)
    spheres = ask.scene.spheres
    turning = dataclasses.replace(spheres, spin=np.full((2, 3), 0.1))
    doubled = dataclasses.replace(spheres, position=np.zeros((2, 3)))
    scenes = {"locked axis": turning, "one centre": doubled}
    for words, bodies in scenes.items():
        scene = dataclasses.replace(ask.scene, bodies=(bodies,))
        run = dem.solve_default(dataclasses.replace(ask, scene=scene))
        assert (run.status, words in run.reason) == (Status.REFUSED, True)
    for words, knobs in {"needs a step": Knobs(), "no step": Knobs(dt=0.5)}.items():
        reason = ADAPTER.refuses(dataclasses.replace(ask, knobs=knobs), "default")
        assert reason is not None
        assert words in reason


def test_the_adapter_answers_in_order_and_clocks_the_steps_alone(tmp_path: Path) -> None:
    asks = [asked("T2", dt) for dt in (1e-3, 1e-4)]
    runs = list(ADAPTER.run(asks, "default", tmp_path, 0.01))
    assert [run.steps for run in runs] == [400, 4000]
    for ask, run in zip(asks, runs, strict=True):
        assert run.status is Status.RAN
        assert run.cost.repeats > 5
        assert 0 < run.cost.solve_cpu < 1e-3
        assert run.model == ADAPTER.describe(ask, "default")


def test_the_native_script_runs_alone(tmp_path: Path) -> None:
    ask = asked("T3-rotated", 1e-3)
    script = tmp_path / "script.py"
    script.write_text(ADAPTER.native(ask, "published"))
    done = subprocess.run(
        [sys.executable, str(script)],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    table = np.loadtxt(done.stdout.splitlines(), skiprows=1)
    run = dem.solve_published(ask)
    assert np.array_equal(table[:, 0], run.times)
    assert np.array_equal(table[:, 1:], run.values[Displacement(1)])


def test_describing_and_refusing_need_no_numba() -> None:
    code = (
        "import sys; from adapters.dem import ADAPTER; from cases.single_contact import CASE;"
        "from vv.ask import Knobs;"
        "ask = CASE.declare('T1', CASE.defaults('T1')).study.ask(Knobs(dt=1e-3));"
        "ADAPTER.found(), ADAPTER.describe(ask, 'default'), ADAPTER.native(ask, 'default');"
        "assert ADAPTER.refuses(ask, 'default') is None; sys.exit('numba' in sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True, timeout=60)


def test_an_edited_kernel_gets_a_cache_of_its_own(tmp_path: Path) -> None:
    copy = tmp_path / "dem"
    shutil.copytree(HERE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    before = cache_folder(copy)
    assert before == cache_folder(HERE)
    law = copy / "friction.py"
    law.write_text(law.read_text() + "\n")
    assert cache_folder(copy) != before


def test_the_cache_goes_where_it_is_told_and_else_where_it_can(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("VV_CACHE", str(tmp_path / "chosen"))
    assert cache_folder(HERE).is_relative_to(tmp_path / "chosen" / "numba")
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("VV_CACHE", str(tmp_path / "file" / "under"))
    assert not cache_folder(HERE).is_relative_to(tmp_path)


@pytest.mark.parametrize("height", [0.0, 0.1])
@pytest.mark.parametrize("free", [[False, True, False], [True, True, True]])
@pytest.mark.parametrize("solve", [dem.solve_default, dem.solve_published])
def test_a_ball_let_go_from_rest_falls(
    solve: Callable[[Ask], Run], free: list[bool], height: float
) -> None:
    ball = Spheres(
        position=np.array([[0.0, 0.1 + height, 0.0]]),
        velocity=np.zeros((1, 3)),
        radius=np.array([0.1]),
        mass=np.array([1.0]),
        free=np.array([free]),
    )
    floor = Wall(np.zeros(3), np.array([0.0, 1.0, 0.0]))
    gravity = np.array([0.0, -9.81, 0.0])
    scene = Scene((floor, ball), Contact(1e5), gravity=gravity)
    seen = (Displacement(1),)
    run = solve(Ask(scene, History(0.05, 1e-3), seen, Knobs(dt=1e-4)))
    assert run.status is Status.RAN
    assert run.values[seen[0]][-1, 1] < 0.0

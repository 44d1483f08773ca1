"""Claims about largest stable steps: theory, bisection and the leapfrogs themselves agree."""

import dataclasses
from math import sqrt
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions.checks.contact import stability as bisected
from reference_solutions.contact import stability as theory
from tests.support.turned_signs import caught, signs, turned
from vv.ask import Ask, Displacement, History, Knobs, Method, Run, Status
from vv.case import Level, Scalar
from vv.engines import dem
from vv.plan.project import find
from vv.records.record import measured
from vv.run.search import answers
from vv.scene import Contact, Scene, Spheres

PROJECT = find()
CASE = PROJECT.load_case("stable-step")
DEM = PROJECT.load_adapter("dem")
K, N = 15.9384478053, 6.9282032303
SLIDING = ("undamped", "viscous")


def test_the_published_scheme_on_t2_has_the_known_limit() -> None:
    assert theory.lagged(K, N) == pytest.approx(0.0822797, rel=1e-6)


@given(st.floats(0.1, 1e4), st.floats(0.0, 3.0))
@settings(max_examples=60)
def test_the_two_routes_agree(w: float, ratio: float) -> None:
    n = ratio * w
    # near a double root the radius is flat to rounding, which limits bisection to its square root
    assert bisected.largest_step(w, n, 1.0) == pytest.approx(theory.lagged(w, n), rel=1e-9)
    assert bisected.largest_step(w, n, 0.5) == pytest.approx(theory.centred(w), rel=1e-9)


def same(route: object) -> bool:
    """Whether a route has the known limits of T2."""
    if hasattr(route, "largest_step"):
        found = [route.largest_step(K, N, lag) for lag in (0.5, 1.0)]
    else:
        found = [route.centred(K), route.lagged(K, N)]  # type: ignore[attr-defined]
    return bool(np.allclose(found, [2 / K, 2 * (sqrt(N**2 + K**2) - N) / K**2], rtol=1e-9))


@pytest.mark.parametrize("sign", signs(theory))
def test_any_wrong_sign_in_the_theory_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(theory, sign)))


@pytest.mark.parametrize("sign", signs(bisected, (), ("1.0 + 1e-12",)))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(bisected, sign)))


def grows(scene: Scene, leapfrog: dem.Leapfrog, dt: float, body: int) -> bool:
    """Whether a small oscillation grows tenfold from the first to the second half, or diverges."""
    ask = Ask(scene, History(3000 * dt, dt), (Displacement(body),), Knobs(dt))
    run = dem.prepare(ask, leapfrog)
    made = run.run(run.solve())
    if made.status is Status.DIVERGED:
        return True
    y = np.abs(made.values[Displacement(body)]).max(axis=1)
    return bool(y[1500:].max() > 10.0 * y[:1500].max())


def largest(scene: Scene, leapfrog: dem.Leapfrog, body: int, guess: float) -> float:
    """The largest stable step by bisection on the growth in the engine."""
    low, high = 0.5 * guess, 1.5 * guess
    for _ in range(14):
        middle = (low + high) / 2
        low, high = (low, middle) if grows(scene, leapfrog, middle, body) else (middle, high)
    return low


@pytest.mark.parametrize(
    ("leapfrog", "eta", "limit"),
    [
        (dem.CENTRED, 0.0, theory.centred(K)),
        (dem.LAGGED, 0.0, theory.centred(K)),
        (dem.CENTRED, 3e8, theory.centred(K)),
        (dem.LAGGED, 3e8, theory.lagged(K, N)),
    ],
)
def test_the_engine_becomes_unstable_where_theory_says(
    leapfrog: dem.Leapfrog, eta: float, limit: float
) -> None:
    drag = {**CASE.defaults("viscous"), "eta": 3e8}
    scene = dataclasses.replace(CASE.declare("viscous", drag).study.scene, eta=eta)
    assert largest(scene, leapfrog, 1, limit) == pytest.approx(limit, rel=2e-3)


@pytest.mark.parametrize("ratio", [1.0, 1e3, 1e6])
def test_it_does_for_two_unequal_masses_too(ratio: float) -> None:
    """Two masses pressed together oscillate at w^2 = K (1/m + 1/M)."""
    load = 1e3 * np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
    spheres = Spheres(
        position=np.array([[0.0, 0.0, 0.0], [2.0 - 1e-3, 0.0, 0.0]]),
        velocity=np.array([[1e-6, 0.0, 0.0], [0.0, 0.0, 0.0]]),
        radius=np.ones(2),
        mass=np.array([1.0, ratio]),
        free=np.array([[True, False, False]] * 2),
        load=load,
    )
    scene = Scene((spheres,), Contact(1e6))
    limit = theory.centred(sqrt(1e6 * (1.0 + 1.0 / ratio)))
    assert dem.critical_step(scene, dem.CENTRED) == pytest.approx(limit, rel=1e-12)
    assert largest(scene, dem.CENTRED, 0, limit) == pytest.approx(limit, rel=2e-3)


BEYOND = 0.126


def test_a_step_beyond_the_limit_is_refused_with_the_number_and_the_rule() -> None:
    undamped, viscous = (CASE.declare(name, CASE.defaults(name)).study for name in SLIDING)
    ask, late = (study.ask(Knobs(BEYOND)).at(BEYOND) for study in (undamped, viscous))
    for scheme in ("default", "published"):
        reason = DEM.refuses(ask, scheme) or ""
        assert "dt = 0.126 s is beyond the largest stable step 0.125483 s = 2/w" in reason
    assert "0.125483 s = 2/w" in (DEM.refuses(late, "default") or "")
    reason = DEM.refuses(late, "published") or ""
    assert "largest stable step 0.0822797 s = 2 (sqrt(n^2 + w^2) - n)/w^2" in reason


@pytest.mark.parametrize(("scheme", "limit"), [("default", 0.125483), ("published", 0.0822797)])
def test_just_within_the_limit_it_is_not(scheme: str, limit: float) -> None:
    study = CASE.declare("viscous", CASE.defaults("viscous")).study
    assert DEM.refuses(study.ask(Knobs(0.9999 * limit)), scheme) is None
    assert DEM.refuses(study.ask(Knobs(1.0001 * limit)), scheme) is not None


def test_divergence_is_seen_within_an_output_interval() -> None:
    study = CASE.declare("undamped", CASE.defaults("undamped")).study
    knobs = Knobs(BEYOND)
    every, ends = [], []
    for interval in (BEYOND, 5 * BEYOND):
        ask = dataclasses.replace(study.ask(knobs).at(BEYOND), goal=History(400 * BEYOND, interval))
        run = dem.solve_default(ask)
        assert run.status is Status.DIVERGED
        every.append(interval / BEYOND)
        ends.append(run.steps)
    assert 0 <= ends[1] - ends[0] < every[1]


def searched(name: str, variant: str, scheme: str, folder: Path) -> tuple[Run, list[Scalar]]:
    """A search in dem, regardless of what dem refuses beforehand, and the quantities measured."""
    case = PROJECT.load_case(name)
    trial = case.declare(variant, case.defaults(variant))
    ask = trial.study.ask(trial.study.rungs[Level.QUICK][0])
    (run,) = answers(DEM, [ask], scheme, folder, 0.0)
    return run, [q for q in trial.quantities if isinstance(q, Scalar)]


def sought(name: str, variant: str, scheme: str, folder: Path) -> dict[str, float]:
    run, numbers = searched(name, variant, scheme, folder)
    return {quantity.name: quantity.observe(run) for quantity in numbers}


@pytest.mark.parametrize(
    ("scheme", "declared", "verdicts"),
    [
        ("default", Method.LEAPFROG, ["pass", "shown only"]),
        ("published", Method.LATE_LEAPFROG, ["shown only", "pass"]),
        ("published", Method.LEAPFROG, ["fail", "shown only"]),
        ("default", Method.LATE_LEAPFROG, ["shown only", "fail"]),
        ("default", Method.SECOND_ORDER, ["shown only", "shown only"]),
        ("default", Method.FIRST_ORDER, ["shown only", "shown only"]),
    ],
)
def test_with_drag_a_scheme_is_judged_by_the_limit_of_the_class_it_declares_and_no_other(
    scheme: str, declared: Method, verdicts: list[str], tmp_path: Path
) -> None:
    run, numbers = searched("stable-step", "viscous", scheme, tmp_path)
    told = [measured(run, quantity, declared, Knobs())[0] for quantity in numbers]
    assert [entry.verdict.value for entry in told] == verdicts


@pytest.mark.parametrize("scheme", ["default", "published"])
def test_a_lattice_has_the_limit_of_its_fastest_mode_above_that_of_the_infinite_one(
    scheme: str, tmp_path: Path
) -> None:
    found = sought("stable-bonds", "lattice-82", scheme, tmp_path)
    assert found["limit"] == pytest.approx(1.0, rel=3e-3)
    assert found["lattice"] == pytest.approx(1.41599e-7 / 1.33548e-7, rel=3e-3)

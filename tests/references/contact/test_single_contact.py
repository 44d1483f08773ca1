"""Claims about the closed forms of T1 to T4: they agree with an independent second route."""

import ast
import inspect
from math import pi, sqrt
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from reference_solutions.checks.contact import single_contact as integrated
from reference_solutions.contact import single_contact as closed

AGREEMENT = 1e-11  # of max |y|
PAPER = {
    "rho": 2500.0,
    "r": 50.0,
    "kn": 5.5e9,
    "ks": 5.5e9,
    "mu": 0.1,
    "eta": 3e8,
    "v_a": -0.1,
    "v_b": 1.0,
}
WALL = ("rho", "r", "kn", "ks", "mu", "eta", "v_b")
NEEDS = {
    "t1": ("rho", "r", "kn", "v_a"),
    "t2": ("rho", "r", "kn", "eta", "v_a"),
    "t3": WALL,
    "t4": WALL,
}
MOVED = [(test, name, by) for test, names in NEEDS.items() for name in names for by in (0.9, 1.1)]
T = np.linspace(0.0, 0.4, 101)


def pick(names: tuple[str, ...], **changes: float) -> dict[str, float]:
    return {name: (PAPER | changes)[name] for name in names}


def disagreement(
    test: str,
    t: NDArray[np.float64],
    changes: dict[str, float],
    routes: tuple[ModuleType, ModuleType] = (closed, integrated),
) -> float:
    """max |y1 - y2| / max |y1| over t; nan where a route has no solution."""
    a, b = (getattr(route, test)(t, **pick(NEEDS[test], **changes)) for route in routes)
    return float(np.max(np.abs(a - b)) / np.max(np.abs(a)))


def is_sign(node: ast.AST) -> bool:
    if isinstance(node, ast.BinOp):
        return isinstance(node.op, ast.Add | ast.Sub)
    return isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub)


def signs(route: ModuleType) -> range:
    return range(sum(is_sign(node) for node in ast.walk(ast.parse(inspect.getsource(route)))))


def copy(route: ModuleType, turned: int | None) -> ModuleType:
    """A copy of the route from its source, in which the sign of that index is reversed."""
    tree = ast.parse(inspect.getsource(route))
    node = None if turned is None else [node for node in ast.walk(tree) if is_sign(node)][turned]
    if isinstance(node, ast.BinOp):
        node.op = ast.Sub() if isinstance(node.op, ast.Add) else ast.Add()
    elif isinstance(node, ast.UnaryOp):
        node.op = ast.UAdd()
    module = ModuleType(route.__name__)
    exec(compile(tree, module.__name__, "exec"), vars(module))
    return module


def agrees(route: ModuleType, turned: int | None) -> bool:
    """Whether all four tests agree with a sign reversed; a route that fails to finish does not."""
    try:
        changed = copy(route, turned)
        routes = (changed, integrated) if route is closed else (closed, changed)
        return all(disagreement(test, T, {}, routes) < AGREEMENT for test in reversed(NEEDS))
    except (RuntimeError, ValueError):
        return False


@pytest.mark.parametrize("test", NEEDS)
def test_the_second_route_passes_modes_in_which_no_time_is_asked_for(test: str) -> None:
    assert disagreement(test, np.array([0.39]), {}) < AGREEMENT


@pytest.mark.parametrize("test", NEEDS)
@pytest.mark.parametrize("end", [0.4, 2.0])
def test_the_two_routes_agree(test: str, end: float) -> None:
    assert disagreement(test, np.linspace(0.0, end, 401), {}) < AGREEMENT


@pytest.mark.parametrize(("test", "name", "by"), MOVED)
def test_they_agree_when_a_parameter_moves(test: str, name: str, by: float) -> None:
    assert disagreement(test, T, {name: by * PAPER[name]}) < AGREEMENT


@given(
    factors=st.lists(st.floats(0.5, 2.0), min_size=8, max_size=8),
    damping=st.one_of(st.floats(0.0, 0.9), st.floats(1e-12, 1e-3)),
    sign=st.sampled_from([-1.0, 1.0]),
)
@settings(max_examples=15)
def test_they_agree_over_the_class(factors: list[float], damping: float, sign: float) -> None:
    p = {name: by * value for by, (name, value) in zip(factors, PAPER.items(), strict=True)}
    m = closed.mass(p["rho"], p["r"])
    p["eta"] = damping * 2.0 * sqrt(m * min(p["kn"], p["ks"]))
    p["v_b"] *= sign
    t = np.linspace(0.0, 7.0 * sqrt(m / p["ks"]), 101)
    for test in NEEDS:
        assert disagreement(test, t, p) < AGREEMENT
    wall = pick(WALL, **p)
    assert integrated.overlap(**wall) == pytest.approx(closed.overlap(**wall), rel=AGREEMENT)


@pytest.mark.parametrize("turned", signs(closed))
def test_any_wrong_sign_in_the_closed_forms_is_caught(turned: int) -> None:
    assert not agrees(closed, turned)


@pytest.mark.parametrize("turned", signs(integrated))
def test_any_wrong_sign_in_the_equations_of_motion_is_caught(turned: int) -> None:
    assert not agrees(integrated, turned)


@pytest.mark.parametrize("route", [closed, integrated])
def test_what_catches_wrong_signs_lets_an_unchanged_copy_pass(route: ModuleType) -> None:
    assert agrees(route, None)
    assert len(signs(route)) > 10


@pytest.mark.parametrize(
    ("test", "y"),
    [
        ("t1", 0.020289218298046),
        ("t2", 0.0014554181493479),
        ("t3", 0.056639371026747),
        ("t4", 0.015211400125271),
    ],
)
def test_displacement_at_the_papers_end_is_the_known_one(test: str, y: float) -> None:
    assert getattr(closed, test)(0.4, **pick(NEEDS[test])) == pytest.approx(y, rel=1e-13)


def test_the_papers_constants_follow() -> None:
    wall = pick(WALL)
    assert closed.mass(2500.0, 50.0) == pytest.approx(21650635.0946, abs=1e-4)
    assert closed.overlap(**wall) == pytest.approx(0.2205728255, abs=1e-10)
    t3, t4 = closed.t3_slip(**wall), closed.t4_slip(**wall)
    assert t3 == pytest.approx((0.0225, 0.1896, 0.0221, 0.9362, 5.6033, 0.0782), abs=5e-5)
    assert t4 == pytest.approx((0.0274, 0.0938, 0.0221, 0.6115, 5.6033, 0.0173), abs=6e-5)
    t1, t2 = (closed.separation(**pick(NEEDS["t2"], eta=eta)) for eta in (0.0, 3e8))
    assert t1 == pytest.approx((0.1971, 0.1), abs=5e-5)
    assert t2 == pytest.approx((0.2189, 0.0220), abs=5e-5)


def test_t3_friction_and_spring_take_up_the_kinetic_energy() -> None:
    wall = pick(WALL)
    slip, normal_force = closed.t3_slip(**wall), PAPER["kn"] * closed.overlap(**wall)
    kinetic = closed.mass(2500.0, 50.0) * PAPER["v_b"] ** 2 / 2.0
    taken = PAPER["ks"] * slip.y1**2 / 2.0 + PAPER["mu"] * normal_force * slip.distance
    assert taken == pytest.approx(kinetic, rel=1e-14)


def test_t3_grazes_without_slipping() -> None:
    wall, h = pick(WALL), 1e-6
    slip = closed.t3_slip(**wall)
    graze = slip.end + pi / sqrt(PAPER["ks"] / closed.mass(2500.0, 50.0))
    assert graze == pytest.approx(0.38672, abs=5e-6)
    before, at, after = closed.t3([graze - h, graze, graze + h], **wall)
    assert at - slip.distance == pytest.approx(-slip.y1, rel=1e-14)
    assert (after - before) / (2.0 * h) == pytest.approx(0.0, abs=1e-9)
    assert before > at < after


@given(st.floats(0.0, 0.9238))
@settings(max_examples=50)
def test_t4_stays_stuck(damping: float) -> None:
    eta = damping * 2.0 * sqrt(PAPER["ks"] * closed.mass(2500.0, 50.0))
    wall = pick(WALL, eta=eta)
    slip = closed.t4_slip(**wall)
    spring = closed.t4(np.linspace(slip.end, slip.end + 5.0, 400), **wall) - slip.distance
    assert np.all(np.abs(spring) <= slip.y1 * (1.0 + 1e-14))


@pytest.mark.parametrize("test", ["t3", "t4"])
@pytest.mark.parametrize("route", [closed, integrated])
def test_the_mirrored_motion_is_the_exact_negative(test: str, route: ModuleType) -> None:
    solve = getattr(route, test)
    assert np.array_equal(solve(T, **pick(WALL, v_b=-1.0)), -solve(T, **pick(WALL)))


@pytest.mark.parametrize("eta", [0.0, 5e-324, 1e-310, 1e-20, 1e-8])
def test_vanishing_viscosity_is_no_viscosity(eta: float) -> None:
    t1, t2 = closed.t1(T, **pick(NEEDS["t1"])), closed.t2(T, **pick(NEEDS["t2"], eta=eta))
    assert t2 == pytest.approx(t1, rel=0.0, abs=1e-16)
    wall = pick(WALL, eta=eta)
    assert closed.t4(T, **wall) == pytest.approx(closed.t3(T, **wall), rel=0.0, abs=1e-16)


@pytest.mark.parametrize("test", NEEDS)
@pytest.mark.parametrize("shape", [(), (0,), (3, 2)])
def test_displacement_has_the_shape_of_the_times(test: str, shape: tuple[int, ...]) -> None:
    assert getattr(closed, test)(np.full(shape, 0.1), **pick(NEEDS[test])).shape == shape


@pytest.mark.parametrize(
    ("test", "changes", "message"),
    [
        ("t1", {"rho": 0.0}, r"rho = 0.0 kg/m3; .*positive"),
        ("t1", {"r": -50.0}, r"r = -50.0 m; .*positive"),
        ("t2", {"kn": np.inf}, r"kn = inf N/m; .*finite"),
        ("t3", {"kn": np.nan}, r"kn = nan N/m; .*finite"),
        ("t4", {"ks": -1.0}, r"ks = -1.0 N/m; .*positive"),
        ("t3", {"mu": -0.1}, r"mu = -0.1 \[-\]; .*positive"),
        ("t4", {"mu": 0.0}, r"mu = 0.0 \[-\]; .*positive"),
        ("t1", {"v_a": 0.1}, r"v_a = 0.1 m/s; .*negative"),
        ("t2", {"v_a": -np.inf}, r"v_a = -inf m/s; .*finite"),
        ("t1", {"v_a": -2000.0}, r"v_a = -2000.0 m/s; .*2 r = 100.0 m"),
        ("t3", {"v_b": 0.0}, r"v_b = 0.0 m/s; .*not 0"),
        ("t4", {"v_b": np.nan}, r"v_b = nan m/s; .*finite"),
        ("t4", {"v_b": 300.0}, r"dx = 66.17\d* m; .*r = 50.0 m"),
        ("t2", {"eta": -1.0}, r"eta = -1.0 N s/m; .*at least 0"),
        ("t2", {"eta": 6.91e8}, r"eta = 691000000.0 N s/m; .*below 690155035"),
        ("t3", {"eta": np.nan}, r"eta = nan N s/m; .*at least 0"),
        ("t3", {"eta": 6.91e8}, r"eta = 691000000.0 N s/m; .*below 637620111"),
        ("t4", {"eta": 6.38e8}, r"eta = 638000000.0 N s/m; .*below 637620111"),
    ],
)
def test_parameters_beyond_the_formulas_are_refused(
    test: str, changes: dict[str, float], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        getattr(closed, test)(T, **pick(NEEDS[test], **changes))


@pytest.mark.parametrize("test", NEEDS)
def test_times_before_the_start_are_refused(test: str) -> None:
    with pytest.raises(ValueError, match=r"t\[1, 0\] = -0.1 s; .*at least 0"):
        getattr(closed, test)([[0.0], [-0.1]], **pick(NEEDS[test]))
    with pytest.raises(ValueError, match=r"t = inf s; .*finite"):
        getattr(closed, test)(np.inf, **pick(NEEDS[test]))

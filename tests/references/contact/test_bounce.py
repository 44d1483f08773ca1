"""Claims about bouncing spheres: two routes agree, also with known limits."""

import functools
from math import pi
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from reference_solutions.checks.contact import bounce as integrated
from reference_solutions.contact import bounce, bouncing_pair
from tests.support.turned_signs import caught, signs, turned

Array = NDArray[np.float64]
Parameters = dict[str, float]

AGREEMENT = 1e-11  # of the largest displacement
TOUCHING = np.concatenate([t + np.linspace(-1e-5, 1e-4, 23) for t in (0.00451, 0.01361)])
T = np.sort(np.concatenate([np.linspace(0.0, 0.036, 181), TOUCHING]))
SHORT = T[T <= 0.016]  # two bounces
FLOOR: Parameters = {
    "rho": 2500.0, "r": 0.1, "kn": 2e10, "ks": 3e10, "mu": 0.5, "g": 9.81, "gap": 1e-4,
    "v_n": 0.0, "v_t": 0.02, "w": 0.5,
}  # fmt: skip
ROLLS = {"ks": 1.6e10, "mu": 0.3, "v_t": 0.005, "w": 0.15}  # sticks from the start of a contact
BACK = {"ks": 1.6e10, "mu": 0.2, "v_t": 0.04, "w": -1.0}
THROWN = {"v_n": 0.02, "gap": 2e-4, "v_t": -0.03}
THROWS: list[Parameters] = [{}, ROLLS, BACK, THROWN]
PAIR: Parameters = {
    "rho": 2500.0, "r1": 0.1, "r2": 0.07, "kn": 5e6, "ks": 4e6, "mu": 0.3, "gap": 1e-4,
    "v_n": 0.04, "v_t": 0.03, "w1": 0.2, "w2": -0.4, "load": 26.0,
}  # fmt: skip
PAIRS: list[Parameters] = [{}, {"load": 0.0}, {"ks": 7.5e6, "mu": 0.5}, {"v_t": -0.05, "w1": -0.3}]
# signs that only affect the range of a search or its limit
EFFORT = ("-1", "end - flight.begin", "1.0 + 1e-12")


def apart(a: Array, b: Array) -> float:
    """The largest difference over the largest value; nan where a route has no solution."""
    return float(np.max(np.abs(a - b)) / np.max(np.abs(b)))


def floor(route: ModuleType, t: Array, **changes: float) -> Array:
    moved: Array = route.floor(t, **(FLOOR | changes))
    return moved


def pair(route: ModuleType, t: Array, **changes: float) -> Array:
    moved: Array = route.pair(t, **(PAIR | changes))
    return moved


@pytest.mark.parametrize("changes", THROWS)
def test_the_two_routes_agree_on_the_floor(changes: Parameters) -> None:
    assert apart(floor(bounce, T, **changes), floor(integrated, T, **changes)) < AGREEMENT


@pytest.mark.parametrize("changes", PAIRS)
def test_the_two_routes_agree_on_the_pair(changes: Parameters) -> None:
    assert apart(pair(bouncing_pair, T, **changes), pair(integrated, T, **changes)) < AGREEMENT


@given(st.floats(-0.08, 0.08), st.floats(-1.0, 1.0), st.floats(0.1, 0.8))
@settings(max_examples=15)
def test_they_agree_over_the_class(v_t: float, w: float, mu: float) -> None:
    p = {"v_t": v_t, "w": w, "mu": mu, "ks": 1.6e10}
    t = SHORT[::10]
    first, second = floor(bounce, t, **p), floor(integrated, t, **p)
    assert np.max(np.abs(first - second)) < 1e-10 * np.max(np.abs(first))


def contacts(**changes: float) -> list[str]:
    """The phases of each contact with the floor: s for stick, S for slip."""
    stages = bounce.floor_stages(0.036, **(FLOOR | changes))
    words = {"flight": " ", "stick": "s", "slip": "S"}
    return "".join(words[stage.name] for stage in stages).split()


def test_it_bounces_four_times_with_stick_and_slip() -> None:
    assert contacts() == ["SsSsS", "SsS", "SsS", "SsS"]
    assert contacts(**ROLLS) == ["sS", "sS", "sS", "sS"]


def test_the_pair_meets_three_times_under_load_and_once_without() -> None:
    def flights(load: float) -> int:
        stages = bouncing_pair.pair_stages(0.036, **(PAIR | {"load": load}))
        return [stage.name for stage in stages].count("flight")

    assert flights(26.0) == 4
    assert flights(0.0) == 2


def test_a_sphere_that_rolls_on_as_it_lands_bounces_as_without_friction() -> None:
    moved = floor(bounce, T, v_t=0.05, w=0.5)
    assert moved[:, 0] == pytest.approx(0.05 * T, rel=1e-13)


def test_two_that_meet_head_on_exchange_momentum() -> None:
    two = pair(bouncing_pair, T, load=0.0, v_t=0.0, w1=0.0, w2=0.0)
    m1, m2 = 0.1**3, 0.07**3
    late = (two[-1] - two[-2]) / (T[-1] - T[-2])
    assert late[0] == pytest.approx(-2.0 * m2 / (m1 + m2) * PAIR["v_n"], rel=1e-12)
    assert late[2] == pytest.approx((m1 - m2) / (m1 + m2) * PAIR["v_n"], rel=1e-12)


def test_a_sphere_that_slips_throughout_loses_mu_times_the_impulse() -> None:
    v_t = 5.0
    stages = bounce.floor_stages(0.006, **(FLOOR | {"v_t": v_t}))
    impulse = 2.0 * np.sqrt(2.0 * FLOOR["g"] * FLOOR["gap"])
    weight = FLOOR["g"] * (stages[-1].begin - stages[1].begin)
    assert [stage.name for stage in stages] == ["flight", "slip", "flight"]
    assert stages[-1].v == pytest.approx(v_t - FLOOR["mu"] * (impulse + weight), rel=1e-12)


def test_friction_keeps_the_angular_momentum_about_the_point_of_contact() -> None:
    r, (first, *_, last) = FLOOR["r"], bounce.floor_stages(0.036, **FLOOR)
    spin = (last.v - last.s) / r
    assert last.v + 0.4 * r * spin == pytest.approx(first.v + 0.4 * r * FLOOR["w"], rel=1e-13)


def test_a_heavy_second_sphere_is_a_floor_to_the_first_few() -> None:
    """A growing second sphere tends to a floor; the lever arms differ by U/2r = 1e-5."""
    big = {"r1": 1e4, "r2": 0.1, "w1": 0.0, "w2": 0.5, "kn": 2e10, "ks": 3e10, "mu": 0.5}
    m = 2500.0 * 4.0 / 3.0 * pi * 0.1**3
    two = pair(bouncing_pair, SHORT, **big, v_n=0.0, v_t=0.02, load=9.81 * m)
    one = floor(bounce, SHORT)
    assert two[:, 2] == pytest.approx(one[:, 1], abs=1e-8)
    assert two[:, 3] == pytest.approx(one[:, 0], abs=1e-8)


@functools.cache
def known() -> tuple[list[Array], list[Array]]:
    """The displacements by the closed forms, which wrong signs must change."""
    return [floor(bounce, SHORT, **p) for p in THROWS], [
        pair(bouncing_pair, SHORT, **p) for p in PAIRS
    ]


def same_floor(route: ModuleType) -> bool:
    """Whether a route has the known displacements on the floor."""
    pairs = zip(THROWS, known()[0], strict=True)
    return all(apart(floor(route, SHORT, **p), moved) < AGREEMENT for p, moved in pairs)


def same_pair(route: ModuleType) -> bool:
    """Whether a route has the known displacements of the pair."""
    pairs = zip(PAIRS, known()[1], strict=True)
    return all(apart(pair(route, SHORT, **p), moved) < AGREEMENT for p, moved in pairs)


@pytest.mark.parametrize("sign", signs(bounce, (), EFFORT))
def test_any_wrong_sign_on_the_floor_is_caught(sign: int) -> None:
    assert caught(lambda: same_floor(turned(bounce, sign)))


@pytest.mark.parametrize("sign", signs(bouncing_pair, (), EFFORT))
def test_any_wrong_sign_in_the_pair_is_caught(sign: int) -> None:
    assert caught(lambda: same_pair(turned(bouncing_pair, sign)))


@pytest.mark.parametrize("sign", signs(integrated, (), EFFORT))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    route = turned(integrated, sign)
    assert caught(lambda: same_floor(route) and same_pair(route))


@pytest.mark.parametrize("route", [bounce, integrated])
def test_what_catches_wrong_signs_lets_an_unchanged_copy_of_the_floor_pass(
    route: ModuleType,
) -> None:
    assert same_floor(turned(route, None))


@pytest.mark.parametrize("route", [bouncing_pair, integrated])
def test_what_catches_wrong_signs_lets_an_unchanged_copy_of_the_pair_pass(
    route: ModuleType,
) -> None:
    assert same_pair(turned(route, None))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"rho": 0.0}, r"rho = 0.0 .*positive"),
        ({"kn": -1.0}, r"kn = -1.0 .*positive"),
        ({"gap": 0.0}, r"gap = 0.0 .*positive"),
        ({"mu": 0.0}, r"mu = 0.0\b.*positive"),
        ({"v_t": np.inf}, r"v_t = inf .*finite"),
    ],
)
def test_parameters_beyond_the_solution_are_refused(changes: Parameters, message: str) -> None:
    for solve, route in ((floor, bounce), (pair, bouncing_pair)):
        with pytest.raises(ValueError, match=message):
            solve(route, T, **changes)


@pytest.mark.parametrize("shape", [(), (0,), (3, 2)])
def test_displacement_has_the_shape_of_the_times(shape: tuple[int, ...]) -> None:
    t = np.full(shape, 0.003)
    assert floor(bounce, t).shape == (*shape, 2)
    assert pair(bouncing_pair, t).shape == (*shape, 4)

"""Claims about a block on a shaking foundation: two routes agree, also with published values."""

import functools
from math import pi
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from reference_solutions.blocks import responding_block as closed
from reference_solutions.checks.blocks import responding_block as integrated
from tests.support.turned_signs import caught, signs, turned

Array = NDArray[np.float64]
Parameters = dict[str, float]

G = 9.81
AGREEMENT, TURNING = 1e-12, 1e-8  # of max |d2|, in one direction and in more
ONE: Parameters = {"D": 0.5, "f": 1.0, "mu": 0.6, "g": G}
KNOWN = [  # d2(5 s)
    ({"D": 0.2, "f": 2.0}, 0.4371496536),
    ({"D": 0.2, "f": 3.0}, 0.4790353311),
    ({"D": 0.2, "f": 5.0}, 0.4671690830),
    ({"D": 0.3}, 0.2205859410),
    ({"D": 0.5}, 0.8813472810),
    ({"D": 1.0}, 2.1827977173),
    ({"mu": 0.1}, 0.7724770347),
    ({"mu": 1.0}, 0.3676432349),
]
MOVED = [{"D": 0.2}, *(changes for changes, _ in KNOWN)]  # the first rests for a while
TWO: Parameters = {"Dx": 0.3, "fx": 2.0, "Dy": 0.2, "fy": 4.0, "mu": 0.6, "g": G}
THREE: Parameters = {
    "Dx": 0.1,
    "fx": 2.0,
    "Dy": 0.1,
    "fy": 4.0,
    "Dz": 0.1,
    "fz": 1.0,
    "mu": 0.6,
    "g": G,
}
STICKS = THREE | {"Dy": 0.05, "fy": 2.0, "mu": 2.0}  # slips for a part of each second
TURNS = THREE | {"Dy": 0.05, "fy": 1.0, "mu": 1.0}  # sticks, slips and turns
UNLIKE = TURNS | {"fx": 1.7, "fy": 0.9, "fz": 1.3, "mu": 0.8}
WHAT_MOVES = ("base", "one_direction", "_drive", "_steps")  # of the first route
SECOND = ("one_direction", "_carried", "_caught")  # of the second, one direction
DRAGS = ("three_directions", "drags", "acceleration", "Base", "_dragged")  # of the second, more
# signs that only affect lengths of steps, limits of effort, or a direction without lasting effect
EFFORT = (
    "-1",
    "-1.0",
    "now + tau / rate",
    "first + tau / rate",
    "t - periods / f",
    "periods + whole",
    "fastest * np.sin(rate * s) - v - a * (s - now)",
    "fastest * np.sin(rate * s) - v",
    "s - now",
    "end + step",
    "begin + 0.01 / max(base.rate)",
    "hypot(z[2], z[3]) - _STOPPED * fastest",
    "hypot(ax, ay) - self.mu * (self.g + az)",
    "self.g + self.acceleration(s)[2]",
    "-z[3]",
    "-limit",
    "-ax",
    "-ay",
    "self.g + az",
)
T, SHORT = np.linspace(0.0, 2.2, 45), np.linspace(0.0, 0.5, 11)


def apart(a: Array, b: Array) -> float:
    """The largest difference over the largest value; nan where a route has no solution."""
    return float(np.max(np.abs(a - b)) / np.max(np.abs(b)))


def one_direction(route: ModuleType, t: Array, **changes: float) -> Array:
    moved: Array = route.one_direction(t, **(ONE | changes))
    return moved


@pytest.mark.parametrize("changes", MOVED)
def test_the_two_routes_agree(changes: Parameters) -> None:
    t = np.linspace(0.0, 5.0, 1001)
    first, second = (one_direction(route, t, **changes) for route in (closed, integrated))
    assert apart(first, second) < AGREEMENT


@given(st.integers(1, 20), st.integers(1, 16), st.integers(1, 30))
@settings(max_examples=25)
def test_they_agree_over_the_class(tenths: int, quarters: int, twentieths: int) -> None:
    p = {"D": tenths / 10.0, "f": quarters / 4.0, "mu": twentieths / 20.0}
    t = np.linspace(0.0, 6.0 / p["f"], 101)
    assert apart(one_direction(closed, t, **p), one_direction(integrated, t, **p)) < AGREEMENT


@pytest.mark.parametrize(
    ("p", "end"), [(TWO, 1.0), (THREE, 1.0), (STICKS, 2.0), (TURNS, 1.2), (UNLIKE, 1.2)], ids=str
)
def test_the_two_routes_agree_in_more_directions(p: Parameters, end: float) -> None:
    t, solve = np.linspace(0.0, end, 101), "three_directions" if "Dz" in p else "two_directions"
    assert apart(getattr(closed, solve)(t, **p), getattr(integrated, solve)(t, **p)) < TURNING


@pytest.mark.parametrize(("changes", "d2"), KNOWN)
def test_displacement_in_one_direction_is_the_known_one(changes: Parameters, d2: float) -> None:
    assert float(one_direction(closed, np.array(5.0), **changes)) == pytest.approx(d2, abs=6e-11)


def test_displacements_in_two_and_three_directions_are_the_known_ones() -> None:
    two, three = closed.two_directions(5.0, **TWO), closed.three_directions(5.0, **THREE)
    assert two == pytest.approx([0.30725647, -0.09372511], abs=6e-9)
    assert three == pytest.approx([0.22390852, -0.00358173, 0.0], abs=6e-9)


@pytest.mark.parametrize(("f", "constant"), [(5.0, 1.7), (20.0, 6.7)])
def test_at_high_frequency_the_mean_of_a_period_tends_to_its_limit(
    f: float, constant: float
) -> None:
    D, w = 0.2, 2.0 * pi * f
    assert pi * D * w / (2.0 * 0.6 * G) == pytest.approx(constant, abs=0.05)
    end = round(10.0 * constant * f) / f
    t = end - np.arange(64.0) / (64.0 * f)
    mean = float(np.mean(one_direction(closed, t, D=D, f=f)))
    limit = D * pi**2 / 4.0 * (1.0 - 2.371 * (0.6 * G / (D * w**2)) ** 2)
    assert mean == pytest.approx(limit, rel=1.5 * np.exp(-10.0))


def test_the_mean_of_a_period_is_where_the_block_turns() -> None:
    p = ONE | {"D": 0.2, "f": 5.0}
    *_, half, last, _ = closed.one_direction_phases(17.0, **p)
    t = np.linspace(half.begin, 2.0 * last.begin - half.begin, 200, endpoint=False)
    mean = float(np.mean(closed.one_direction(t, **p)))
    assert float(closed.one_direction(half.begin, **p)) == pytest.approx(mean, rel=1e-4)


def test_the_first_slip_is_along_the_acceleration_of_the_base() -> None:
    tiny = 1e-4
    a1 = np.array([0.3, 0.2]) * (2.0 * pi * np.array([2.0, 4.0])) ** 2
    moved = closed.two_directions(tiny, **TWO)
    pulled = 0.6 * G * a1 / np.hypot(*a1) * tiny**2 / 2.0
    assert moved == pytest.approx(pulled, rel=1e-5)


@pytest.mark.parametrize("mu", [1.0, 10.0])
def test_a_block_that_friction_holds_follows_the_base(mu: float) -> None:
    small = {"D": 0.2, "f": 1.0}
    assert apart(one_direction(closed, T, mu=mu, **small), closed.base(T, **small)) < 1e-15
    p = THREE | {"Dx": 0.03, "Dy": 0.005, "Dz": 0.02, "mu": mu}
    known = [closed.base(T, D=p[f"D{axis}"], f=p[f"f{axis}"]) for axis in "xyz"]
    assert np.array_equal(closed.three_directions(T, **p), np.stack(known, axis=-1))
    assert [phase.slips for phase in closed.three_directions_phases(2.2, **p)] == [False]


def test_a_block_without_friction_stays() -> None:
    assert np.max(np.abs(one_direction(closed, T, mu=0.0))) < 1e-14
    assert np.max(np.abs(closed.two_directions(T, **(TWO | {"mu": 0.0})))) < 1e-13


def test_shaking_along_one_axis_is_the_motion_in_one_direction() -> None:
    p = TWO | {"Dx": 0.2, "Dy": 0.0}
    alone: Parameters = {"D": 0.2, "f": 2.0, "mu": 0.6, "g": G}
    moved = closed.two_directions(T, **p)
    assert apart(moved[:, 0], closed.one_direction(T, **alone)) < 1e-13
    assert not moved[:, 1].any()
    found = closed.two_directions_phases(2.2, **p)
    known = closed.one_direction_phases(2.2, **alone)
    assert [i.end for i in found] == pytest.approx([phase.end for phase in known], rel=1e-12)


def test_equal_shaking_of_both_axes_is_the_motion_along_the_diagonal() -> None:
    p = TWO | {"Dx": 0.3, "Dy": 0.3, "fy": 2.0}
    along = one_direction(closed, T, D=0.3 * np.sqrt(2.0), f=2.0)
    moved = closed.two_directions(T, **p)
    assert moved == pytest.approx(np.stack([along, along], axis=1) / np.sqrt(2.0), abs=1e-12)


def test_a_base_at_rest_vertically_leaves_two_directions() -> None:
    still = closed.three_directions(SHORT, **(TWO | {"Dz": 0.0, "fz": 1.0}))
    assert apart(still[:, :2], closed.two_directions(SHORT, **TWO)) < 1e-11
    assert not still[:, 2].any()


def test_the_axes_may_be_swapped() -> None:
    swapped = TWO | {"Dx": 0.2, "fx": 4.0, "Dy": 0.3, "fy": 2.0}
    first, second = closed.two_directions(SHORT, **TWO), closed.two_directions(SHORT, **swapped)
    assert apart(first[:, ::-1], second) < 1e-11


@functools.cache
def known() -> list[Array]:
    """The displacements for MOVED, which wrong signs must change."""
    return [one_direction(closed, T, **changes) for changes in MOVED]


def same(route: ModuleType) -> bool:
    """Whether a route has the known displacements in one direction."""
    pairs = zip(MOVED, known(), strict=True)
    return all(apart(one_direction(route, T, **p), d2) < AGREEMENT for p, d2 in pairs)


def turns(route: ModuleType, agreement: float) -> bool:
    """Whether a route has the known displacements in three directions."""
    pairs = ((p, closed.three_directions(SHORT, **p)) for p in (STICKS, THREE))
    return all(apart(route.three_directions(SHORT, **p), d2) < agreement for p, d2 in pairs)


@pytest.mark.parametrize("sign", signs(closed, WHAT_MOVES))
def test_any_wrong_sign_in_the_drives_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(closed, sign)) and turns(turned(closed, sign), AGREEMENT))


@pytest.mark.parametrize("sign", signs(integrated, SECOND, EFFORT))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(integrated, sign)))


@pytest.mark.parametrize("sign", signs(integrated, DRAGS, EFFORT))
def test_any_wrong_sign_in_the_second_route_of_three_directions_is_caught(sign: int) -> None:
    assert caught(lambda: turns(turned(integrated, sign), TURNING))


@pytest.mark.parametrize("route", [closed, integrated])
def test_what_catches_wrong_signs_lets_an_unchanged_copy_pass(route: ModuleType) -> None:
    assert same(turned(route, None))
    assert turns(turned(route, None), TURNING)


@pytest.mark.parametrize(
    ("name", "changes", "message"),
    [
        ("one_direction", {"D": 0.0}, r"D = 0.0 m; .*positive"),
        ("one_direction", {"D": np.inf}, r"D = inf m; .*finite"),
        ("one_direction", {"f": -1.0}, r"f = -1.0 Hz; .*positive"),
        ("one_direction", {"mu": -0.1}, r"mu = -0.1 \[-\]; .*at least 0"),
        ("one_direction", {"g": 0.0}, r"g = 0.0 m/s2; .*positive"),
        ("two_directions", {"Dx": -0.3}, r"Dx = -0.3 m; .*at least 0"),
        ("two_directions", {"fy": 0.0}, r"fy = 0.0 Hz; .*positive"),
        ("two_directions", {"mu": np.nan}, r"mu = nan \[-\]; .*at least 0"),
        ("three_directions", {"Dy": -0.1}, r"Dy = -0.1 m; .*at least 0"),
        ("three_directions", {"Dz": 0.25}, r"Dz = 0.25 m; Dz \(2 pi fz\)\^2 = 9.8696 .* below g"),
        ("three_directions", {"fz": np.inf}, r"fz = inf Hz; .*finite"),
        ("three_directions", {"g": -9.81}, r"g = -9.81 m/s2; .*positive"),
    ],
)
def test_parameters_beyond_the_solution_are_refused(
    name: str, changes: Parameters, message: str
) -> None:
    p = {"one_direction": ONE, "two_directions": TWO, "three_directions": THREE}[name] | changes
    for solve, t in ((name, T), (f"{name}_phases", 1.0)):
        with pytest.raises(ValueError, match=message):
            getattr(closed, solve)(t, **p)


@pytest.mark.parametrize(
    ("name", "p"), [("one_direction", ONE), ("two_directions", TWO), ("three_directions", THREE)]
)
def test_times_before_the_start_are_refused(name: str, p: Parameters) -> None:
    with pytest.raises(ValueError, match=r"t\[1\] = -0.1 s; .*at least 0"):
        getattr(closed, name)([0.0, -0.1], **p)
    with pytest.raises(ValueError, match=r"t = nan s; .*finite"):
        getattr(closed, f"{name}_phases")(np.nan, **p)


@pytest.mark.parametrize("shape", [(), (0,), (3, 2)])
def test_displacement_has_the_shape_of_the_times(shape: tuple[int, ...]) -> None:
    t = np.full(shape, 0.3)
    assert closed.one_direction(t, **ONE).shape == shape
    assert closed.two_directions(t, **TWO).shape == (*shape, 2)
    assert closed.three_directions(t, **THREE).shape == (*shape, 3)

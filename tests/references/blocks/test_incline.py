"""Claims about the block on an incline: closed forms and collocation agree with a second route."""

import functools
from math import cos, pi, radians, sin, tan
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from reference_solutions.blocks import incline as closed
from reference_solutions.checks.blocks import incline as integrated
from tests.support.turned_signs import caught, signs, turned

Array = NDArray[np.float64]
Parameters = dict[str, float]

G = 9.81
AGREEMENT, TURNING = 1e-12, 1e-8  # of max |d|, in one direction and in two
PAPER: Parameters = {"alpha": 20.0, "phi": 30.0, "A": 5.0, "f": 1.0, "g": G, "v0": 0.0}
BOTH: Parameters = {
    "alpha": 45.0,
    "phi": 50.0,
    "ax": 2.0,
    "fx": 1.0,
    "ay": 1.0,
    "fy": 2.0,
    "g": G,
}
STRONG = BOTH | {"alpha": 20.0, "phi": 30.0, "ax": 20.0, "ay": 20.0, "fy": 0.5}
NEWMARK = {
    "phi 22": {"phi": 22.0},
    "phi 30": {},
    "phi 35": {"phi": 35.0},
    "phi = alpha": {"phi": 20.0},
    "45, 50": {"alpha": 45.0, "phi": 50.0, "A": 2.0},
    "both ways": {"A": 20.0, "phi": 35.0},
    "slides on": {"phi": 10.0},
    "thrown up": {"v0": -1.5, "phi": 10.0},
    "thrown down": {"v0": 1.0, "A": 0.0},
    "up for a moment": {"alpha": 15.0, "phi": 15.0, "A": 28.0, "v0": -0.25},
    "no friction": {"alpha": 0.0, "phi": 0.0},
    "fast": {"A": 26.0, "phi": 5.0, "f": 3.0},
}
SECOND = ("newmark", "_sliding", "_moved", "_slide", "_rest")  # of the second route, one direction
TURNS = ("two_directions", "_turn", "_launched")
# signs that only affect lengths of steps, limits of effort, or a direction without lasting effect
EFFORT = (
    "-1",
    "-1.0",
    "now + 0.125 / f",
    "z[2] - stopped",
    "pull - limit",
    "begin + span",
    "begin + span * pull / (2.0 * pull - float(limit))",
    "2.0 * pull - float(limit)",
)
WHAT_DRIVES = ("_drive", "_forwards", "_backwards", "_steps")  # of the first route
T, SHORT = np.linspace(0.0, 2.2, 45), np.linspace(0.0, 0.2, 9)


def apart(a: Array, b: Array) -> float:
    """The largest difference over the largest value; nan where a route has no solution."""
    return float(np.max(np.abs(a - b)) / np.max(np.abs(b)))


def newmark(route: ModuleType, t: Array, **changes: float) -> Array:
    moved: Array = route.newmark(t, **(PAPER | changes))
    return moved


@pytest.mark.parametrize("changes", NEWMARK.values(), ids=NEWMARK)
def test_the_two_routes_agree(changes: Parameters) -> None:
    t = np.linspace(0.0, 6.0, 401)
    assert apart(newmark(closed, t, **changes), newmark(integrated, t, **changes)) < AGREEMENT


@given(
    alpha=st.integers(0, 60),
    phi=st.integers(0, 80),
    A=st.integers(0, 30),
    quarters=st.integers(1, 20),
    launch=st.integers(-4, 4),
)
@settings(max_examples=25)
def test_they_agree_over_the_class(
    alpha: int, phi: int, A: int, quarters: int, launch: int
) -> None:
    assume(A * tan(radians(alpha)) < G)
    p = {"alpha": alpha, "phi": phi, "A": A, "f": quarters / 4.0, "v0": launch / 4.0}
    t = np.linspace(0.0, 4.0 / p["f"], 101)
    first, second = newmark(closed, t, **p), newmark(integrated, t, **p)
    creep = 1e-15 * G * t[-1] ** 2  # of the second route at phi = alpha, where its forces cancel
    assert np.max(np.abs(first - second)) <= AGREEMENT * np.max(np.abs(first)) + creep


@pytest.mark.parametrize(
    ("p", "end"),
    [
        (BOTH, 2.0),
        (STRONG, 4.0),
        (BOTH | {"phi": 45.0}, 2.0),
        (BOTH | {"fx": 1.3, "fy": 0.7}, 1.62),  # shortly after a slip has begun
    ],
    ids=["", "strong", "=", "late"],
)
def test_the_two_routes_agree_in_two_directions(p: Parameters, end: float) -> None:
    t = np.linspace(0.0, end, 201)
    assert apart(closed.two_directions(t, **p), integrated.two_directions(t, **p)) < TURNING


@pytest.mark.parametrize(
    ("changes", "d"),
    [
        ({"phi": 22.0}, 0.7080274127),
        ({"phi": 30.0}, 0.3270772510),
        ({"phi": 35.0}, 0.1688662375),
        ({"alpha": 45.0, "phi": 50.0, "A": 2.0}, 0.1322764445),
    ],
)
def test_displacement_of_a_cycle_is_the_known_one(changes: Parameters, d: float) -> None:
    t = np.array([1.0, 2.0, 6.0])
    assert newmark(closed, t, **changes) == pytest.approx(d * t, abs=4e-10)


def test_displacement_in_two_directions_is_the_known_one() -> None:
    end = closed.two_directions(6.0, **BOTH)
    assert end == pytest.approx([0.8230692263, -0.0316498886], abs=6e-11)


@pytest.mark.parametrize("f", [2.0**-16, 2.0**16])
def test_it_touches_zero_once_a_period_however_fast_the_drive_is(f: float) -> None:
    """With a little less friction it never stops."""
    p = PAPER | {"phi": 20.0, "f": f}
    phases = closed.newmark_phases(5.5 / f, **p)
    assert [phase.direction for phase in phases] == [1] * 6
    assert [phase.begin * f for phase in phases] == pytest.approx(range(6), abs=1e-15)
    assert len(closed.newmark_phases(5.5 / f, **(p | {"phi": 19.999}))) == 1


def test_at_phi_equal_to_alpha_the_velocity_touches_zero_once_a_period() -> None:
    A, w, c = PAPER["A"], 2.0 * pi, cos(radians(20.0))
    t = np.linspace(0.0, 5.5, 200)
    known = A / (w * c) * (t - np.sin(w * t) / w)
    assert apart(newmark(closed, t, phi=20.0), known) < 2e-15
    phases = closed.newmark_phases(5.5, **(PAPER | {"phi": 20.0}))
    assert [phase.direction for phase in phases] == [1] * 6
    assert [phase.begin for phase in phases] == pytest.approx(range(6), abs=1e-15)


def test_it_yields_at_the_papers_acceleration() -> None:
    rest, slip, *_ = closed.newmark_phases(1.0, **PAPER)
    assert (rest.direction, slip.direction) == (0, 1)
    yields = np.arcsin(G * tan(radians(10.0)) / 5.0) / (2.0 * pi)
    assert slip.begin == pytest.approx(yields, rel=1e-14)
    p = PAPER | {"A": 20.0, "phi": 35.0}
    up = next(phase for phase in closed.newmark_phases(2.0, **p) if phase.direction == -1)
    assert 20.0 * sin(2.0 * pi * up.begin) <= -G * tan(radians(55.0)) * (1.0 - 1e-14)
    p["A"] = G * tan(radians(55.0)) * 0.999
    assert all(phase.direction >= 0 for phase in closed.newmark_phases(2.0, **p))


def test_it_never_slides_up_where_alpha_and_phi_make_a_right_angle() -> None:
    p = PAPER | {"alpha": 35.0, "phi": 55.0, "A": 14.0}
    assert {phase.direction for phase in closed.newmark_phases(4.0, **p)} == {0, 1}


@pytest.mark.parametrize("phi", [10.0, 20.0, 30.0])
@pytest.mark.parametrize("v0", [-1.0, 0.0, 0.01, 1.0])
def test_no_acceleration_is_gravity_alone(phi: float, v0: float) -> None:
    p = {"alpha": 20.0, "phi": phi, "g": G, "v0": v0}
    alone, driven = closed.gravity(T, **p), closed.newmark(T, A=0.0, f=1.0, **p)
    assert driven == pytest.approx(alone, rel=1e-14, abs=1e-15)


def test_gravity_alone_is_the_papers_parabola() -> None:
    a = G * (sin(radians(28.0)) - cos(radians(28.0)) * tan(radians(5.0)))
    from_rest = closed.gravity(T, alpha=28.0, phi=5.0, g=G, v0=0.0)
    assert from_rest == pytest.approx(a * T**2 / 2.0, rel=1e-14)
    a = G * sin(radians(45.0)) * (1.0 - tan(radians(20.0)))
    launched = closed.gravity(T, alpha=45.0, phi=20.0, g=G, v0=0.1)
    assert launched == pytest.approx(0.1 * T + a * T**2 / 2.0, rel=1e-14)
    slowed = closed.gravity(100.0, alpha=10.0, phi=20.0, g=G, v0=1.0)
    loss = G * (cos(radians(10.0)) * tan(radians(20.0)) - sin(radians(10.0)))
    assert float(slowed) == pytest.approx(0.5 / loss, rel=1e-14)


@pytest.mark.parametrize("p", [BOTH, STRONG, BOTH | {"phi": 20.0}])
def test_without_motion_along_the_strike_one_direction_is_left(p: Parameters) -> None:
    p = p | {"ay": 0.0}
    alone = {"alpha": p["alpha"], "phi": p["phi"], "A": p["ax"], "f": p["fx"], "g": G, "v0": 0.0}
    moved, line = closed.two_directions(T, **p), closed.newmark(T, **alone)
    assert np.max(np.abs(moved[:, 0] - line)) < 1e-13 * np.max(np.abs(line))
    assert not moved[:, 1].any()
    found = closed.two_directions_phases(2.2, **p)
    known = closed.newmark_phases(2.2, **alone)
    assert [phase.slips for phase in found] == [phase.direction != 0 for phase in known]
    assert [i.end for i in found] == pytest.approx([phase.end for phase in known], rel=1e-12)


@pytest.mark.parametrize("excess", [1e-6, 1e-4, 1e-2])
def test_a_drive_that_hardly_yields_moves_it_as_little_in_both_solutions(excess: float) -> None:
    a = G * tan(radians(20.0)) * (1.0 + excess)
    line = closed.newmark(T, alpha=0.0, phi=20.0, A=a, f=1.0, g=G, v0=0.0)
    p = BOTH | {"alpha": 0.0, "phi": 20.0, "ax": a, "ay": 0.0}
    assert 0.0 < np.max(line) < excess**2
    assert apart(closed.two_directions(T, **p)[:, 0], line) < 1e-15 / excess


def test_at_phi_equal_to_alpha_any_push_along_the_strike_lets_it_creep_down() -> None:
    p = BOTH | {"phi": 45.0, "ax": 0.0, "ay": 3.0}
    rest, slip = closed.two_directions_phases(2.2, **p)
    assert (rest.slips, slip.slips) == (False, True)
    assert rest.end < 1e-6
    assert np.all(np.diff(closed.two_directions(T, **p)[:, 0]) > 0.0)


@pytest.mark.parametrize("alpha", [0.0, 20.0])
def test_friction_that_holds_everything_lets_nothing_move(alpha: float) -> None:
    p = PAPER | {"alpha": alpha, "phi": 89.9}
    assert not closed.newmark(T, **p).any()
    assert not closed.two_directions(T, **(BOTH | {"alpha": alpha, "phi": 89.9})).any()
    resting = (*closed.newmark_phases(2.2, **p)[0][:3],)
    assert resting == (0.0, 2.2, 0)


@functools.cache
def known() -> list[Array]:
    """The displacements for NEWMARK, on which both routes agree; wrong signs must change them."""
    return [newmark(closed, T, **changes) for changes in NEWMARK.values()]


@pytest.mark.parametrize("sign", signs(closed, WHAT_DRIVES))
def test_any_wrong_sign_in_the_drives_is_caught(sign: int) -> None:
    def agrees() -> bool:
        route = turned(closed, sign)
        turning = route.two_directions(T, **BOTH), closed.two_directions(T, **BOTH)
        return same(route) and apart(*turning) < AGREEMENT

    assert caught(agrees)


@pytest.mark.parametrize("sign", signs(integrated, SECOND, EFFORT))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(integrated, sign)))


@pytest.mark.parametrize("sign", signs(integrated, TURNS, EFFORT))
def test_any_wrong_sign_in_the_second_route_of_two_directions_is_caught(sign: int) -> None:
    known_turning = closed.two_directions(SHORT, **STRONG)

    def agrees() -> bool:
        moved = turned(integrated, sign).two_directions(SHORT, **STRONG)
        return apart(moved, known_turning) < TURNING

    assert caught(agrees)


def same(route: ModuleType) -> bool:
    """Whether a route has the known displacements in one direction."""
    pairs = zip(NEWMARK.values(), known(), strict=True)
    return all(apart(newmark(route, T, **changes), d) < AGREEMENT for changes, d in pairs)


@pytest.mark.parametrize("route", [closed, integrated])
def test_what_catches_wrong_signs_lets_an_unchanged_copy_pass(route: ModuleType) -> None:
    assert same(turned(route, None))
    moved = turned(route, None).two_directions(SHORT, **STRONG)
    assert apart(moved, closed.two_directions(SHORT, **STRONG)) < TURNING


@pytest.mark.parametrize(
    ("name", "changes", "message"),
    [
        ("newmark", {"alpha": 90.0}, r"alpha = 90.0 degrees; .*below 90"),
        ("newmark", {"alpha": -1.0}, r"alpha = -1.0 degrees; .*at least 0"),
        ("newmark", {"phi": 90.0}, r"phi = 90.0 degrees; .*below 90"),
        ("newmark", {"phi": np.nan}, r"phi = nan degrees; .*at least 0"),
        ("newmark", {"A": -5.0}, r"A = -5.0 m/s2; .*at least 0"),
        ("newmark", {"A": 27.0}, r"A = 27.0 m/s2; A tan\(alpha\) must be below g = 9.81"),
        ("newmark", {"f": 0.0}, r"f = 0.0 Hz; .*positive"),
        ("newmark", {"g": 0.0}, r"g = 0.0 m/s2; .*positive"),
        ("newmark", {"v0": np.inf}, r"v0 = inf m/s; .*finite"),
        ("two_directions", {"alpha": 90.0}, r"alpha = 90.0 degrees; .*below 90"),
        ("two_directions", {"phi": -1.0}, r"phi = -1.0 degrees; .*at least 0"),
        ("two_directions", {"ax": -2.0}, r"ax = -2.0 m/s2; .*at least 0"),
        ("two_directions", {"ax": 9.82}, r"ax = 9.82 m/s2; ax tan\(alpha\) must be below g"),
        ("two_directions", {"ay": np.inf}, r"ay = inf m/s2; .*finite"),
        ("two_directions", {"fx": -1.0}, r"fx = -1.0 Hz; .*positive"),
        ("two_directions", {"fy": 0.0}, r"fy = 0.0 Hz; .*positive"),
        ("two_directions", {"g": -9.81}, r"g = -9.81 m/s2; .*positive"),
    ],
)
def test_parameters_beyond_the_solution_are_refused(
    name: str, changes: Parameters, message: str
) -> None:
    p = (BOTH if name == "two_directions" else PAPER) | changes
    for solve, t in ((name, T), (f"{name}_phases", 1.0)):
        with pytest.raises(ValueError, match=message):
            getattr(closed, solve)(t, **p)


@pytest.mark.parametrize(("name", "p"), [("newmark", PAPER), ("two_directions", BOTH)])
def test_times_before_the_start_are_refused(name: str, p: Parameters) -> None:
    with pytest.raises(ValueError, match=r"t\[1\] = -0.1 s; .*at least 0"):
        getattr(closed, name)([0.0, -0.1], **p)
    with pytest.raises(ValueError, match=r"t = inf s; .*finite"):
        getattr(closed, f"{name}_phases")(np.inf, **p)


@pytest.mark.parametrize("shape", [(), (0,), (3, 2)])
def test_displacement_has_the_shape_of_the_times(shape: tuple[int, ...]) -> None:
    t: Any = np.full(shape, 0.3)
    assert closed.gravity(t, alpha=20.0, phi=10.0, g=G, v0=0.0).shape == shape
    assert closed.newmark(t, **PAPER).shape == shape
    assert closed.two_directions(t, **BOTH).shape == (*shape, 2)

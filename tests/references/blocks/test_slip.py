"""Claims about the slip solutions of both references: Coulomb's law, and no wrong sign passes."""

import functools
import itertools
from collections.abc import Iterator
from math import cos, pi, radians, sin, tan
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.polynomial import Chebyshev
from numpy.typing import NDArray

from reference_solutions.blocks import (
    harmonic_slip,
    incline,
    responding_block,
    slip_collocation,
    turning_slip,
)
from reference_solutions.blocks.harmonic_slip import Drive, Law
from tests.support.turned_signs import caught, signs, turned, using

Array = NDArray[np.float64]

G = 9.81
LINE = [
    {"alpha": 20.0, "phi": 30.0, "A": 5.0, "f": 1.0, "g": G, "v0": 0.0},
    {"alpha": 20.0, "phi": 35.0, "A": 20.0, "f": 1.0, "g": G, "v0": 0.5},
    {"alpha": 20.0, "phi": 10.0, "A": 5.0, "f": 1.0, "g": G, "v0": -1.5},
    {"alpha": 20.0, "phi": 20.0, "A": 5.0, "f": 1.0, "g": G, "v0": 0.0},
]
PLANE = [
    {"alpha": 45.0, "phi": 50.0, "ax": 2.0, "fx": 1.0, "ay": 1.0, "fy": 2.0, "g": G},
    {"alpha": 20.0, "phi": 30.0, "ax": 20.0, "fx": 1.0, "ay": 20.0, "fy": 0.5, "g": G},
    {"alpha": 20.0, "phi": 35.0, "ax": 20.0, "fx": 1.0, "ay": 0.0, "fy": 1.0, "g": G},
]
BASE = {"Dx": 0.1, "fx": 2.0, "Dy": 0.05, "fy": 1.0, "Dz": 0.1, "fz": 1.0, "mu": 1.0, "g": G}
# signs that only affect the effort, up to failure, or slip too slow for any displacement
EFFORT = {
    harmonic_slip: (
        "end - now",
        "abs(p) + abs(q)",
        "p + q * sin(angle + x)",
        "(rise - angle - _SNAP) % _TURN + _SNAP",
        "rise - angle - _SNAP",
        "2.0 * rise - pi",
        "x - y / descent",
    ),
    turning_slip: (
        "turns - np.floor(turns)",  # whole turns are none
        "float(signs @ value ** 2) - level",
        "end - t",
        "root - rise",
        "_DECAYED * max(top, hypot(*w_then)) + _NOISE * length * F.max()",
        "moved + 1e-30",
        "NODES - 1",
        "-w",
        "-2",
        "-1",
        "self.begin + self.length",
        "F * speed - along",
        "-1.0",
        "-2.0",
        "16 + int(8.0 * drive.omega.max() * end / (2.0 * pi))",
        "_MOST + int(_MOST * duration * drive.omega.max() / (2.0 * pi))",
    ),
    slip_collocation: (
        "w[:, None] + (T - F * (w / speed)[:, None]) @ A.T",
        "T - F * (w / speed)[:, None]",
        "speed + A @ (pull - F)",
        "pull - F",
        "v - w[:, None] - (T - F * v / speed) @ A.T",
        "v - w[:, None]",
        "T - F * v / speed",
        "v - change",
        "off - n * turned @ A.T",
        "_ONE + A * (n.T @ n) * (F / speed)",
        "-v[1]",
    ),
}


def windows(begin: float, end: float, most: float) -> Iterator[tuple[float, float]]:
    """Parts of an interval, none longer than `most`."""
    edges = np.linspace(begin, end, 1 + int(np.ceil((end - begin) / most)))
    yield from itertools.pairwise(edges.tolist())


@pytest.mark.parametrize("p", LINE)
def test_friction_opposes_every_slip_and_holds_every_rest(p: dict[str, float]) -> None:
    slope, mu = radians(p["alpha"]), tan(radians(p["phi"]))
    for phase in incline.newmark_phases(2.5, **p):
        for begin, end in windows(phase.begin, phase.end, 0.25):
            d = Chebyshev.interpolate(lambda t: incline.newmark(t, **p), 24, domain=[begin, end])
            t = np.linspace(begin, end, 41)
            a = p["A"] * np.sin(2.0 * pi * p["f"] * t)
            friction = G * sin(slope) + a * cos(slope) - d.deriv(2)(t)
            limit, w = mu * (G * cos(slope) - a * sin(slope)), d.deriv()(t)
            assert np.all(phase.direction * w >= -1e-9)
            if phase.direction:
                assert friction == pytest.approx(phase.direction * limit, abs=1e-6)
            else:
                assert np.all(np.abs(friction) <= limit + 1e-6)
                assert w == pytest.approx(0.0, abs=1e-9)
            assert np.all(friction * w >= -2e-8)  # friction dissipates energy and never supplies it


def test_friction_opposes_the_velocity_where_a_slip_turns() -> None:
    p, slope = PLANE[1], radians(PLANE[1]["alpha"])

    def along(axis: int, begin: float, end: float) -> Chebyshev:
        def coordinate(t: Array) -> Array:
            place: Array = incline.two_directions(np.clip(t, 0.0, 1.0), **p)[..., axis]
            return place

        return Chebyshev.interpolate(coordinate, 16, domain=[begin, end])

    slips = [interval for interval in incline.two_directions_phases(1.0, **p) if interval.slips]
    assert slips
    for slip in slips:
        inner = 0.05 * (slip.end - slip.begin)
        for begin, end in windows(slip.begin + inner, slip.end - inner, 0.1):
            t = np.linspace(begin, end, 9)
            x, y = (along(axis, begin, end) for axis in (0, 1))
            a = p["ax"] * np.sin(2.0 * pi * p["fx"] * t)
            T = np.array([G * sin(slope) + a * cos(slope), p["ay"] * np.sin(2 * pi * p["fy"] * t)])
            limit = tan(radians(p["phi"])) * (G * cos(slope) - a * sin(slope))
            w = np.array([x.deriv()(t), y.deriv()(t)])
            friction = T - [x.deriv(2)(t), y.deriv(2)(t)]
            assert friction == pytest.approx(limit * w / np.hypot(*w), abs=1e-4)
            assert np.all(np.sum(friction * w, axis=0) > 0.0)


@given(st.floats(0.0, 2.0 * pi), st.floats(0.2, 1.0), st.floats(0.0, 4.0))
@settings(max_examples=15)
def test_a_slip_may_begin_anywhere_in_the_drive(lag: float, v0: float, p: float) -> None:
    drive = Drive(2.0 * pi, lag, Law(-p, 3.0), Law(p, 3.0))
    history = harmonic_slip.phases(drive, v0, 1.0)
    end = min(history[0].end, 0.25)
    d = Chebyshev.interpolate(
        lambda t: harmonic_slip.displacement(t, drive, history), 16, domain=[0.0, end]
    )
    t = np.linspace(0.0, end, 9)
    assert d.deriv(2)(t) == pytest.approx(3.0 * np.sin(2.0 * pi * t + lag) - p, abs=1e-6)
    assert float(d.deriv()(0.0)) == pytest.approx(v0, abs=1e-9)
    assert [a.end for a in history[:-1]] == [b.begin for b in history[1:]]


def test_intervals_follow_each_other_until_the_end() -> None:
    for p in PLANE:
        found = incline.two_directions_phases(1.3, **p)
        assert found[0].begin == 0.0
        assert found[-1].end == pytest.approx(1.3, rel=1e-14)
        assert [a.end for a in found[:-1]] == [b.begin for b in found[1:]]
        assert all(a.slips or b.slips for a, b in itertools.pairwise(found))


def test_a_slip_has_as_many_steps_as_its_time_holds_periods_of_the_fastest_drive() -> None:
    still = np.zeros((3, 2))
    drive = turning_slip.Drive(np.array([2.0 * pi, 4.0 * pi]), np.zeros(3), still, still)
    most = turning_slip._MOST
    told = [turning_slip._most(drive, t) for t in (0.0, 0.5, 1.5)]
    assert told == pytest.approx([most, 2 * most, 4 * most], abs=1)


@pytest.mark.parametrize(("end", "most"), [(0.0, 16), (1.5, 40), (6.0, 112)])
def test_eight_phases_a_period_and_a_few_more_are_the_most(
    end: float, most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A drive of 2 Hz, of which no phase takes any time."""
    told = f"{most} phases did not reach"
    monkeypatch.setattr(harmonic_slip, "_mode", lambda *_: (0, 0.0, 0.0, 0.0))
    with pytest.raises(RuntimeError, match=told):
        harmonic_slip.phases(Drive(4.0 * pi, 0.0, Law(0.0, 1.0), Law(0.0, 1.0)), 0.0, end + 1e-9)
    still = np.zeros((3, 1))
    drive = turning_slip.Drive(np.array([4.0 * pi]), np.zeros(3), still, still)
    step = turning_slip.Step(0.0, 0.0, True, np.zeros(2), np.zeros(2), np.zeros((2, 16)))
    monkeypatch.setattr(turning_slip, "_rest", lambda *_: 0.0)
    monkeypatch.setattr(turning_slip, "_slip", lambda *_: [step])
    with pytest.raises(RuntimeError, match=f"{most} steps did not reach"):
        turning_slip.history(drive, end + 1e-9)


def line(harmonic: ModuleType) -> Iterator[Array]:
    """The solutions in one direction that use the given module."""
    t = np.linspace(0.0, 2.2, 45)
    slope, base = using(incline, harmonic), using(responding_block, harmonic)
    yield from (slope.newmark(t, **p) for p in LINE)
    yield from (base.one_direction(t, D=D, f=1.0, mu=0.6, g=G) for D in (0.2, 0.5))
    drive = harmonic.Drive(2.0 * pi, 0.7, Law(-2.0, 3.0), Law(2.0, 3.0))
    yield harmonic.displacement(t, drive, harmonic.phases(drive, 1.0, 2.2))


def plane(turning: ModuleType) -> Iterator[Array]:
    """The solutions in two and three directions that use the given module."""
    t = np.linspace(0.0, 0.8, 17)
    slope, base = using(incline, turning), using(responding_block, turning)
    yield base.three_directions(t, **BASE)
    for p in PLANE:
        yield slope.two_directions(t, **p)
        yield np.array(slope.two_directions_phases(0.8, **p))


def collocated(collocation: ModuleType) -> Iterator[Array]:
    yield from plane(using(turning_slip, collocation))


BELOW = {harmonic_slip: line, turning_slip: plane, slip_collocation: collocated}


@functools.cache
def known(module: ModuleType) -> list[Array]:
    """The solutions with the unchanged module."""
    return list(BELOW[module](module))


def same(module: ModuleType, changed: ModuleType) -> bool:
    """Whether the solutions are unchanged; the comparison stops at the first difference."""
    answers = BELOW[module]
    return all(
        a.shape == b.shape and bool(np.max(np.abs(a - b)) < 1e-11 * np.max(np.abs(b)))
        for a, b in zip(answers(changed), known(module), strict=True)
    )


@pytest.mark.parametrize("sign", signs(harmonic_slip, (), EFFORT[harmonic_slip]))
def test_any_wrong_sign_in_the_closed_forms_is_caught(sign: int) -> None:
    assert caught(lambda: same(harmonic_slip, turned(harmonic_slip, sign)))


@pytest.mark.parametrize("sign", signs(turning_slip, (), EFFORT[turning_slip]))
def test_any_wrong_sign_in_the_steps_is_caught(sign: int) -> None:
    assert caught(lambda: same(turning_slip, turned(turning_slip, sign)))


@pytest.mark.parametrize("sign", signs(slip_collocation, (), EFFORT[slip_collocation]))
def test_any_wrong_sign_in_the_collocation_is_caught(sign: int) -> None:
    assert caught(lambda: same(slip_collocation, turned(slip_collocation, sign)))


@pytest.mark.parametrize("module", BELOW)
def test_what_catches_wrong_signs_lets_an_unchanged_copy_pass(module: ModuleType) -> None:
    assert same(module, turned(module, None))

"""Claims about a tumbling body that lands: elliptic functions agree with Euler's equations."""

from __future__ import annotations

import functools
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions.checks.hard import tumbling as stepped
from reference_solutions.hard import tumbling as closed
from tests.support.turned_signs import caught, signs, turned

AXES = np.array([[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]]) / 3
N = np.array([1.0, 2.0, 2.0]) / 3
SIDES = np.array([1.0, 0.6, 0.35])
CORNERS = np.array([[i, j, k] for i in (-0.5, 0.5) for j in (-0.5, 0.5) for k in (-0.5, 0.5)])
BODY = {
    "mass": 12.0,
    "inertia": (SIDES**2).sum() - SIDES**2,
    "corners": CORNERS * SIDES,
    "axes": AXES,
}
SPINS = {  # rotation about the axis of least or greatest inertia, in either direction
    "least": (2.5, 0.8, -0.4),
    "greatest": (0.5, 0.9, 2.5),
    "backwards": (-0.5, 0.9, -2.5),
    "beside the middle": (0.3, 2.5, -0.6),
}
T = np.linspace(0.0, 1.2, 5)


@functools.cache  # used again for every sign
def flown(w: tuple[float, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Spins and rotations by the second route."""
    return stepped.flight(T, BODY["inertia"], AXES, np.array(w))


def flies(one: ModuleType, w: tuple[float, ...]) -> bool:
    """Whether spins and rotations satisfy Euler's equations."""
    spins, rotations = flown(w)
    own = one.spins(T, BODY["inertia"], np.array(w))
    turns = one.turned(T, one.Body(**BODY), np.array(w))
    return bool(np.abs(own - spins).max() < 1e-9 and np.abs(turns - rotations).max() < 1e-9)


@pytest.mark.parametrize("w", SPINS.values(), ids=SPINS)
def test_spin_and_pose_are_those_of_eulers_equations(w: tuple[float, ...]) -> None:
    assert flies(closed, w)


@given(st.tuples(*[st.floats(0.2, 3.0)] * 3), st.permutations(range(3)))
@settings(max_examples=15)
def test_any_spin_about_any_order_of_axes_flies_so(w: tuple[float, ...], order: list[int]) -> None:
    inertia = BODY["inertia"][order]
    if abs(inertia**2 @ np.square(w) / (inertia @ np.square(w)) - np.median(inertia)) > 1e-3:
        due, _ = stepped.flight(T, inertia, AXES, np.array(w))
        assert np.abs(closed.spins(T, inertia, np.array(w)) - due).max() < 1e-8


def lands(one: ModuleType) -> bool:
    """Whether a corner touches at the landing, none before, and the impact satisfies all laws."""
    body, w, V = one.Body(**BODY), np.array(SPINS["beside the middle"]), 0.5
    met = one.landing(body, w, N, height=0.8, V=V, latest=2.0)
    times = np.linspace(0.0, met.t, 50)
    spins, turns = stepped.flight(times, BODY["inertia"], AXES, w)
    gaps = 0.8 - V * times[:, None] + np.einsum("kab,cb,a->kc", turns, body.corners, N)
    R, corner = turns[-1], body.corners[np.argmin(gaps[-1])]
    speed, spin = stepped.after(
        body.mass, R @ np.diag(body.inertia) @ R.T, R @ corner, N, -V * N, R @ spins[-1]
    )
    gained = one.height_gained(np.array([met.t, met.t + 1.0]), met, V)
    approach = V - np.cross(R @ spins[-1], R @ corner) @ N
    return bool(
        abs(gaps[-1].min()) < 1e-9
        and gaps[:-1].min() > 0.0
        and abs(met.approach - approach) < 1e-8
        and np.abs(speed - (met.gain - V) * N).max() < 1e-9
        and np.abs(R.T @ spin - met.w).max() < 1e-8
        and np.abs(met.axes - R.T).max() < 1e-9
        and np.abs(gained - [-V * met.t, -V * met.t + N @ speed]).max() < 1e-9
    )


def test_a_corner_lands_where_it_touches_first_and_stops_there() -> None:
    assert lands(closed)


@pytest.mark.parametrize("sign", signs(closed, without=("-1", "past - 1")))
def test_any_wrong_sign_in_the_formulas_is_caught(sign: int) -> None:
    other = turned(closed, sign)
    assert caught(lambda: all(flies(other, w) for w in SPINS.values()) and lands(other))


def test_what_never_lands_or_lies_below_at_the_start_is_refused() -> None:
    body, w = closed.Body(**BODY), np.array(SPINS["least"])
    with pytest.raises(ValueError, match="no corner meets"):
        closed.landing(body, w, N, height=9.0, V=0.5, latest=1.0)
    with pytest.raises(ValueError, match=r"height = 0\.1 m"):
        closed.landing(body, w, N, height=0.1, V=0.5, latest=1.0)

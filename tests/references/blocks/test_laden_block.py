"""Claims about a loaded block on a shaking slope: two routes agree, and its slip never reverses."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions.blocks import laden_block as closed
from reference_solutions.checks.blocks import laden_block as integrated
from reference_solutions.contact.shaken_spring import Sine
from tests.support.turned_signs import caught, signs, turned
from vv.plan.project import find

CASE = find().load_case("laden-block")
T = np.linspace(0.0, 2.0, 41)
LAW = {"v": 10.0, "mu": 0.4, "constant": (0.7, -11.0)}
SHAKING, LIFTING = ((1.1, 5.0, 0.4), (0.9, 8.0, -1.0)), (0.02, 13.0, 2.1)
SLIDING = (0.02, 7.0, 0.3)


def agree(one: ModuleType, other: ModuleType, **law: float) -> bool:
    """Whether the routes agree on the slip, and the block rises with the wall."""
    told = {"shaking": tuple(Sine(*a) for a in SHAKING), "lifting": Sine(*LIFTING)}
    place, speed = one.motion(T, **{**LAW, **law}, **told)
    due, rate = other.motion(T, **{**LAW, **law}, shaking=SHAKING, lifting=LIFTING, sliding=SLIDING)
    size, omega, phase = LIFTING
    lift = size * np.sin(omega * T + phase)
    apart = [
        (place[:, 0] - due) / np.abs(due).max(),
        (speed[:, 0] - rate) / np.abs(rate).max(),
        (place[:, 1] - lift + lift[0]) / size,
        (speed[:, 1] - size * omega * np.cos(omega * T + phase)) / (size * omega),
    ]
    pressed = {"constant": LAW["constant"], "lifting": LIFTING, "shaking": SHAKING}
    press = one.pressure(T, **{**told, "constant": LAW["constant"]})
    size, omega, phase = SLIDING
    slid = one.wall_speed(T, Sine(*SLIDING)) - size * omega * np.cos(omega * T + phase)
    apart += [press / other.pressure(T, **pressed) - 1, slid]
    return bool(np.abs(apart).max() < 1e-12)


@given(st.floats(0.0, 0.4), st.floats(10.0, 15.0))
@settings(max_examples=10)
def test_the_two_routes_agree(mu: float, v: float) -> None:
    assert agree(closed, integrated, mu=mu, v=v)


@pytest.mark.parametrize("changed", [{"v": 2.0}, {"constant": (0.7, -3.0)}])
def test_the_second_route_ends_where_the_block_stops_or_leaves(changed: dict[str, Any]) -> None:
    law = {**LAW, **changed}
    way, _ = integrated.motion(T, **law, shaking=SHAKING, lifting=LIFTING, sliding=SLIDING)
    assert 0 < len(way) < len(T)


@pytest.mark.parametrize("sign", signs(closed))
def test_any_wrong_sign_in_the_formula_is_caught(sign: int) -> None:
    assert caught(lambda: agree(turned(closed, sign), integrated))


@pytest.mark.parametrize(
    "changed", [{"D": 0.2}, {"v": 1.5}, {"v": 9.0, "press": -8.5}, {"v": 3.0, "a": 20.0}]
)
def test_a_block_that_would_leave_or_stop_is_refused(changed: dict[str, float]) -> None:
    with pytest.raises(ValueError, match="it must stay positive"):
        CASE.declare("level", {**CASE.defaults("level"), **changed})

"""Claims about a laden block on a shaking slope: two routes, and that it keeps slipping one way."""

from __future__ import annotations

from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions import laden_block as closed
from reference_solutions.checks import laden_block as integrated
from tests.turned_signs import caught, signs, turned
from vv.project import find

CASE = find().load_case("laden-block")
T = np.linspace(0.0, 2.0, 41)
LAW = {"v": 4.0, "mu": 0.4, "constant": (0.7, -11.0)}
SHAKING, LIFTING = ((1.1, 5.0, 0.4), (0.9, 8.0, -1.0)), (0.02, 13.0, 2.1)


def agree(one: ModuleType, other: ModuleType, **law: float) -> bool:
    """Whether the routes agree along the slip, and the lift is that of the wall."""
    told = {"shaking": tuple(one.Sine(*a) for a in SHAKING), "lifting": one.Sine(*LIFTING)}
    place, speed = one.motion(T, **{**LAW, **law}, **told)
    due, rate = other.motion(T, **{**LAW, **law}, shaking=SHAKING, lifting=LIFTING)
    size, omega, phase = LIFTING
    lift = size * np.sin(omega * T + phase)
    apart = [
        (place[:, 0] - due) / np.abs(due).max(),
        (speed[:, 0] - rate) / np.abs(rate).max(),
        (place[:, 1] - lift + lift[0]) / size,
        (speed[:, 1] - size * omega * np.cos(omega * T + phase)) / (size * omega),
    ]
    return bool(np.abs(apart).max() < 1e-12)


@given(st.floats(0.0, 1.0), st.floats(0.5, 5.0))
@settings(max_examples=10, deadline=None)
def test_the_two_routes_agree(mu: float, v: float) -> None:
    assert agree(closed, integrated, mu=mu, v=v)


@pytest.mark.parametrize("sign", signs(closed))
def test_any_wrong_sign_in_the_formula_is_caught(sign: int) -> None:
    assert caught(lambda: agree(turned(closed, sign), integrated))


def test_the_block_slips_one_way_and_stays_on_the_slope() -> None:
    p = CASE.defaults("level")
    scene = CASE.declare("level", p).study.scene
    t, (block,), (wall,) = np.linspace(0.0, p["duration"], 2001), scene.blocks, scene.walls
    assert wall.motion is not None
    assert scene.shaking is not None
    slip = wall.motion.axes[0]
    forces = np.tile(scene.gravity + block.load / block.mass, (len(t), 1))
    for along, f, phase in scene.shaking.sines():
        forces += np.outer(np.sin(2 * np.pi * f * t + phase), along)
    speed, lift = np.zeros((len(t), 3)), np.zeros((len(t), 3))
    for along, f, phase in wall.motion.sines():
        w = 2 * np.pi * f
        speed += np.outer(w * np.cos(w * t + phase), along)
        lift -= np.outer(w**2 * np.sin(w * t + phase), along)
    press = (lift - forces) @ wall.normal
    pull = forces @ slip - p["mu"] * press
    moves = block.velocity @ slip + np.cumsum(pull) * t[1]
    assert press.min() > 0
    assert (moves - speed @ slip).min() > 0.1
    assert np.abs(speed[0] - block.velocity) @ wall.normal == pytest.approx(0, abs=1e-12)

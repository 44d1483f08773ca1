"""Claims about blocks that turn, tip and hit in the general model, with results by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.engines.blocks.test_any_blocks import turned
from tests.engines.rigid.by_hand.general_runs import DRIVEN, HIT, KINETIC, RUBBED, Moved
from tests.scenes.blocks.block_scenes import ACROSS, DOWN, FLOOR, IN_PLANE, box
from vv.engines.rigid.limits import HITS
from vv.scene import Contact, Scene, Vector

pytestmark = pytest.mark.usefixtures("in_python")
G = 9.81
PLANAR: dict[str, Any] = {"free": IN_PLANE, "free_spin": ACROSS}


def tilted(angle: float) -> Vector:
    """Axes turned about y, which lower the corner at +x by the angle."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])


def require_second_order(coarse: Vector, fine: Vector, true: Vector) -> None:
    """Of two results, the second at half the step, the error is a quarter: 3.5 to 4.5 times less.

    The next term of the error is of third or fourth order, and the error small.
    """
    off, less = np.linalg.norm(coarse - true), np.linalg.norm(fine - true)
    assert 3.5 <= off / less <= 4.5
    assert off <= 1e-3 * np.linalg.norm(true)


def test_a_body_in_flight_turns_as_euler_says() -> None:
    """About axes of unlike inertia, with its velocity, energy and angular momentum."""
    axes, spin = turned(np.random.default_rng(2)), np.array([4.0, -3.0, 5.0])
    block = box("b", [0, 0, 9.0], [0.1, 0.2, 0.4], axes, spin=spin, velocity=[1.0, 2.0, 3.0])

    def slope(t: float, y: Vector) -> Vector:
        frame, w = y[:9].reshape(3, 3), y[9:]
        now = frame @ block.inertia @ frame.T
        turning = np.cross(w, frame.T).T
        return np.concatenate([turning.ravel(), np.linalg.solve(now, -np.cross(w, now @ w))])

    start = np.concatenate([np.eye(3).ravel(), spin])
    end = solve_ivp(slope, (0.0, 0.1), start, rtol=1e-10, atol=1e-12).y[9:, -1]
    runs = [Moved(Scene((block,), Contact(np.inf)), n, 0.1 / n) for n in (25, 50)]
    require_second_order(runs[0].w[-1, 0], runs[1].w[-1, 0], end)
    assert np.abs(end - spin).max() > 0.5
    for run in runs:
        assert run.v[-1, 0] == pytest.approx([1.0, 2.0, 3.0])
        assert run.energy[-1, KINETIC] == pytest.approx(run.energy[0, KINETIC], rel=1e-3)


@pytest.mark.parametrize("order", [1, -1])
def test_a_tilted_box_tips_over_the_edge_on_which_it_stands(order: int) -> None:
    """It turns about that edge as an inverted pendulum: w' = m g r sin(angle)/I."""
    angle, half = 0.5, np.array([0.1, 0.3, 0.3])
    axes = tilted(order * angle)
    corner = np.array([order * half[0], 0.0, -half[2]]) @ axes
    block = box("b", -corner, half, axes, **PLANAR)
    scene = Scene((FLOOR, block), Contact(np.inf, mu=2.0), gravity=DOWN)
    coarse, fine = (Moved(scene, n, 0.1 / n) for n in (25, 50))
    r = np.hypot(half[0], half[2])
    beyond = angle - np.arctan(half[0] / half[2])  # of the vertical, at the start

    def slope(t: float, y: Vector) -> list[float]:
        return [y[1], 0.75 * G / r * np.sin(y[0])]

    end = solve_ivp(slope, (0.0, 0.1), [beyond, 0.0], rtol=1e-10, atol=1e-12).y[:, -1]
    require_second_order(coarse.w[-1, 0], fine.w[-1, 0], np.array([0.0, order * end[1], 0.0]))
    x, z = (r * (f(end[0]) - f(beyond)) for f in (np.sin, np.cos))
    require_second_order(coarse.x[-1, 0], fine.x[-1, 0], np.array([order * x, 0.0, z]))
    assert fine.energy[-1, DRIVEN] == pytest.approx(-block.mass * G * z, rel=1e-3)
    assert abs(fine.energy[-1, [HIT, RUBBED]]).max() <= 1e-3 * fine.energy[-1, DRIVEN]
    assert end[1] > 0.3


@pytest.mark.parametrize("mu", [0.0, 0.2, 3.0])
@pytest.mark.parametrize("order", [1, -1])
def test_a_corner_that_hits_the_floor_stops_by_the_impulse_that_it_needs(
    order: int, mu: float
) -> None:
    """Without gravity: p = v/k along the normal, and less friction than mu p or what sticks."""
    half, dt = np.array([0.2, 0.3, 0.1]), 1e-3
    axes = tilted(order * 0.4)
    arm = np.array([order * half[0], 0.0, -half[2]]) @ axes
    v = np.array([order * 0.8, 0.0, -2.0])
    block = box("b", [0.0, 0.0, 0.0051 - arm[2]], half, axes, velocity=v, **PLANAR)
    run = Moved(Scene((FLOOR, block), Contact(np.inf, mu=mu)), 6, dt)
    turns = (half[0] ** 2 + half[2] ** 2) / 3.0
    a = np.array([[1 + arm[2] ** 2 / turns, -arm[0] * arm[2] / turns],
                  [-arm[0] * arm[2] / turns, 1 + arm[0] ** 2 / turns]])  # fmt: skip
    speed = np.array([v[0], v[2]])
    push = -np.linalg.solve(a, speed)
    if abs(push[0]) > mu * push[1]:
        side = -np.sign(v[0]) * mu
        push = np.array([side, 1.0]) * -speed[1] / (a[1] @ [side, 1.0])
    due = speed + push
    spin = (arm[2] * push[0] - arm[0] * push[1]) / turns
    assert run.v[-1, 0, [0, 2]] == pytest.approx(due, abs=2e-3)
    assert run.w[-1, 0, 1] == pytest.approx(spin, rel=2e-3)
    lost = 0.5 * block.mass * (speed @ speed - due @ due - turns * spin**2)
    assert run.energy[-1, [HIT, RUBBED]].sum() == pytest.approx(lost, rel=5e-3)
    assert run.cuts.sum() >= 1.0


@pytest.mark.parametrize(("part", "together"), [(0.5, True), (0.98, True), (1.02, False)])
def test_edges_hit_together_that_nearly_touch_when_the_first_does(
    part: float, together: bool
) -> None:
    """A tall block on smooth ground stops if both do; else they hit it one after the other."""
    half, dt, fast = np.array([0.1, 0.2, 0.4]), 1e-3, 2.0
    axes = tilted(part * HITS * dt * fast / (2.0 * half[0]))
    low = half[0] * axes[0, 2] - half[2] * axes[2, 2]
    block = box("b", [0.0, 0.0, 3e-4 - low], half, axes, velocity=[0.0, 0.0, -fast], **PLANAR)
    run = Moved(Scene((FLOOR, block), Contact(np.inf, mu=0.0)), 2, dt)
    turns = (half[0] ** 2 + half[2] ** 2) / 3.0
    arm = half[0] ** 2 / turns
    first = fast / (1.0 + arm)  # m/s, an impulse over the mass
    second = (fast - first + arm * first) / (1.0 + arm)
    due = 0.0 if together else (second - first) * half[0] / turns
    assert run.w[-1, 0, 1] == pytest.approx(due, abs=1e-5)


@pytest.mark.parametrize("seed", range(2))
def test_two_bodies_that_meet_exchange_momentum_and_move_on_together(seed: int) -> None:
    """Face to face along a line through both centres, in any frame, at an end of a step."""
    frame = turned(np.random.default_rng(seed))
    one = box("one", [0, 0, 0], [0.1, 0.2, 0.3], frame, velocity=3.0 * frame[0])
    two = box("two", 0.312 * frame[0], [0.2, 0.1, 0.1], frame, velocity=-1.0 * frame[0])
    run = Moved(Scene((two, one), Contact(np.inf, mu=0.3)), 8, 1e-3)
    common = (3.0 * one.mass - two.mass) / (one.mass + two.mass)
    for k in range(2):
        assert run.v[-1, k] == pytest.approx(common * frame[0], abs=1e-7)
    assert np.abs(run.w).max() <= 1e-7
    total = two.mass * run.v[:, 0] + one.mass * run.v[:, 1]
    assert total == pytest.approx(np.tile(total[0], (9, 1)), abs=1e-7)
    lost = 0.5 * one.mass * two.mass / (one.mass + two.mass) * 16.0
    assert run.energy[-1, HIT] == pytest.approx(lost)


def test_a_pushed_box_tips_before_it_slides() -> None:
    """A slender box on which 0.4 of its weight acts at its middle: it starts to turn about an edge.

    w' = (0.4 h - b) m g/I with half width b and half height h, and I about the edge.
    """
    b, h, dt = 0.1, 0.4, 1e-3
    mass = 1000.0 * 8.0 * b * 0.2 * h
    block = box("b", [0, 0, h], [b, 0.2, h], load=[0.4 * mass * G, 0, 0], **PLANAR)
    run = Moved(Scene((FLOOR, block), Contact(np.inf, mu=0.9), gravity=DOWN), 20, dt)
    turns = (0.4 * h - b) * G / (4.0 * (b**2 + h**2) / 3.0)
    assert run.w[:, 0, 1] == pytest.approx(turns * run.t, rel=0.02, abs=1e-9)
    assert run.v[-1, 0] == pytest.approx([h * turns * 0.02, 0.0, b * turns * 0.02], rel=0.02)

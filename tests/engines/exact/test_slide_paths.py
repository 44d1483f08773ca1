"""Claims about slides on rigid contact in the exact engine: they agree with closed forms."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from reference_solutions.blocks import incline as slopes
from reference_solutions.blocks import responding_block
from tests.scenes.blocks.exact_slides import BOX, DOWN, EXACT, LEVEL, apart, ran, slid
from tests.scenes.blocks.sliding_blocks import (
    Frame,
    G,
    block,
    by_scipy,
    incline,
    random_scene,
    responding,
    wall,
)
from vv.ask import Velocity
from vv.engines.exact.modes import State
from vv.scene import Contact, Harmonic, Scene, Vector

SLOPES = [(28.0, phi) for phi in (5.0, 10.0, 15.0, 20.0, 25.0)]
SLOPES += [(45.0, phi) for phi in (10.0, 20.0, 30.0)]


@pytest.mark.parametrize(("alpha", "phi"), SLOPES)
def test_sliding_under_gravity_is_exact(alpha: float, phi: float) -> None:
    frame = Frame(alpha)
    run = ran(incline(frame, phi), 1.0)
    expected = slopes.gravity(run.times, alpha=alpha, phi=phi, g=G, v0=0.0)
    assert apart(run.values[BOX], expected[:, None] * frame.dip) < EXACT


@pytest.mark.parametrize("v0", [0.01, 0.1, 1.0, -1.0])
@pytest.mark.parametrize(("alpha", "phi"), [(45.0, 20.0), (20.0, 30.0), (20.0, 20.0)])
def test_a_start_at_a_speed_is_exact_also_where_it_ends_at_rest(
    alpha: float, phi: float, v0: float
) -> None:
    frame = Frame(alpha)
    run = ran(incline(frame, phi, v0=v0), 1.0)
    expected = slopes.gravity(run.times, alpha=alpha, phi=phi, g=G, v0=v0)
    assert apart(run.values[BOX] @ frame.dip, expected) < EXACT


SHAKEN = [
    (20.0, 22.0, 5.0, 1.0),
    (20.0, 30.0, 5.0, 1.0),
    (20.0, 35.0, 5.0, 1.0),
    (20.0, 22.0, 20.0, 10.0),
    (20.0, 30.0, 20.0, 10.0),
    (20.0, 20.0, 5.0, 10.0),
    (45.0, 45.0, 2.0, 10.0),
    (45.0, 50.0, 2.0, 10.0),
]


@pytest.mark.parametrize(("alpha", "phi", "A", "duration"), SHAKEN)
def test_newmark_sliding_is_exact(alpha: float, phi: float, A: float, duration: float) -> None:
    frame = Frame(alpha)
    run = ran(incline(frame, phi, A), duration)
    expected = slopes.newmark(run.times, alpha=alpha, phi=phi, A=A, f=1.0, g=G, v0=0.0)
    assert apart(run.values[BOX] @ frame.dip, expected) < EXACT


@pytest.mark.parametrize(
    ("phi", "d"), [(22.0, 0.7080274127), (30.0, 0.3270772510), (35.0, 0.1688662375)]
)
def test_newmark_sliding_ends_where_it_was_found_before(phi: float, d: float) -> None:
    frame = Frame(20.0)
    assert ran(incline(frame, phi, 5.0), 1.0).values[BOX][-1] @ frame.dip == pytest.approx(
        d, abs=5.1e-11
    )


RESPONDING = [
    (0.2, 2.0, 0.6, 0.4371496536),
    (0.2, 3.0, 0.6, 0.4790353311),
    (0.2, 5.0, 0.6, 0.4671690830),
    (0.3, 1.0, 0.6, 0.2205859410),
    (0.5, 1.0, 0.6, 0.8813472810),
    (1.0, 1.0, 0.6, 2.1827977173),
    (0.5, 1.0, 0.1, 0.7724770347),
    (0.5, 1.0, 1.0, 0.3676432349),
]


@pytest.mark.parametrize(("D", "f", "mu", "d"), RESPONDING)
def test_the_responding_block_is_exact(D: float, f: float, mu: float, d: float) -> None:
    run = ran(responding(D, f, mu), 5.0)
    moved = run.values[BOX][:, 0]
    assert apart(moved, responding_block.one_direction(run.times, D=D, f=f, mu=mu, g=G)) < EXACT
    assert moved[-1] == pytest.approx(d, abs=5.1e-11)


def quick(times: Vector, D: float, f: float, mu: float) -> Vector:
    """The displacement d2 [m] of a block that always slips, in extended precision.

    It is a parabola between reversals of slip.
    """
    wide = np.longdouble
    turn = 8 * np.arctan(wide(1)) * wide(f)
    t, d, v, a, found = wide(0), wide(0), wide(0), wide(mu) * wide(G), []
    for reversal in range(1, int(2 * f * times[-1]) + 2):
        end = wide(reversal) / (2 * wide(f))
        for _ in range(8):
            excess = v + a * (end - t) - D * turn * np.sin(turn * end)
            end -= excess / (a - D * turn**2 * np.cos(turn * end))
        s = times[(t <= times) & (times <= end)].astype(wide) - t
        found.append(d + v * s + a * s * s / 2)
        d, v, t = d + (end - t) * (v + a * (end - t) / 2), v + a * (end - t), end
        a = -a
    return np.concatenate(found).astype(float)


@pytest.mark.skipif(bool(np.finfo(np.longdouble).eps > 1e-18), reason="no extended precision here")
@pytest.mark.parametrize("f", [5.0, 20.0, 100.0])
def test_a_quick_base_costs_no_digits(f: float) -> None:
    """The error is 8e-15 at 100 Hz: the velocity is integrated, and not the small slip velocity."""
    run = ran(responding(0.2, f, 0.6), 5.0, 5.0 / 997)
    assert apart(run.values[BOX][:, 0], quick(run.times, 0.2, f, 0.6)) < 1e-13


@pytest.mark.parametrize("seed", range(10))
def test_walls_and_shaking_of_many_periods_agree_with_scipy(seed: int) -> None:
    """The normal force varies by a third. Differences are 5e-14 at most."""
    scene, frame = random_scene(seed)
    run = ran(scene, 3.0, 0.1)
    assert apart(run.values[BOX], by_scipy(scene, frame, run.times)) < 1e-11


def test_the_random_scenes_stick_and_slip_both_ways() -> None:
    seen = {(e.before, e.after) for s in range(10) for e in slid(random_scene(s)[0], 3.0).events}
    stuck, there, back = State.STUCK, State.SLIP_FORWARD, State.SLIP_BACKWARD
    assert {(there, stuck), (stuck, there), (back, stuck), (stuck, back), (there, back)} <= seen


def test_a_block_without_friction_follows_its_shaking_and_the_normal_of_its_wall_alone() -> None:
    wave = Harmonic((3.0, 0, 0), (2.0,) * 3)  # type: ignore[arg-type]
    lift = Harmonic((0.1, 0, 0.01), (1.0,) * 3, (np.pi / 2,) * 3)  # type: ignore[arg-type]
    bodies = (wall(LEVEL, lift), block(LEVEL, np.array([0.5, 0.0, 0.0])))
    run = ran(Scene(bodies, Contact(np.inf), gravity=DOWN, shaking=wave), 2.0)
    t, w = run.times, 4 * np.pi
    x = 0.5 * t + 3.0 * (t / w - np.sin(w * t) / w**2)
    z = 0.01 * (np.cos(2 * np.pi * t) - 1)
    assert apart(run.values[BOX], np.stack([x, 0 * t, z], axis=1)) < 1e-14


def test_the_velocity_is_that_of_the_base_while_the_block_sticks() -> None:
    run = ran(responding(0.05, 0.5, 0.6), 4.0)
    w = np.pi
    assert apart(run.values[Velocity(1)][:, 0], 0.05 * w * np.sin(w * run.times)) < 1e-13
    assert slid(responding(0.05, 0.5, 0.6), 4.0).events == ()


def test_a_block_slips_on_through_the_touch_of_zero_once_a_period() -> None:
    """phi = alpha: the velocity (A/(w cos alpha))(1 - cos wt) is zero once in a period."""
    for scene in (incline(Frame(20), 20.0, 5.0), incline(Frame(45), 45.0, 2.0)):
        path = slid(scene, 10.0)
        assert [e.after for e in path.events if e.time > 1e-9] == []


def test_a_block_that_touches_its_slip_limit_stays() -> None:
    """The force reaches mu g, exactly or except for rounding, and decreases again."""
    for A in np.nextafter(0.5 * G, [0.0, np.inf]):
        scene = responding(1.0, 1.0, 0.5)
        shaking = Harmonic((A, 0, 0), (1.0,) * 3)  # type: ignore[arg-type]
        resting = dataclasses.replace(scene, bodies=(wall(LEVEL), scene.blocks[0]), shaking=shaking)
        assert slid(resting, 5.0).events == ()

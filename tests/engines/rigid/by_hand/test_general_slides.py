"""Claims about blocks that slide, stick and fall in the general model, with results by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.engines.blocks.test_any_blocks import turned
from tests.engines.rigid.by_hand.general_runs import (
    BASE,
    DRIVEN,
    HIT,
    KINETIC,
    RUBBED,
    SHAKEN,
    SHOVED,
    TURNED,
    Moved,
    rising,
)
from tests.scenes.blocks.block_scenes import ACROSS, DOWN, FLOOR, HELD, IN_PLANE, box, slope
from vv.scene import Block, Contact, Harmonic, Scene, Vector, Wall, polyhedron_inertia

pytestmark = pytest.mark.usefixtures("in_python")
G, MU, DT = 9.81, 0.4, 0.01
AXES, PLANE = slope(20.0)
ALONG, ON = G * np.sin(np.radians(20.0)), G * np.cos(np.radians(20.0))  # m/s2
PLANAR: dict[str, Any] = {"free": IN_PLANE, "free_spin": ACROSS}
HALF = [0.3, 0.2, 0.15]  # m
MASS = 1000.0 * 0.6 * 0.4 * 0.3  # kg


def sines(size: Any, hertz: float, phase: float = 0.0) -> Harmonic:
    """Sines along the axes of the slope."""
    return Harmonic(np.array(size, float), np.full(3, hertz), np.full(3, phase), AXES)


def on_slope(
    steps: int, gap: float = 0.0, v: Any = (0, 0, 0), mu: float = MU, load: Any = (0, 0, 0),
    motion: Any = None, shaking: Any = None, dt: float = DT, stride: int = 1, **masks: Any,
) -> Moved:  # fmt: skip
    """A box on a slope; v, load along dip, strike and normal, load per mass."""
    block = box("b", (0.15 + gap) * AXES[2], HALF, AXES, velocity=np.array(v) @ AXES,
                load=MASS * np.array(load, float) @ AXES, **masks)  # fmt: skip
    wall = Wall(PLANE.point, PLANE.normal, motion)
    made = Scene((wall, block), Contact(np.inf, mu=mu), gravity=DOWN, axes=AXES, shaking=shaking)
    return Moved(made, steps, dt, stride)


@pytest.mark.parametrize("masks", [{}, PLANAR])
@pytest.mark.parametrize("stride", [1, 4])
def test_a_box_slides_down_until_it_stops_and_stays(stride: int, masks: Any) -> None:
    run = on_slope(32, v=(0.3, 0.0, 0.0), load=(0.0, 0.0, -2.0), stride=stride, **masks)
    press = ON + 2.0
    slows = MU * press - ALONG
    stops = 0.3 / slows
    t = np.minimum(run.t, stops)
    x = 0.3 * t - 0.5 * slows * t**2
    assert run.x[:, 0] @ AXES.T == pytest.approx(rising(x, 0 * t, 0 * t), abs=1e-9)
    assert run.v[:, 0] @ AXES[0] == pytest.approx(np.maximum(0.3 - slows * run.t, 0.0), abs=1e-9)
    assert run.energy[:, RUBBED] == pytest.approx(MASS * MU * press * x, abs=1e-7)
    assert run.energy[:, DRIVEN] == pytest.approx(MASS * ALONG * x, abs=1e-7)
    assert np.abs(run.energy[:, [HIT, BASE, SHAKEN, SHOVED, TURNED]]).max() <= 1e-8
    assert run.cuts.sum() == 1.0
    assert run.cuts[int(np.ceil(stops / DT / stride))] == 1.0
    pressed = run.system.newtons(run.acted)[:, 0] @ AXES.T / MASS
    assert pressed[1] == pytest.approx([-MU * press, 0.0, press])
    assert pressed[-1] == pytest.approx([-ALONG, 0.0, press], abs=1e-6)
    assert run.acted[-1, 1, 3:] @ AXES.T / MASS == pytest.approx(
        [0.3 + ALONG * run.t[-1], 0.0, -press * run.t[-1]], abs=1e-6
    )


def test_a_box_that_falls_flat_loses_what_it_had_along_the_normal() -> None:
    run = on_slope(6, gap=0.02, v=(0.5, 0.2, -1.0), load=(0.0, 2.0, 1.0), mu=0.0)
    falls = ON - 1.0
    hit = (np.sqrt(1.0 + 2.0 * falls * 0.02) - 1.0) / falls
    flies = np.minimum(run.t, hit)
    x, y = 0.5 * run.t + 0.5 * ALONG * run.t**2, 0.2 * run.t + run.t**2
    z = -flies - 0.5 * falls * flies**2
    assert run.x[:, 0] @ AXES.T == pytest.approx(rising(x, y, z), abs=1e-7)
    up = np.where(run.t < hit, -1.0 - falls * run.t, 0.0)
    assert run.v[:, 0] @ AXES.T == pytest.approx(
        rising(0.5 + ALONG * run.t, 0.2 + 2 * run.t, up), abs=1e-7
    )
    due = 0.5 * MASS * (1.0 + falls * hit) ** 2 * (run.t > hit)
    assert run.energy[:, HIT] == pytest.approx(due, rel=1e-6)
    assert run.energy[:, DRIVEN] / MASS == pytest.approx(ALONG * x - ON * z + 2.0 * y + z, abs=1e-7)
    assert run.cuts.sum() == 2.0
    assert np.abs(run.w).max() <= 1e-9


@pytest.mark.parametrize(("up", "off"), [(0.0, 1e-8), (0.002, 1e-4)])
def test_a_box_that_sticks_goes_with_its_plane_which_works_for_it(up: float, off: float) -> None:
    """Displacements are by the trapezoidal rule: off by dt^2/12 times the change of velocity."""
    size = np.array([0.01, 0.004, up])
    run = on_slope(20, v=4 * np.pi * np.cos(0.3) * size, motion=sines(size, 2.0, 0.3), mu=3.0)
    rate = np.outer(4 * np.pi * np.cos(4 * np.pi * run.t + 0.3), size)
    assert run.v[1:, 0] @ AXES.T == pytest.approx(rate[1:], abs=off)
    gained = run.energy[:, KINETIC] - run.energy[0, KINETIC] - run.energy[:, DRIVEN]
    assert run.energy[:, BASE] == pytest.approx(gained, abs=MASS * 3e-5)
    assert run.energy[-1, BASE] < -0.02


def test_shaking_moves_a_box_in_flight_and_works_for_it() -> None:
    run = on_slope(10, gap=9.0, shaking=sines([3.0, -2.0, 1.0], 5.0, 0.4))
    speed = (np.cos(0.4) - np.cos(10 * np.pi * run.t + 0.4)) / (10 * np.pi)
    v = np.outer(speed, [3.0, -2.0, 1.0]) + np.outer(run.t, [ALONG, 0.0, -ON])
    assert run.v[:, 0] @ AXES.T == pytest.approx(v, abs=1e-12)
    x = np.vstack([np.zeros(3), np.cumsum(0.5 * DT * (v[1:] + v[:-1]), axis=0)])
    assert run.x[:, 0] @ AXES.T == pytest.approx(x, abs=1e-12)
    push = np.diff(speed)[:, None] * [3.0, -2.0, 1.0]
    work = np.cumsum((push * np.diff(x, axis=0)).sum(1) / DT)
    assert run.energy[1:, SHAKEN] == pytest.approx(MASS * work)
    due = push @ AXES * MASS / DT
    assert run.force[1:, 0] == pytest.approx(due)
    assert run.acted[-1, 0, 3:] == pytest.approx(MASS * speed[-1] * np.array([3.0, -2, 1]) @ AXES)


@pytest.mark.parametrize("base", [True, False])
def test_a_box_begins_to_slip_when_its_plane_accelerates_too_much(base: bool) -> None:
    """Within 1/64 of a step, so that its path is that of steps ten times finer."""
    given: dict[str, Any] = {"mu": 0.75, "free_spin": HELD}
    if base:
        size = np.array([0.03, 0.02, 0.0])
        given |= {"motion": sines(size, 3.0), "v": 6.0 * np.pi * size}
    else:
        given |= {"shaking": sines([8.0, 4.0, 1.0], 3.0)}
    coarse, fine = on_slope(14, **given), on_slope(140, dt=DT / 10, stride=10, **given)
    assert np.abs(coarse.x - fine.x).max() <= 0.01 * np.abs(fine.x).max()
    assert np.abs(coarse.v - fine.v).max() <= 0.02 * np.abs(fine.v).max()
    assert coarse.cuts.sum() >= 1.0
    assert coarse.energy[-1, RUBBED] == pytest.approx(fine.energy[-1, RUBBED], rel=0.03)


@pytest.mark.parametrize("order", [1, -1])
def test_a_box_dragged_from_under_another_slides_below_it(order: int) -> None:
    """Both slide: the lower is pulled by a load against friction on both of its faces."""
    lower = box("lower", [0, 0, 0.2], [0.8, 0.5, 0.2], load=[9000.0, 0, 0], **PLANAR)
    upper = box("upper", [0.1, 0, 0.5], [0.2, 0.4, 0.1], **PLANAR)
    bodies = (FLOOR, lower, upper)[::order]
    run = Moved(Scene(bodies, Contact(np.inf, mu=MU), gravity=DOWN), 10, DT)
    one, two = (0, 1) if order == 1 else (1, 0)
    rubs = MU * upper.mass * G
    pulled = (9000.0 - 2.0 * rubs - MU * lower.mass * G) / lower.mass
    assert pulled > MU * G
    assert run.v[:, one] == pytest.approx(rising(pulled * run.t, 0.0, 0.0), abs=1e-7)
    assert run.v[:, two] == pytest.approx(rising(MU * G * run.t, 0.0, 0.0), abs=1e-7)
    assert np.abs(run.w).max() <= 1e-7
    slid = 0.5 * (pulled - MU * G) * run.t**2
    lost = rubs * slid + MU * (upper.mass + lower.mass) * G * 0.5 * pulled * run.t**2
    assert run.energy[:, RUBBED] == pytest.approx(lost, abs=1e-4)
    assert run.force[-1, two] == pytest.approx([rubs, 0.0, upper.mass * G], abs=1e-3)
    assert run.force[-1, one, 2] == pytest.approx(lower.mass * G, abs=1e-3)


def wedge(normals: Any, frame: Vector, velocity: Vector) -> Block:
    """A prism along the first axis whose sides lie on two planes through the origin."""
    right, left = (
        np.array([normals[1, 2], -normals[1, 1]]),
        np.array([-normals[0, 2], normals[0, 1]]),
    )
    triangle = 0.2 * np.array([[0.0, 0.0], right, left])
    vertices = np.array([[x, *point] for x in (-0.3, 0.3) for point in triangle]) @ frame
    faces = ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5))
    mass, inertia = polyhedron_inertia(vertices, faces, 1000.0)
    free = np.ones(3, bool)
    return Block("wedge", vertices, faces, mass, inertia, velocity, free, free)


@pytest.mark.parametrize("seed", range(2))
def test_a_box_slides_along_a_groove_whose_sides_press_it(seed: int) -> None:
    """Sides at 30 and 45 degrees to the horizontal, in any frame; friction acts on both."""
    frame = turned(np.random.default_rng(seed))
    one, two = np.radians([30.0, -45.0])
    normals = np.array([[0.0, np.sin(a), np.cos(a)] for a in (one, two)])
    press = np.linalg.solve(normals[:, 1:].T, [0.0, G])
    block = wedge(normals, frame, velocity=2.0 * frame[0])
    walls = [Wall(np.zeros(3), n @ frame) for n in normals]
    made = Scene((*walls, block), Contact(np.inf, mu=MU), gravity=-G * frame[2])
    run = Moved(made, 5, DT)
    slows = MU * press.sum()
    assert run.v[:, 0] @ frame.T == pytest.approx(rising(2.0 - slows * run.t, 0.0, 0.0), abs=1e-7)
    pressed = run.system.newtons(run.acted)[-1] @ frame.T / block.mass
    for k in range(2):
        due = [-MU * press[k], *(press[k] * normals[k, 1:])]
        assert pressed[k] == pytest.approx(due, abs=1e-5)

"""Claims about rigid blocks that land: the step is divided there, so that none enters the floor."""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
import pytest

from cases.hard.painleve import CASE as PAINLEVE
from cases.hard.painleve import LAW
from reference_solutions.hard import painleve_rod
from tests.engines.rigid.test_motion import solved
from tests.scenes.blocks.block_scenes import ACROSS, DOWN, FLOOR, FREE, HELD, IN_PLANE, G, box
from vv.ask import Ask, Knobs
from vv.engines import rigid
from vv.engines.rigid import PreparedRigidBlocks
from vv.engines.rigid.limits import HITS, LOOSELY
from vv.engines.rigid.point.model import point
from vv.engines.rigid.point.trial import Ground, landing_time
from vv.scene import Contact, Harmonic, Mask, Scene, Wall

HALF, LEAN = np.array([0.5, 0.5, 2.5]), 1.2  # m; of the angle at which it stands on an edge


def toppled(mu: float, dt: float) -> PreparedRigidBlocks:
    """A column of 1 x 5 m starts just beyond its balance, and lands on its side at 10 m/s."""
    tilt = LEAN * np.arctan(HALF[0] / HALF[2])
    c, s = np.cos(tilt), np.sin(tilt)
    axes = np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
    column = box("column", (HALF * [-1.0, 0.0, 1.0]) @ axes, HALF, axes,
                 free=IN_PLANE, free_spin=ACROSS)  # fmt: skip
    return solved(Scene((FLOOR, column), Contact(np.inf, mu=mu), gravity=DOWN), 2.9, dt, 0.1)


@pytest.mark.parametrize("mu", [0.3, 0.6, 2.0])
@pytest.mark.parametrize("dt", [1e-3, 5e-3])
def test_a_column_that_topples_lands_on_the_floor_and_not_in_it(mu: float, dt: float) -> None:
    """Its tip moves by 50 mm in a step of 5 ms: with mean velocities it penetrates by 18 mm."""
    program = toppled(mu, dt)
    assert program.report[:, 2].max() <= 1e-4
    assert program.report[:, 0].max() <= 1e-6
    start, sunk = program.ask.scene.blocks[0].centroid()[2], program.arguments[0][-1, 0, 2]
    assert start + sunk == pytest.approx(HALF[0], abs=1e-9)


def test_where_a_toppled_column_lies_hangs_little_on_the_step() -> None:
    """If penetration were removed instead, positions for different steps would be 2 mm apart."""
    lies = [toppled(2.0, dt).arguments[0][-1, 0, 0] for dt in (5e-3, 2e-3, 1e-3)]
    assert np.ptp(lies) <= 2e-4


@pytest.mark.shows("In smaller scenes the time of landing is found and the impact is instantaneous")
@pytest.mark.parametrize("free_spin", [HELD, FREE], ids=["held", "free"])
@pytest.mark.parametrize("step", [3e-3, 0.06, 0.17, 0.7])
def test_a_thrown_block_flies_and_comes_down_as_it_should_at_any_step(
    step: float, free_spin: Mask
) -> None:
    """Its flight of 0.2 s is shorter than one step, or takes many; it slides on where it lands."""
    thrown = box("thrown", [0, 0, 0.5], [0.5] * 3, velocity=[0.3, 0, G / 10], free_spin=free_spin)
    program = solved(Scene((FLOOR, thrown), Contact(np.inf), gravity=DOWN), 2.0, step, step)
    t = np.arange(len(program.arguments[0])) * step
    path = program.system.watched(program.arguments[0], 0)
    flies = np.where(t < 0.2, G / 10 * t - G * t**2 / 2, 0.0)
    assert np.abs(path[:, 0] - 0.3 * t).max() <= 1e-10
    assert np.abs(path[:, 2] - flies).max() <= 1e-10
    lost = program.energies[:, 2]
    assert np.abs(lost - np.where(t < 0.2, 0.0, 1000 * (G / 10) ** 2 / 2)).max() <= 2e-8 * lost[-1]


@pytest.mark.shows(
    "a block that lands in a scene of more than eight blocks penetrates for half a step"
)
def test_among_more_than_eight_blocks_one_that_lands_penetrates_for_half_a_step() -> None:
    """A step closes the gap, and the next one stops it: half of the gap too deep, as it moves at
    the mean of its velocities before and after."""
    step, high = 2e-3, 0.0507
    rest = [box(f"{i}", [2.0 * i, 0, 0.5], [0.5] * 3, free_spin=FREE) for i in range(9)]
    falls = box("falls", [-2.0, 0, 0.5 + high], [0.5] * 3, free_spin=FREE)
    scene = Scene((FLOOR, falls, *rest), Contact(np.inf, mu=0.5), gravity=DOWN)
    program = solved(scene, 0.2, step, step)
    gaps = [(high - 0.5 * G * (n * step) ** 2, G * n * step) for n in range(100)]
    gap = next(one for one, speed in gaps if one < step * (speed + G * step))
    assert program.report[:, 2].max() == pytest.approx(0.5 * (gap - LOOSELY), rel=1e-6)
    assert program.arguments[0][-1, 0, 2] == pytest.approx(-high, abs=1e-5)


@pytest.mark.parametrize(("gap", "rocks"), [(0.4e-6, False), (1.2e-6, False), (1.5e-6, True)])
def test_edges_that_land_nearly_together_take_part_in_one_impact(gap: float, rocks: bool) -> None:
    """A column lands at 1.26 m/s with one edge lower by `gap`. Up to 1.36e-6 m, HITS times the
    motion in a step, the other edge takes part in the impact; its gap closes in the next step, and
    the column stays. Edges hit one after the other make it rock on."""
    step, half, speed = 1e-2, np.array([0.1, 0.1, 0.4]), 1.0
    c, s = np.cos(gap / 0.2), np.sin(gap / 0.2)
    axes = np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
    column = box("column", [0.0, 0.0, 0.03 + np.abs(axes[:, 2]) @ half], half, axes,
                 velocity=[0.0, 0.0, -speed], free=IN_PLANE, free_spin=ACROSS)  # fmt: skip
    scene = Scene((FLOOR, column), Contact(np.inf, mu=0.5), gravity=DOWN)
    assert HITS * step * (np.hypot(speed, np.sqrt(0.06 * G)) + G * step) == pytest.approx(
        1.36e-6, rel=2e-3
    )
    spin = np.abs(solved(scene, 0.3, step, step).arguments[0][:, 0, 7]).max()
    assert spin > 0.1 if rocks else spin <= 1.001 * gap / (0.2 * step)


def dropped(step: float, duration: float = 0.7) -> float:
    """The error [m] of a block that falls 0.3 m on a base in vertical motion, then follows it."""
    size, omega = 0.05, 2 * np.pi
    up = np.array([0.0, 0.0, 1.0])
    heaves = Wall(np.zeros(3), up, Harmonic(size * up, up, np.full(3, -np.pi / 2)))
    block = box("dropped", [0, 0, 0.8], [0.5] * 3, free_spin=HELD)
    program = solved(Scene((heaves, block), Contact(np.inf), gravity=DOWN), duration, step, 0.02)
    t = np.arange(len(program.arguments[0])) * 0.02
    exact = np.maximum(-G * t**2 / 2, size * (1 - np.cos(omega * t)) - 0.3)
    return float(np.abs(program.arguments[0][:, 2] - exact).max())


def test_a_block_lands_on_a_base_that_heaves_where_they_meet() -> None:
    """Their relative path is curved; the remaining error is that of following the base."""
    errors = [dropped(step) for step in (0.02, 0.01, 0.005)]
    assert errors[0] <= 1e-4
    assert np.log2(errors[0] / errors[2]) / 2 == pytest.approx(3.0, abs=0.1)


def meeting(ground: Ground, speed: float, whole: float) -> float:
    return landing_time(ground, (0.0, 0.0, 0.0), (0.0, 0.0, -speed), 0.0, whole)


@pytest.mark.parametrize("second", [1.0, 1e-4], ids=["in seconds", "in units of 0.1 ms"])
@pytest.mark.parametrize("whole", [0.02, 0.03, 0.05])
def test_a_mass_lands_where_its_path_meets_a_base_that_heaves_fast(
    whole: float, second: float
) -> None:
    """The base turns within the fall, so that a parabola through the whole step misses it."""
    up, omega, size, height = np.array([0.0, 0.0, 1.0]), 200.0, 2e-4, 0.012
    frequency = np.full(3, omega / second / (2 * np.pi))
    base = Wall(np.zeros(3), up, Harmonic(size * up, frequency))
    block = box("falls", [0, 0, 0.5 + height], [0.5] * 3, free_spin=HELD)
    model = point(Scene((base, block), Contact(np.inf), gravity=DOWN / second**2))
    assert model is not None
    kernel: Any = numba.njit(meeting)
    _, ground = model.arguments(whole * second)
    t = kernel(ground, 1.0 / second, whole * second) / second
    left = height - t - G * t**2 / 2 - size * np.sin(omega * t)
    assert abs(left) <= 1e-10 * height


def jammed(mu: float, step: float) -> float:
    """The relative error in the path of a rod that jams as it slides on a wall with friction."""
    law = PAINLEVE.defaults("mu-2") | {"mu": mu}
    study = PAINLEVE.declare("mu-2", law).study
    run = rigid.solve(Ask(study.scene, study.goal, study.observables, Knobs(step)))
    exact = painleve_rod.middle(run.times, **{name: law[name] for name in LAW})
    (moved,) = run.values.values()
    return float(np.abs(moved[:, [0, 2]] - exact).max() / np.abs(exact).max())


@pytest.mark.shows("In Painleve's paradox a rod jams by an impact")
@pytest.mark.parametrize("mu", [1.34, 2.0])
def test_a_rod_that_jams_stops_at_once_and_turns_on_to_second_order(mu: float) -> None:
    errors = [jammed(mu, step) for step in (1e-3, 5e-4, 2.5e-4)]
    assert errors[0] <= 2e-6
    assert np.log2(errors[0] / errors[2]) / 2 == pytest.approx(2.0, abs=0.05)

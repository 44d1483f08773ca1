"""Claims about slides that turn in dda/augmented-lagrangian: friction's impulse turns with them."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from reference_solutions.blocks.responding_block import one_direction
from tests.scenes.blocks.dda_scenes import DOWN, FLOOR, G, box, closes, run
from vv.ask import Ask, Displacement, History, Knobs, Run, Velocity
from vv.engines.dda import BORNE
from vv.scene import Contact, Harmonic, Scene, Vector, Wall

SLOPE = math.radians(20.0)
MU = 0.5 * math.tan(SLOPE)
ALONG = np.array([math.cos(SLOPE), 0.0, -math.sin(SLOPE)])
OUT = np.array([math.sin(SLOPE), 0.0, math.cos(SLOPE)])
ACROSS = np.array([0.0, 1.0, 0.0])
SLOPING = (Wall(np.zeros(3), OUT),)
STEPS, DT = 140, 1e-3
UP, DOWNWARDS = (G * (math.sin(SLOPE) + way * MU * math.cos(SLOPE)) for way in (1, -1))


def thrown_up(
    walls: tuple[Wall, ...], turns: float, mu: float = MU, aside: float = 0.0, steps: int = STEPS
) -> Run:
    """A block thrown up a slope of 20 degrees, which turns after so many steps; aside: [m/s]."""
    frame = np.array([ALONG, ACROSS, OUT])
    body = box((0.5, 0.3, 0.4), 1200.0 / 0.48, 0.4 * OUT, frame)
    thrown = dataclasses.replace(body, velocity=aside * ACROSS - UP * turns * DT * ALONG)
    scene = Scene((*walls, thrown), Contact(math.inf, mu=mu), gravity=DOWN)
    index = len(walls)
    ask = Ask(scene, History(steps * DT, DT), (Velocity(index),), Knobs(DT, 1e8))
    return run(ask, BORNE)


def speed(done: Run, body: int) -> float:
    """The velocity down the slope [m/s], which is that in the middle of the last step."""
    return float(done.values[Velocity(body)][-1] @ ALONG)


def mid_step(turns: float) -> float:
    return DOWNWARDS * (STEPS - 0.5 - turns) * DT


@pytest.mark.shows("friction's impulse reverses when slip does")
@pytest.mark.parametrize("turns", [0.7, 1.0, 60.1, 60.3, 60.5, 60.8])
def test_a_block_thrown_up_a_slope_comes_down_as_fast_as_it_should(turns: float) -> None:
    """Forces are constant but for the direction of friction: nothing but rounding is off."""
    assert speed(thrown_up(SLOPING, turns), 1) == pytest.approx(mid_step(turns), rel=1e-9)


@pytest.mark.parametrize("turns", [60.1, 60.8])
def test_so_does_one_in_the_corner_of_two_walls(turns: float) -> None:
    """The second wall stands along the dip, and carries nothing."""
    walls = *SLOPING, Wall(-0.3 * ACROSS, ACROSS)
    assert speed(thrown_up(walls, turns), 2) == pytest.approx(mid_step(turns), rel=1e-9)


def test_friction_gives_no_energy_where_it_drives_a_block_back() -> None:
    """The middle of the second step is 0.1 steps after the turn, with friction's mean still down.

    The first step ends in its middle at 0.9 steps before the turn.
    """
    done = thrown_up(SLOPING, 1.4, steps=2)
    closes(done)
    assert done.ledger is not None
    friction = 1200.0 * MU * G * math.cos(SLOPE)
    assert done.ledger.terms["friction dissipation"] == pytest.approx(
        friction * 0.9 * UP * DT**2, rel=1e-6
    )


def test_where_friction_holds_it_the_block_stays_where_it_stops() -> None:
    """With four times the friction it is slowed down twice as fast, and stops after 10.3 steps."""
    done = thrown_up(SLOPING, 20.6, mu=4 * MU)
    assert abs(done.values[Velocity(1)][11:]).max() < 1e-12


@pytest.mark.parametrize("aside", [0.1, 0.5, 3.0])
def test_a_slide_that_leaves_its_line_is_left_as_it_is(aside: float) -> None:
    """Friction on a line would have an impulse that the block does not get."""
    closes(thrown_up(SLOPING, 20.6, aside=aside * UP * DT))


def test_a_slide_that_passes_close_to_rest_keeps_its_momentum() -> None:
    """It turns there while friction holds it across its line, for a step in which it sticks.

    As a slide that turns back on its line it would lose that friction: 800 N of 15 kN.
    """
    motions = Harmonic(np.full(3, 0.1), np.array([2.0, 0.4, 1.0]), np.full(3, -np.pi / 2))
    base = dataclasses.replace(FLOOR, motion=motions)
    scene = Scene((base, box((1.0, 1.0, 1.0), 2500.0)), Contact(math.inf, mu=0.6), gravity=DOWN)
    closes(run(Ask(scene, History(2.0, 2.0), (Displacement(1),), Knobs(1e-3, 1e8)), BORNE))


def test_a_locked_block_over_a_base_that_turns_back_is_left_as_it_is() -> None:
    """No impulse of friction changes its velocity, and its slip is that of the base."""
    motion = Harmonic(np.array([0.5, 0.0, 0.0]), np.ones(3), np.full(3, -np.pi / 2))
    base = dataclasses.replace(FLOOR, motion=motion)
    body = box((0.5, 0.5, 0.5), 2500.0, free=np.array([False, False, True]))
    scene = Scene((base, body), Contact(math.inf, mu=0.1), gravity=DOWN)
    closes(run(Ask(scene, History(1.3, 1.3), (Displacement(1),), Knobs(1.3e-2, 1e8)), BORNE))


def dragged(dt: float, axis: Vector) -> float:
    """The error [m] after 3 s of a block on a base that moves back and forth along an axis.

    The answer is 0.965 m, and half a period 125 steps of 4 ms.
    """
    motion = Harmonic(0.5 * axis, np.ones(3), np.full(3, -np.pi / 2))
    base = dataclasses.replace(FLOOR, motion=motion)
    scene = Scene((base, box((0.5, 0.5, 0.05), 2500.0)), Contact(math.inf, mu=0.3), gravity=DOWN)
    ask = Ask(scene, History(3.0, 3.0), (Displacement(1),), Knobs(dt, 1e8))
    right = one_direction(np.array([3.0]), D=0.5, f=1.0, mu=0.3, g=G)[0]
    return float(run(ask, BORNE).values[Displacement(1)][-1] @ axis - right)


@pytest.mark.parametrize("axis", [(1.0, 0.0, 0.0), (0.6, 0.8, 0.0)])
def test_a_base_that_drags_a_block_back_and_forth_is_followed_with_second_order(
    axis: tuple[float, float, float],
) -> None:
    """Six turns: each misplaces the block by up to 2 mu g dt^2/8, where its acceleration jumps.

    The bound is twice that, since the base's acceleration changes in the step too. Friction that
    turned with steps only would leave 1e-3 m or more at the first three of these steps.
    """
    for dt in (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4):
        assert abs(dragged(dt, np.array(axis))) < 2 * 6 * 2 * 0.3 * G * dt**2 / 8

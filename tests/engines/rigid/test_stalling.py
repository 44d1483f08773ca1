"""Claims about scenes on which sweeps over the contacts stall: they are solved nevertheless."""

from __future__ import annotations

import numpy as np
import pytest

from tests.engines.rigid.test_motion import ends, solved
from tests.scenes.blocks.block_scenes import DOWN, FLOOR, HELD, G, box, incline
from vv.scene import Contact, Harmonic, Scene

CONVERGED = 1e-12  # m/s
S = np.sqrt(0.5)


@pytest.mark.parametrize("half", [0.5, 0.05, 0.005])
def test_a_light_block_bears_a_heavy_one(half: float) -> None:
    light = box("light", [0.0, 0.0, half], [half] * 3)
    heavy = box("heavy", [0.0, 0.0, 2 * half + 5.0], [5.0] * 3)  # 1e3 to 1e9 times the mass
    program = solved(Scene((FLOOR, light, heavy), Contact(np.inf, mu=0.5), gravity=DOWN), 0.02)
    weight = (light.mass + heavy.mass) * G
    assert program.report[:, 0].max() <= CONVERGED
    assert np.abs(ends(program)).max() <= 1e-11
    assert np.abs(program.reactions[-1, 0] / weight - [0.0, 0.0, 1.0]).max() <= 1e-8


@pytest.mark.shows(
    "the block creeps down slowly in `rigid`",
    "A slope that is gentler by a thousandth of a degree removes this",
)
@pytest.mark.parametrize("alpha", [10, 20, 23, 30, 40])
def test_a_block_that_friction_barely_holds_on_a_slope_stays(alpha: float) -> None:
    held, limit = solved(incline(alpha, alpha + 1e-3), 0.5), solved(incline(alpha, alpha), 0.5)
    assert max(one.report[:, 0].max() for one in (held, limit)) <= CONVERGED
    assert np.abs(ends(held)).max() <= 1e-10 * G * 0.5**2 / 2
    # Friction that points an angle a off the dip lacks a^2/2 of what holds the block, which then
    # slips at g dt a^2/2 in a step; the residual lets this speed times a reach its limit.
    creeps = G * (2 * CONVERGED / (G * 1e-3)) ** (2 / 3)  # m/s^2: twice this loss
    assert np.abs(ends(limit)).max() <= creeps * 0.5**2 / 2


def test_edges_that_cross_hold_by_friction_without_bound() -> None:
    across = np.array([[S, 0.0, S], [0.0, 1.0, 0.0], [-S, 0.0, S]])
    along = np.array([[1.0, 0.0, 0.0], [0.0, S, S], [0.0, -S, S]])
    ridge = box("ridge", [0.0, 0.0, 0.0], [0.5] * 3, across, free=HELD, free_spin=HELD)
    falls = box("falls", [0.1, 0.2, 2 * S + 1e-3], [0.5] * 3, along, velocity=[0.3, 0.2, -1.0])
    program = solved(Scene((ridge, falls), Contact(np.inf, mu=50.0)), 0.005, interval=1e-3)
    assert program.report[:, 0].max() <= CONVERGED
    arm = np.array([-0.1 - 3e-4, 0.0, -S])  # from the centre, as they meet
    matrix = np.cross(np.eye(3), -arm)  # of arm x
    flexible = np.eye(3) / falls.mass - matrix @ np.linalg.inv(falls.inertia) @ matrix
    gain = np.linalg.solve(flexible, -falls.velocity) / falls.mass
    after = program.arguments[0][-1, 2, 3:6]
    assert np.abs(after - falls.velocity - gain).max() <= 1e-3


@pytest.mark.parametrize("mu", [2.0, 5.0, 50.0])
@pytest.mark.parametrize("sideways", [5.0, 6.5])
def test_friction_that_lifts_more_than_the_push_is_solved(mu: float, sideways: float) -> None:
    """A block tips until its foot slips: the moment of friction then lifts the foot.

    N (1/m + x (x + mu z)/I) = g - w^2 z: sweeps that update N and friction in turn would diverge.
    """
    half, weight, spin = np.array([0.0634, 0.3, 0.132]), 13.0, 8.04
    c, s = np.cos(0.977), np.sin(0.977)
    axes = np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
    arm = (half * [-1.0, 0.0, 1.0]) @ axes
    turns = np.array([0.0, spin, 0.0])
    block = box("falls", arm, half, axes, velocity=np.cross(turns, arm), spin=turns)
    scene = Scene(
        (FLOOR, block), Contact(np.inf, mu=mu), gravity=np.array([sideways, 0.0, -weight])
    )
    program = solved(scene, 0.02, 2.5e-4, 2.5e-4)
    assert program.report[:, 0].max() <= CONVERGED
    state, borne = program.arguments[0][-2, 0], program.reactions[-1, 0]
    (x, _, z), spin = arm + state[:3], state[7]
    push = (weight - spin**2 * z) / (1 / block.mass + x * (x + mu * z) / block.inertia[1, 1])
    assert borne[[0, 2]] == pytest.approx(push * np.array([-mu, 1.0]), rel=1e-2)


def test_a_block_free_to_turn_slides_as_accurately_as_one_that_is_not() -> None:
    along = np.array([1.0, 0.0, 0.0])
    shaking = Harmonic(5.0 * along, along, np.zeros(3))
    slab = (0.5, 0.5, 0.2)
    free = solved(incline(20, 30, shaking, half=slab), 2.0)
    held = solved(incline(20, 30, shaking, half=slab, free_spin=HELD), 2.0)
    path = held.system.watched(held.arguments[0], 0)
    assert np.abs(ends(free) - path[-1, :3]).max() <= 1e-9

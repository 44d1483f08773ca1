"""Claims about the lanes and batches of contacts, and about rounds that solve them all."""

from __future__ import annotations

import numpy as np
import pytest

from tests.engines.rigid.by_hand.solver.test_band import linked
from tests.engines.rigid.by_hand.solver.test_joints import scattered, spd
from tests.engines.rigid.by_hand.solver.test_sweeps import rubbing
from vv.engines.blocks.contacts import Contacts
from vv.engines.rigid.general.few import polish
from vv.engines.rigid.limits import INNER, LONGEST, STIFF
from vv.engines.rigid.solver.assembly import Bodies, assemble
from vv.engines.rigid.solver.cone import residual
from vv.engines.rigid.solver.newton import newton_round
from vv.engines.rigid.solver.problem import Problem
from vv.engines.rigid.solver.rounds import newton_rounds
from vv.engines.rigid.solver.seats import DEPTH, LANES, runs, seated

pytestmark = pytest.mark.usefixtures("in_python")


def test_a_run_is_of_one_pair_of_bodies_and_not_too_long() -> None:
    pairs = [(0, 1)] * 3 + [(0, 2)] * (DEPTH + 2) + [(1, 2), (0, 2), (1, 0), (1, 0)]
    joints, _ = linked(pairs, 3)
    joints.across[:] = 1.0
    joints.across[[1, len(pairs) - 1]] = 0.0
    run, begin = runs(joints)
    long = [1] * DEPTH + [2, 2]
    assert run.tolist() == [0, -1, 0, *long, 3, 4, 5, -1]
    assert begin.tolist() == [0, 3, 3 + DEPTH, 5 + DEPTH, 6 + DEPTH, 7 + DEPTH]
    joints.across[:] = 0.0
    assert [x.tolist() for x in runs(joints)] == [[-1] * len(pairs), []]
    joints.across[-1] = 1e-9
    assert runs(joints)[1].tolist() == [len(pairs) - 1]
    assert [x.tolist() for x in runs(linked([], 3)[0])] == [[], []]


def test_the_longest_runs_sit_first_and_share_no_moving_body() -> None:
    """Runs of 1, 3 and 2 contacts; body 4 is a wall, which any number of lanes may share."""
    pairs = [(0, 1)] + [(4, 2)] * 3 + [(0, 2)] * 2 + [(4, 0)] * 2 + [(4, 3)] * 2
    joints, bodies = linked(pairs, 4)
    joints.across[:] = 1.0
    seat, depth = seated(joints, bodies, *runs(joints))
    assert seat.tolist() == [2 * LANES, 0, LANES, 1, 2]
    assert depth.tolist() == [3, 2, 1]


@pytest.mark.parametrize("first", [True, False])
def test_a_body_in_many_runs_sits_in_a_batch_of_each(first: bool) -> None:
    """A body with four others, whose runs follow each other; two more fit beside the first."""
    pairs = np.array([(1, 0), (1, 2), (1, 3), (1, 4), (5, 6)])
    joints, bodies = linked(pairs if first else pairs[:, ::-1], 7)
    joints.across[:] = 1.0
    seat, depth = seated(joints, bodies, *runs(joints))
    assert seat.tolist() == [0, LANES, 2 * LANES, 3 * LANES, 1]
    assert depth.tolist() == [1] * 4


def test_a_batch_that_is_full_is_followed_by_another() -> None:
    """Of 2 LANES + 3 blocks on a wall; a pair of the first two fits beside the others."""
    many = 2 * LANES + 3
    pairs = [(many, k) for k in range(many)] + [(0, 1)]
    joints, bodies = linked(pairs, many)
    joints.across[:] = 1.0
    seat, depth = seated(joints, bodies, *runs(joints))
    assert seat.tolist() == [*range(many), 2 * LANES + 3]
    assert depth.tolist() == [1, 1, 1]


def pressed(seed: int) -> Problem:
    """Three blocks thrown at one another and a wall, with friction and no impulses yet."""
    joints, bodies = scattered(seed)
    friction = rubbing(seed, slides=False)
    v, w = np.random.default_rng(seed).normal(size=(2, 4, 3))
    return Problem(joints, bodies, friction, np.zeros((6, 3)), v, w)


def at_contacts(given: Problem) -> float:
    """The residual."""
    return residual(given.p, given.joints, given.friction, given.v, given.w)


@pytest.mark.parametrize("seed", range(4))
def test_rounds_of_newton_steps_solve_contacts(seed: int) -> None:
    for way in ("polish", "rounds"):
        given, place = pressed(seed), np.array([2, 0, 1])
        left = at_contacts(given)
        assert left > 0.1
        if way == "polish":
            found = polish(given, 1e-10, left, place, STIFF)
        else:
            found = newton_rounds(given, 1e-10, place, LONGEST)
        assert found == pytest.approx(at_contacts(given), abs=1e-14)
        assert found <= 1e-10


@pytest.mark.parametrize("unit", [1e-3, 1.0, 1e3])
def test_a_round_does_not_know_the_unit_of_length(unit: float) -> None:
    """Velocities, arms and needs in another unit give the impulses in that unit."""
    found = []
    for size in (1.0, unit):
        joints, bodies, friction, p, v, w = pressed(1)
        joints = joints._replace(
            arm_first=size * joints.arm_first, arm_second=size * joints.arm_second
        )
        bodies = bodies._replace(inverse_spin=bodies.inverse_spin / size**2)
        friction = friction._replace(need=size * friction.need)
        q = np.zeros((6, 3))
        scaled = Problem(joints, bodies, friction, p, size * v, w)
        assert newton_round(scaled, q, 1e-9 * size, 100.0, np.arange(3), INNER) > 0
        found.append(p / size)
    assert np.abs(found[0]).max() > 0.01
    assert found[1] == pytest.approx(found[0], rel=1e-9, abs=1e-12)


def test_a_round_says_whether_it_converged() -> None:
    given, q = pressed(2), np.zeros((6, 3))
    assert 1 < newton_round(given, q, 1e-9, 100.0, np.arange(3), INNER) <= INNER
    assert newton_round(given, q, -1.0, 100.0, np.arange(3), 5) == -5


def test_a_round_solves_a_chain_of_blocks() -> None:
    """Five blocks in a row on a wall, whose equations are more than two bands wide."""
    blocks, random = 5, np.random.default_rng(3)
    inverse, spins = spd(random, blocks + 1), spd(random, blocks + 1)
    inverse[blocks] = spins[blocks] = 0.0
    bodies = Bodies(inverse, spins, random.normal(size=(blocks + 1, 3)))
    ends, normal = np.arange(blocks), random.normal(size=(blocks, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    empty, key = np.zeros(blocks), ends + 0
    found = Contacts(
        np.roll(ends, 1), ends, random.normal(size=(blocks, 3)), normal, empty, empty, key
    )
    found.first[0] = blocks
    joints = assemble(found, blocks, bodies)
    v, w = random.normal(size=(2, blocks + 1, 3))
    p, friction = np.zeros((blocks, 3)), rubbing(3, slides=False)
    left = newton_rounds(Problem(joints, bodies, friction, p, v, w), 1e-10, ends, LONGEST)
    assert residual(p, joints, friction, v, w) == pytest.approx(left, abs=1e-14)
    assert left <= 1e-10
    assert (p != 0.0).any(1).sum() >= 3

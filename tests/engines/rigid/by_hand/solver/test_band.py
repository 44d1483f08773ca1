"""Claims about the order of equations in a band, and their solution."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from vv.engines.rigid.solver.assembly import Bodies, Joints
from vv.engines.rigid.solver.banded import (
    band_ordering,
    can_move,
    coupled,
    eliminate,
    equation_numbers,
    half_width,
    neighbours,
    number_layers,
)

pytestmark = pytest.mark.usefixtures("in_python")
NONE = np.empty((0, 3))


def linked(pairs: Any, blocks: int, held: Any = ()) -> tuple[Joints, Bodies]:
    """Contacts between pairs of blocks, of which some are held, and a wall after them."""
    ends = np.array(pairs, np.int64).reshape(-1, 2)
    free = np.array([i < blocks and i not in held for i in range(blocks + 1)], float)
    matrices = free[:, None, None] * np.eye(3)
    nil = np.zeros(len(ends))
    joints = Joints(ends[:, 0].copy(), ends[:, 1].copy(), NONE, NONE, NONE, NONE, nil, nil)
    return joints, Bodies(matrices, matrices.copy(), np.zeros((blocks + 1, 3)))


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("what", ["inverse", "inverse_spin"])
def test_a_body_can_move_that_an_impulse_moves_along_or_about_any_axis(
    what: str, axis: int
) -> None:
    _, bodies = linked([(0, 1)], 2, held=(0, 1))
    assert not can_move(bodies, 1)
    getattr(bodies, what)[1, axis, axis] = 1e-3
    assert can_move(bodies, 1)
    assert not can_move(bodies, 0)


def test_a_contact_couples_two_bodies_that_can_move() -> None:
    joints, bodies = linked([(0, 1), (0, 2), (2, 1), (4, 0)], 4, held=(2,))
    assert [coupled(joints, c, bodies) for c in range(4)] == [True, False, False, False]


def test_each_block_has_those_as_neighbours_to_which_contacts_couple_it() -> None:
    joints, bodies = linked([(0, 1), (1, 3), (0, 1), (2, 3), (5, 0), (0, 4)], 5, held=(4,))
    start, other = neighbours(joints, bodies, 5)
    found = [sorted(other[start[i] : start[i + 1]].tolist()) for i in range(5)]
    assert found == [[1, 1], [0, 0, 3], [3], [1, 2], []]


def test_blocks_are_numbered_by_their_distance_from_a_root() -> None:
    joints, bodies = linked([(0, 2), (2, 4), (4, 1), (0, 3)], 6)
    start, other = neighbours(joints, bodies, 6)
    place = np.full(6, -1)
    place[5] = 0
    assert number_layers(place, start, other, 0, 1) == (6, 1)
    assert place[5] == 0
    assert place[0] == 1
    assert sorted(place[[2, 3]].tolist()) == [2, 3]
    assert place[[4, 1]].tolist() == [4, 5]


@pytest.mark.parametrize("seed", range(3))
def test_a_chain_is_ordered_along_itself_and_a_ring_two_by_two(seed: int) -> None:
    """In any numbering of 7 and 6 blocks, both in one scene, and two alone."""
    names = np.random.default_rng(seed).permutation(15)
    chain = [(names[k], names[k + 1]) for k in range(6)]
    ring = [(names[7 + k], names[7 + (k + 1) % 6]) for k in range(6)]
    joints, bodies = linked(chain, 15)
    place, apart = band_ordering(joints, bodies, 15)
    assert apart == 1
    assert sorted(place.tolist()) == list(range(15))
    assert (np.abs(np.diff(place[names[:7]])) == 1).all()
    place, apart = band_ordering(*linked(chain + ring, 15), 15)
    assert apart == 2
    assert max(abs(place[a] - place[b]) for a, b in chain + ring) == 2
    assert sorted(place.tolist()) == list(range(15))
    assert band_ordering(*linked(np.empty((0, 2)), 3), 3)[1] == 0


def test_equations_follow_the_order_of_blocks_without_those_that_are_locked() -> None:
    _, bodies = linked([], 3)
    bodies.inverse[0] = np.diag([1.0, 0.0, 1.0])
    bodies.inverse_spin[0] = np.diag([0.0, 1.0, 0.0])
    bodies.inverse[2], bodies.inverse_spin[2] = 0.0, np.diag([0.0, 0.0, 2.0])
    row, many = equation_numbers(bodies, np.array([2, 0, 1]))
    assert many == 6 + 1 + 3
    assert row.reshape(3, 6).tolist() == [
        [7, -1, 8, -1, 9, -1], [0, 1, 2, 3, 4, 5], [-1, -1, -1, -1, -1, 6]
    ]  # fmt: skip


def test_a_band_is_as_wide_as_the_farthest_equations_of_a_contact() -> None:
    joints, bodies = linked([(0, 2), (3, 1)], 3)
    row, _ = equation_numbers(bodies, np.array([0, 1, 2]))
    assert half_width(joints, row, 3) == 17
    row[:2], row[16:] = -1, -1
    assert half_width(joints, row, 3) == 15 - 2
    assert half_width(linked([(3, 1), (1, 3)], 3)[0], row, 3) == 5


@pytest.mark.parametrize("pivots", [True, False])
@pytest.mark.parametrize(("m", "half"), [(1, 5), (7, 2), (12, 3), (9, 11)])
def test_a_banded_system_is_solved_with_pivots(m: int, half: int, pivots: bool) -> None:
    """Of random numbers, or with small diagonals that must not be pivots."""
    random = np.random.default_rng(m)
    apart = np.subtract.outer(np.arange(m), np.arange(m))
    full = np.where(abs(apart) > half, 0.0, random.normal(size=(m, m)))
    if pivots and m > 1:
        full[np.arange(m), np.arange(m)] *= 1e-13
    elif not pivots:
        full[np.arange(m), np.arange(m)] += 9.0
    band, x = np.zeros((m, 3 * half + 1)), random.normal(size=m)
    for i in range(m):
        for j in range(max(0, i - half), min(m, i + half + 1)):
            band[i, j - i + half] = full[i, j]
    right = full @ x
    eliminate(band, right, half)
    assert right == pytest.approx(x, abs=1e-11 * np.linalg.cond(full))

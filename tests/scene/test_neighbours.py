"""Claims that no pair of spheres that overlap is missed or found twice, wherever they lie."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from vv.scene import Spheres, Vector
from vv.scene.neighbours import _candidates, overlapping


def spheres(place: Vector, radius: Vector) -> Spheres:
    n = len(place)
    return Spheres(place, np.zeros((n, 3)), radius, np.ones(n), np.ones((n, 3), bool))


def by_hand(some: Spheres) -> list[list[int]]:
    """All pairs, one by one."""
    pairs = itertools.combinations(range(len(some)), 2)
    apart = {(i, j): np.linalg.norm(some.position[j] - some.position[i]) for i, j in pairs}
    return [[i, j] for (i, j), d in apart.items() if d < some.radius[i] + some.radius[j]]


@pytest.mark.parametrize("spread", [0.1, 3.0, 100.0, 1e9])
@pytest.mark.parametrize("flat", [False, True])
def test_pairs_are_those_found_one_by_one_in_their_order(spread: float, flat: bool) -> None:
    rng = np.random.default_rng(7)
    place = rng.uniform(-spread, spread, (90, 3)) * ([1, 1, 0] if flat else [1, 1, 1])
    place[:30] = place[0] + rng.uniform(-2.0, 2.0, (30, 3))  # a crowd among the others
    some = spheres(place, rng.uniform(0.01, 1.0, 90))
    assert overlapping(some).tolist() == by_hand(some)
    assert len(by_hand(some)) > 10


def test_an_overlap_by_rounding_is_left_out_where_the_least_is_named() -> None:
    some = spheres(np.array([[0.0, 0, 0], [2 * (1 - 1e-14), 0, 0], [0, 1.9, 0]]), np.ones(3))
    assert overlapping(some).tolist() == [[0, 1], [0, 2]]
    assert overlapping(some, least=1e-12).tolist() == [[0, 2]]


def test_one_sphere_has_no_neighbour() -> None:
    assert overlapping(spheres(np.zeros((1, 3)), np.ones(1))).shape == (0, 2)


def test_no_more_pairs_are_looked_at_than_lie_in_cells_that_touch() -> None:
    """Of a lattice of cells with a sphere each: itself and half of 26 neighbours at most."""
    place = np.array([*itertools.product(range(-50, 50, 10), repeat=3)], float)
    looked_at = sum(len(pairs) for pairs in _candidates(spheres(place, np.full(1000, 4.9))))
    assert 0 < looked_at <= 13 * 1000
    apart = spheres(100.0 * place, np.full(1000, 4.9))
    assert sum(len(pairs) for pairs in _candidates(apart)) == 0


def test_a_cell_is_wider_than_what_may_overlap() -> None:
    """Two that overlap by 1e-9, one short of a border, the other behind the next one but one."""
    one = 2 - 2e-9 - 1e-12
    place = np.array([[0.0, 0, 0], [one, 9.0, 0], [one + 2 - 1e-9, 9.0, 0]])
    assert overlapping(spheres(place, np.ones(3))).tolist() == [[1, 2]]

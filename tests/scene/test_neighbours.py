"""Claims that no pair of spheres that overlap is missed or found twice, wherever they lie."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from vv.scene import Spheres, Vector
from vv.scene.neighbours import overlapping


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

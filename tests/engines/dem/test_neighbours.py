"""Claims about the pairs of spheres that are found by cells."""

from typing import Any

import numba
import numpy as np
import pytest

from vv.engines.dem.rows import Index
from vv.engines.dem.space.neighbours import Near, near_pairs
from vv.scene import Vector

SKIN = 0.1  # m


def found(near: Near, u: Vector) -> Index:
    return near_pairs(near, u)


FOUND: Any = numba.njit(found)  # a function without an entry from Python, called by one that has it


@pytest.mark.parametrize(("spheres", "edge"), [(40, 1.0), (200, 2.0), (60, 20.0)])
def test_pairs_are_those_of_all_even_where_there_are_more_than_had_room(
    spheres: int, edge: float
) -> None:
    random = np.random.default_rng(1)
    place, radius = random.uniform(0, edge, (spheres, 3)), random.uniform(0.3, 0.6, spheres)
    none = np.zeros(0, np.int64)
    near = Near(place, radius, np.arange(spheres), SKIN, np.zeros(spheres + 1, np.int64), none,
                np.zeros(0, np.uint8), viscous=False)  # fmt: skip
    i, j = np.triu_indices(spheres, 1)
    close = np.linalg.norm(place[i] - place[j], axis=1) < radius[i] + radius[j] + SKIN
    pairs = {(int(a), int(b)) for a, b in FOUND(near, np.zeros((spheres + 1, 3)))}
    assert pairs == set(zip(i[close].tolist(), j[close].tolist(), strict=True))
    assert (len(pairs) > 8 * spheres) == (edge < 20.0)

"""Claims about cells of the bulk model: they are wide enough, and all near pairs are found."""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
import pytest

from vv.engines.dem.bulk.cells import cell_counts, cells
from vv.engines.dem.bulk.grains import Given, initial_grains
from vv.engines.dem.bulk.near import near_pairs, no_contacts
from vv.scene import Vector

SKIN = 0.05  # m


def _counted(low: tuple[float, ...], high: tuple[float, ...], edge: float) -> Any:
    return cell_counts(low, high, edge)  # type: ignore[arg-type]


def _found(given: Given, edge: float) -> Any:
    """The numbers of the spheres of each pair in the scene, and in the order of cells."""
    grains = initial_grains(given)
    sorted_into = cells(grains, edge)
    near = near_pairs(grains, sorted_into, SKIN, no_contacts(len(given.mass)), False)
    return grains.original[near.one], grains.original[near.other], near.one, near.other


counted: Any = numba.njit(_counted)
found: Any = numba.njit(_found)


def test_cells_are_as_many_as_fit_wherever_the_spheres_lie() -> None:
    assert counted((5.0, -7.0, 1.0), (8.5, -4.0, 1.2), 0.7) == (5, 4, 1)


@pytest.mark.parametrize("corner", [[0.0, 0.0, 0.0], [40.0, -30.0, 25.0]])
@pytest.mark.parametrize("box", [[3.0, 1.0, 2.0], [0.5, 4.0, 1.5], [60.0, 60.0, 60.0]])
def test_pairs_are_those_of_all_wherever_the_spheres_lie(box: Vector, corner: Vector) -> None:
    random, n = np.random.default_rng(5), 300
    place, radius = corner + random.uniform(size=(n, 3)) * box, random.uniform(0.05, 0.1, n)
    fixed = np.arange(n) % 7 == 0
    mass = np.where(fixed, np.inf, 1.0)
    one, other, first, second = found(
        Given(place, np.zeros((n, 3)), None, radius, mass, mass), 0.2 + SKIN
    )
    pairs = {(min(a, b), max(a, b)) for a, b in zip(one.tolist(), other.tolist(), strict=True)}
    i, j = np.triu_indices(n, 1)
    close = np.linalg.norm(place[i] - place[j], axis=1) < radius[i] + radius[j] + SKIN
    close &= ~(fixed[i] & fixed[j])
    assert pairs == set(zip(i[close].tolist(), j[close].tolist(), strict=True))
    assert len(pairs) == len(one)
    assert (first < second).all()

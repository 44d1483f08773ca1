"""Claims about frictionless spheres at rest: a minimum of energy has three contacts a sphere."""

import numpy as np
import pytest

from reference_solutions.bulk import packing
from reference_solutions.checks.bulk import packing as least


@pytest.mark.parametrize("seed", [1, 2])
def test_the_minimum_of_energy_rests_on_three_contacts_a_sphere(seed: int) -> None:
    random, count = np.random.default_rng(seed), 12
    grid = np.stack(np.meshgrid(*map(np.arange, (2, 2, 3)), indexing="ij"), 3).reshape(-1, 3)
    radius, mass = 0.01 * random.uniform(0.8, 1.0, count), random.uniform(0.005, 0.01, count)
    x = 0.02 * (grid + 0.5) + 0.001 * random.uniform(-1, 1, (count, 3))
    contacts, floor = least.settled(x, radius, 9.81 * mass, 1e5, 0.044)
    assert contacts == pytest.approx(packing.CONTACTS, rel=0.03)
    assert floor == pytest.approx(packing.weight(mass, 9.81), rel=1e-4)


def test_the_forces_are_the_slope_of_the_energy() -> None:
    """Pairs, low and high walls and the floor are pressed, so that each part has its share."""
    random = np.random.default_rng(3)
    x, radius = random.uniform(0.002, 0.03, (20, 3)), random.uniform(0.008, 0.012, 20)
    law = (radius, random.uniform(0.05, 0.1, 20), 1e3, 0.032)
    _, _, pairs, walls = least.overlaps(x, radius, 0.032)
    assert (pairs > 0.0).any()
    assert (walls > 0.0).any(axis=0).all()
    flat, h = x.ravel(), 1e-8
    ahead, behind = ([least.energy(flat + way * h * e, *law)[0] for e in np.eye(flat.size)]
                     for way in (1.0, -1.0))  # fmt: skip
    slope = (np.array(ahead) - behind) / (2.0 * h)
    assert least.energy(flat, *law)[1] == pytest.approx(slope, abs=1e-6 * np.abs(slope).max())

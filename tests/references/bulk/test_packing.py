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

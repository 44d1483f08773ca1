"""Claims about the stable step of a sphere on which only drag acts."""

import math

import numpy as np
import pytest

from vv.engines import dem
from vv.scene import Contact, Scene, Spheres


@pytest.mark.parametrize(("mass", "eta"), [(1.0, 2.0), (3.0, 0.5)])
def test_drag_that_lags_is_stable_up_to_twice_the_mass_over_it(mass: float, eta: float) -> None:
    """v' = (1 - eta dt/m) v does not grow as long as eta dt/m is at most 2."""
    place, free = np.zeros((1, 3)), np.ones((1, 3), bool)
    sphere = Spheres(place, np.ones((1, 3)), np.ones(1), np.array([mass]), free)
    scene = Scene((sphere,), Contact(1.0), eta)
    assert dem.critical_step(scene, dem.LAGGED) == pytest.approx(2 * mass / eta, rel=1e-12)
    assert dem.critical_step(scene, dem.CENTRED) == math.inf

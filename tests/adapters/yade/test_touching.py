"""Claims about what YADE is given where a dashpot acts as soon as spheres touch."""

import numpy as np
import pytest

from adapters.yade.terms.contact import initial_viscous_forces
from vv.scene import Contact, Scene, Spheres

ETA, SPEED = 3.0, 0.5


@pytest.mark.parametrize(("gap", "acts"), [(-1e-6, True), (0.0, True), (1e-6, False)])
def test_spheres_that_touch_to_the_last_bit_are_a_contact(gap: float, acts: bool) -> None:
    x = np.array([1.0, 0.0, 0.0])
    pair = Spheres(
        position=np.outer([1.0 + gap, -1.0], x),
        velocity=np.outer([-SPEED, 0.0], x),
        radius=np.ones(2),
        mass=np.ones(2),
        free=np.ones((2, 3), bool),
    )
    force = initial_viscous_forces(Scene((pair,), Contact(1e3, eta_n=ETA)))
    due = ETA * SPEED * np.outer([1.0, -1.0], x) * acts
    np.testing.assert_allclose(force, due, rtol=1e-9)

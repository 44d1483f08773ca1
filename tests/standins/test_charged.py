"""Claims about the initial friction in springs that represent rigid contact."""

from __future__ import annotations

import numpy as np
import pytest

from vv.scene import Contact, Harmonic, Scene, Spheres, Wall
from vv.standins.penalty_springs import friction_at_start

AMPLITUDE, FREQUENCY, MASS, G = 0.01, 2.0, 3.0, 9.81
START = AMPLITUDE * (2 * np.pi * FREQUENCY) ** 2  # m/s2, 1.58: initial acceleration of the wall


@pytest.mark.parametrize(("mu", "carried"), [(0.9, START), (0.08, 0.08 * G)])
def test_what_rests_on_a_wall_that_begins_to_move_is_charged_with_what_carries_it_up_to_its_limit(
    mu: float, carried: float
) -> None:
    motion = Harmonic(np.array([AMPLITUDE, 0, 0]), np.full(3, FREQUENCY), np.full(3, -np.pi / 2))
    body = Spheres(np.array([[0.0, 0.0, 0.5]]), np.zeros((1, 3)), np.array([0.5]),
                   np.array([MASS]), np.ones((1, 3), bool))  # fmt: skip
    wall = Wall(np.zeros(3), np.array([0.0, 0.0, 1.0]), motion)
    scene = Scene((wall, body), Contact(np.inf, mu=mu), gravity=np.array([0.0, 0.0, -G]))
    carries = MASS * carried
    assert friction_at_start(scene)[0] == pytest.approx([carries, 0.0, 0.0], rel=1e-12, abs=1e-12)


def test_what_slips_is_charged_against_its_slip() -> None:
    body = Spheres(np.array([[0.0, 0.0, 0.5]]), np.array([[0.3, 0.4, 0.0]]), np.array([0.5]),
                   np.array([MASS]), np.ones((1, 3), bool))  # fmt: skip
    wall = Wall(np.zeros(3), np.array([0.0, 0.0, 1.0]))
    scene = Scene((wall, body), Contact(np.inf, mu=0.5), gravity=np.array([0.0, 0.0, -G]))
    limit = 0.5 * MASS * G
    assert friction_at_start(scene)[0] == pytest.approx([-0.6 * limit, -0.8 * limit, 0.0])

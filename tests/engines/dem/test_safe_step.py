"""Claims about the safe step of dem: it is stable where many contacts close, and not too small."""

from __future__ import annotations

from math import sqrt

import numpy as np
import pytest

from reference_solutions.bonds.close_packed_lattice import lattice
from reference_solutions.checks.bonds.bonded_modes import square
from vv.ask import Ask, Displacement, History, Knobs, Status
from vv.engines import dem
from vv.engines.dem.safe_step import PACKED
from vv.scene import Contact, Scene, Spheres


def closing() -> Scene:
    """A close-packed block of spheres without contacts that move towards its middle."""
    position = lattice(3, 2, 1, 2.0).position
    position = 1.001 * (position - position.mean(axis=0))
    count = len(position)
    spheres = Spheres(
        position,
        velocity=-position,
        radius=np.ones(count),
        mass=np.ones(count),
        free=np.ones((count, 3), bool),
    )
    return Scene((spheres,), Contact(1e6))


def end(scene: Scene, dt: float) -> Status:
    ask = Ask(scene, History(400 * dt, 5 * dt), (Displacement(0),), Knobs(dt))
    return dem.solve_default(ask).status


def test_a_pack_that_closes_is_stable_at_the_safe_step_and_not_near_the_limit_of_one_contact() -> (
    None
):
    scene, limit = closing(), dem.critical_step(closing(), dem.CENTRED)
    assert limit == pytest.approx(2 / sqrt(2e6), rel=1e-9)
    assert end(scene, dem.safe_step(scene, dem.CENTRED)) is Status.RAN
    assert end(scene, 0.95 * limit) is Status.DIVERGED


@pytest.mark.parametrize("gamma", [0.0, 5 / 29, 0.5, 1.0])
def test_no_close_packing_is_faster_than_the_safe_step_allows(gamma: float) -> None:
    waves = [np.array(k) / 8 for k in np.ndindex(9, 9, 5)]
    fastest = max(square(wave, gamma) for wave in waves)
    assert sqrt(2.0 / fastest) >= PACKED
    if gamma == 1.0:
        assert sqrt(2.0 / fastest) == pytest.approx(PACKED, rel=0.02)

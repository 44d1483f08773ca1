"""Claims about the shear spring of DEM's contacts when the contact plane rotates."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from vv.engines.dem.contact.friction import trial_force
from vv.engines.dem.contact.touch import Touch
from vv.engines.kernels.compiled import compiled
from vv.engines.kernels.triples import NOWHERE, Triple
from vv.scene import Vector


@compiled
def carried(spring: Triple, n: Triple, n_before: Triple, twist: float) -> Triple:
    """A spring after a step without slip in which the plane rotated."""
    touch = Touch(0.0, 0.0, n, n_before, n, (0.0, 0.0), NOWHERE, NOWHERE, twist)
    return trial_force(spring, touch, NOWHERE, 1.0)[2]


def least_turn(before: Vector, after: Vector) -> Rotation:
    """The rotation about an axis perpendicular to both that takes one direction to another."""
    axis = np.cross(before, after)
    angle = np.arctan2(np.linalg.norm(axis), before @ after)
    return Rotation.from_rotvec(angle * axis / np.linalg.norm(axis))


@given(st.integers(0, 2**32 - 1))
def test_a_shear_spring_turns_with_the_contact_plane(seed: int) -> None:
    before, after, any_way = np.random.default_rng(seed).normal(size=(3, 3))
    before, after = (n / np.linalg.norm(n) for n in (before, after))
    assume(before @ after > -0.9)
    spring = np.cross(before, any_way)
    told = carried(tuple(spring), tuple(after), tuple(before), 0.0)
    assert told == pytest.approx(least_turn(before, after).apply(spring), rel=1e-12, abs=1e-12)

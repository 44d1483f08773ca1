"""Claims about the measured impacts of aluminium oxide: the measurements are consistent."""

from __future__ import annotations

import math

import numpy as np
import pytest

from cases.impact.kharaz import (
    CASE,
    KEPT,
    READ_ANGLE,
    REBOUND,
    SCATTER_ANGLE,
    SCATTER_KEPT,
    SPIN,
)

GIVEN = CASE.defaults("hertz")
SLIDING = 25.0  # degrees from the normal; beyond it spheres slide throughout


def kept(angle: float) -> float:
    """The tangential restitution at an angle [degrees], interpolated between measurements."""
    return float(np.interp(angle, sorted(KEPT), [KEPT[one] for one in sorted(KEPT)]))


@pytest.mark.parametrize("angle", [one for one in KEPT if one > SLIDING])
def test_spheres_that_slide_throughout_lose_twice_the_friction_over_the_slope(
    angle: float,
) -> None:
    due = 1.0 - 2.0 * GIVEN["mu"] / math.tan(math.radians(angle))
    assert KEPT[angle] == pytest.approx(due, abs=2.0 * SCATTER_KEPT)


@pytest.mark.parametrize("angle", REBOUND)
def test_the_angle_of_rebound_is_that_of_the_tangential_restitution(angle: float) -> None:
    due = math.degrees(math.atan(kept(angle) * math.tan(math.radians(angle))))
    assert REBOUND[angle] == pytest.approx(due, abs=math.hypot(READ_ANGLE, SCATTER_ANGLE))


@pytest.mark.shows("shown beside what the loss of tangential momentum demands")
@pytest.mark.parametrize("angle", SPIN)
def test_spins_are_up_to_22_per_cent_off_what_angular_momentum_demands(angle: float) -> None:
    lost = (1.0 - kept(angle)) * GIVEN["v"] * math.sin(math.radians(angle))
    assert SPIN[angle] == pytest.approx(2.5 * lost / GIVEN["R"], rel=0.22)

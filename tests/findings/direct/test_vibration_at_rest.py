"""A block on undamped shear springs vibrates while it rests, and slides too far for it."""

import numpy as np
import pytest

from reference_solutions.blocks import incline
from tests.scenes.blocks.block_on_spring import frequency, slid, slope

DIP, FRICTION, GRAVITY, UNTIL = 45.0, 50.0, 9.81, 6.0  # deg, deg, m/s2, s
ALONG, ASIDE = (2.0, 1.0), (1.0, 2.0)  # m/s2, Hz


def error(kn: float, damping: float) -> float:
    """The error of the last place over the distance of the exact one."""
    on = slope(DIP, FRICTION, GRAVITY)
    place = np.array(slid(frequency(kn), 0.05, UNTIL, damping, on, ALONG, ASIDE))
    times = np.array([0.0, UNTIL])
    drive = {"ax": ALONG[0], "fx": ALONG[1], "ay": ASIDE[0], "fy": ASIDE[1]}
    exact = incline.two_directions(times, **drive, alpha=DIP, phi=FRICTION, g=GRAVITY)[-1]
    return float(np.linalg.norm(place - exact) / np.linalg.norm(exact))


@pytest.mark.shows(
    "an independent program with the same springs and no damping is 1.4e-4, 5.7e-5 and 2.4e-5 off "
    "at 1e9, 1e10 and 1e11 N/m"
)
@pytest.mark.parametrize(("kn", "off"), [(1e9, 1.4e-4), (1e10, 5.7e-5), (1e11, 2.4e-5)])
def test_undamped_vibration_at_rest_costs_more_than_a_stretch(kn: float, off: float) -> None:
    assert error(kn, 0.0) == pytest.approx(off, rel=0.05)


@pytest.mark.shows(
    "With the spring damped at rest, these errors are below 3.8e-6, 6.4e-7 and 1.5e-7"
)
@pytest.mark.parametrize(("kn", "most"), [(1e9, 3.8e-6), (1e10, 6.4e-7), (1e11, 1.5e-7)])
def test_without_that_vibration_the_slide_is_right(kn: float, most: float) -> None:
    assert error(kn, 0.4) < most

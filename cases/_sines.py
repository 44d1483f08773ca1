"""Converts the sines of closed forms to the prescribed motion of a scene."""

from collections.abc import Mapping

import numpy as np

from reference_solutions.contact.shaken_spring import Sine
from vv.scene import Harmonic, Vector

STILL = Sine(0.0, 0.0, 0.0)


def harmonic(sines: Mapping[int, Sine], axes: Vector) -> Harmonic:
    """Sines along some of the axes (3, 3), by their numbers."""
    amplitude, omega, phase = np.array([sines.get(i, STILL) for i in range(3)]).T
    return Harmonic(amplitude, omega / (2 * np.pi), phase, axes)

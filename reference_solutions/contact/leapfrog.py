"""The leapfrog on a harmonic oscillator: its phase is too fast, its discrete energy conserved.

m x'' = -k x, w^2 = k/m: v+ = v- - w^2 x dt, x+ = x + v+ dt. A step turns the phase by
2 asin(w dt/2), and m v- v+/2 + k x^2/2 stays as it is (Hairer, Lubich and Wanner 2003, Geometric
numerical integration illustrated by the Stoermer-Verlet method, Acta Numerica 12, 399-450). With
the mean velocity v = (v- + v+)/2 that is m v^2/2 + k (1 - (w dt/2)^2) x^2/2.
Every function raises ValueError for parameters outside their ranges.
"""

from math import asin

from reference_solutions.parameters import require_positive


def phase_per_step(angle: float) -> float:
    """The phase advance per step [rad]; angle = w dt [rad]."""
    return 2.0 * asin(_checked(angle) / 2.0)


def stiffness(angle: float) -> float:
    """The k in the conserved energy over that of the spring; angle = w dt [rad]."""
    return 1.0 - _checked(angle) ** 2 / 4.0


def _checked(angle: float) -> float:
    require_positive("rad", angle=angle)
    if angle >= 2.0:
        raise ValueError(f"angle = {angle} rad; from 2 on a leapfrog does not swing but grows")
    return angle

"""Phase advance and conserved energy of the leapfrog on a harmonic oscillator.

For m x'' = -k x, w^2 = k/m, a step is v+ = v- - w^2 x dt, x+ = x + v+ dt. It advances the phase by
2 asin(w dt/2), more than w dt, and conserves m v- v+/2 + k x^2/2 (Hairer, Lubich and Wanner 2003,
Geometric numerical integration illustrated by the Stoermer-Verlet method, Acta Numerica 12,
399-450). With the mean velocity v = (v- + v+)/2 this is m v^2/2 + k (1 - (w dt/2)^2) x^2/2. Every
function raises ValueError for parameters outside their ranges.
"""

from math import asin

from reference_solutions.parameters import require_positive


def phase_per_step(angle: float) -> float:
    """The phase advance per step [rad]; angle = w dt [rad]."""
    return 2.0 * asin(_checked(angle) / 2.0)


def stiffness(angle: float) -> float:
    """The stiffness in the conserved energy over k, 1 - (w dt/2)^2; angle = w dt [rad]."""
    return 1.0 - _checked(angle) ** 2 / 4.0


def _checked(angle: float) -> float:
    require_positive("rad", angle=angle)
    if angle >= 2.0:
        raise ValueError(f"angle = {angle} rad; from 2 on a leapfrog does not swing but grows")
    return angle

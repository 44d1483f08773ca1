"""The normal impact of two elastic bodies without friction (Hertz 1882).

The force is K U^(3/2) at the overlap U [m], with K = 4/3 E sqrt(R) [N/m^1.5], E [Pa] the effective
modulus and R [m] the effective radius. m [kg] is the reduced mass and v [m/s] the speed of
approach; the contact begins at t = 0. Every function raises ValueError for parameters outside their
ranges.
"""

from math import gamma, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_positive, require_times

Array = NDArray[np.float64]
BETA = gamma(0.4) * gamma(0.5) / gamma(0.9)  # B(2/5, 1/2)


def effective_modulus(young: float, poisson: float) -> float:
    """E [Pa] of a body in contact with a rigid one, 1/E = (1 - nu^2)/Young's modulus.

    For two elastic bodies, 1/E is the sum of their two terms.
    """
    return young / (1.0 - poisson**2)


def effective_shear_modulus(young: float, poisson: float) -> float:
    """G [Pa] of a body in contact with a rigid one, 1/G = (2 - nu)/shear modulus.

    For two elastic bodies, 1/G is the sum of their two terms.
    """
    return young / (2.0 * (1.0 + poisson) * (2.0 - poisson))


def normal_factor(*, modulus: float, radius: float) -> float:
    """K [N/m^1.5] of Fn = K U^(3/2), from effective modulus [Pa] and effective radius [m]."""
    require_positive("in SI units", modulus=modulus, radius=radius)
    return 4.0 / 3.0 * modulus * sqrt(radius)


def shear_factor(*, modulus: float, radius: float) -> float:
    """T [N/m^1.5] of Mindlin's stiffness without slip, T sqrt(U) (Mindlin 1949).

    modulus: effective shear modulus [Pa]; radius: effective radius [m].
    """
    require_positive("in SI units", modulus=modulus, radius=radius)
    return 8.0 * modulus * sqrt(radius)


def deepest(*, m: float, K: float, v: float) -> float:
    """The largest overlap U [m], at which 2/5 K U^(5/2) equals the initial energy m v^2/2."""
    require_positive("in SI units", m=m, K=K, v=v)
    return float((1.25 * m * v**2 / K) ** 0.4)


def largest_force(*, m: float, K: float, v: float) -> float:
    """The force [N] at the largest overlap."""
    return float(K * deepest(m=m, K=K, v=v) ** 1.5)


def contact_time(*, m: float, K: float, v: float) -> float:
    """The duration [s] of the contact, 4/5 B(2/5, 1/2) = 2.943 times U_max/v."""
    return 0.8 * BETA * deepest(m=m, K=K, v=v) / v


def overlap(t: ArrayLike, *, m: float, K: float, v: float) -> Array:
    """The overlap [m] at times t >= 0 [s] of any shape; it is negative after separation.

    t = U_max/v 2/5 B(x; 2/5, 1/2), the incomplete beta function of x = (U/U_max)^(5/2).
    """
    from scipy.special import betaincinv

    t, end = require_times(t), contact_time(m=m, K=K, v=v)
    half = np.clip(1.0 - np.abs(2.0 * t / end - 1.0), 0.0, 1.0)
    pressed = deepest(m=m, K=K, v=v) * betaincinv(0.4, 0.5, half) ** 0.4
    return np.where(t < end, pressed, -v * (t - end))

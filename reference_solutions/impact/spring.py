"""Quantities of an impact on a spring and a dashpot whose force is never tensile.

The path, restitution and duration are those of `reference_solutions.contact.dashpot`. Every
function raises ValueError for parameters outside their ranges.
"""

from math import acos, exp, pi, sin, sqrt

from reference_solutions.contact import dashpot
from reference_solutions.parameters import require_positive


def cleared(*, m: float, kn: float, z: float) -> float:
    """The time [s] at which the overlap ends; after the force ends, the speed is constant."""
    require_positive("in SI units", m=m, kn=kn)
    end = float(dashpot.overlap(dashpot.contact_time(m=m, kn=kn, z=z), m=m, kn=kn, z=z, v=1.0))
    return dashpot.contact_time(m=m, kn=kn, z=z) + end / dashpot.restitution(z)


def deepest(*, m: float, kn: float, z: float, v: float) -> float:
    """The largest overlap [m], reached at wd t = acos z."""
    require_positive("in SI units", m=m, kn=kn, v=v)
    return v * sqrt(m / kn) * _faded(z, acos(z))


def largest_force(*, m: float, kn: float, z: float, v: float) -> float:
    """The largest force [N], reached at wd t = 3 acos z - pi, or at t = 0 for z >= 1/2.

    Each derivative of sin(wd t) exp(-z w t) is w times larger and leads in phase by pi - acos z.
    """
    require_positive("in SI units", m=m, kn=kn, v=v)
    at = max(3.0 * acos(z) - pi, 0.0)
    size = v * sqrt(kn * m) / sqrt(1.0 - z * z)
    return size * _faded(z, at) * sin(at + pi - 2.0 * acos(z))


def damping(e: float) -> float:
    """The damping ratio z of a restitution e, the inverse of `restitution`."""
    from scipy.optimize import brentq

    most = 1.0 - 1e-12
    if not dashpot.restitution(most) < e <= 1.0:
        raise ValueError(f"e = {e}; it must lie in (0.1354, 1]")
    return (
        float(brentq(lambda z: dashpot.restitution(z) - e, 0.0, most, xtol=1e-16))
        if e < 1.0
        else 0.0
    )


def _faded(z: float, at: float) -> float:
    """The decay exp(-z w t) at the phase `at` = wd t."""
    if not 0.0 <= z < 1.0:
        raise ValueError(f"z = {z}; it must lie in [0, 1)")
    return exp(-z * at / sqrt(1.0 - z * z))

"""The oscillation of a confined unit after its base opens: what it breaks, and what remains."""

from __future__ import annotations

import math

from cases.bonds.tetrahedral_strength import RATES
from reference_solutions.bonds.confined_unit import Failure
from vv.case import Parameters


def require_sound(p: Parameters, failed: Failure, given: str) -> None:
    """Raise ValueError where inclined bonds fail in the oscillation after the base opens."""
    if not (most := failed.swung + _pressed_on(p, failed)) < 1.0:
        raise ValueError(
            f"{given}; the oscillation after the base opens loads inclined bonds to {most:.3g} of "
            "what they bear, so that they slide then"
        )
    if not failed.pulled < 1.0:
        raise ValueError(
            f"{given}; the oscillation after the base opens stretches inclined bonds to "
            f"{failed.pulled:.3g} xb, so that they open"
        )


def _pressed_on(p: Parameters, failed: Failure) -> float:
    """What the load of inclined bonds grows in a swing of the faster unit, over what they bear.

    The top comes down meanwhile, under which their load grows evenly until they slide.
    """
    swing = math.pi / _frequency(p) * RATES[0] * abs(p["rate"])
    return (1.0 - failed.after) * swing / (failed.opened - failed.strain)


def _frequency(p: Parameters) -> float:
    """The undamped frequency [1/s] of an open base under a top at rest.

    An inclined bond resists with kn sin^2 a + ks cos^2 a, sin a = 1/sqrt3.
    """
    return math.sqrt((p["kn"] + 2.0 * p["ks"]) / (3.0 * p["m"]))


def _damping(p: Parameters) -> float:
    """The damping of that oscillation, over the critical one."""
    return p["eta"] / (2.0 * p["m"] * _frequency(p))


def overshoot(p: Parameters) -> float:
    """How far the base swings beyond its new equilibrium, over its distance from it before."""
    z = _damping(p)
    return math.exp(-math.pi * z / math.sqrt(1.0 - z * z)) if z < 1.0 else 0.0


def swings(p: Parameters, failed: Failure) -> float:
    """What the oscillation after the base opens leaves in the extrapolated strength [Pa].

    It changes the pressure, and the load of inclined bonds, on which the pressure depends. Of the
    slower unit it leaves less, but that counts twice.
    """
    slope = (failed.pressure - failed.settled) / (1.0 - failed.after)
    most = abs(failed.held - failed.settled) + slope * abs(failed.before - failed.after)
    fast, slow = (_remaining_oscillation(p, failed, rate) for rate in RATES)
    return most * (fast + 2.0 * slow)


def _remaining_oscillation(p: Parameters, failed: Failure, rate: float) -> float:
    """The part of the oscillation after the base opens that viscosity leaves at failure.

    exp(-x)(1 + x), where x is time over that of decay: this holds for any damping.
    """
    z, late = _damping(p), (failed.opened - failed.strain) / (rate * abs(p["rate"]))
    x = _frequency(p) * late * (z if z <= 1.0 else 1.0 / (z + math.sqrt(z * z - 1.0)))
    return math.exp(-x) * (1.0 + x)

"""The oscillation of a confined unit after its base opens: what it breaks, and what remains."""

from __future__ import annotations

import math

from cases.bonds.parts._loading import RATES, lost
from cases.bonds.parts._quartzite import element_of
from cases.bonds.parts._unit import CORNERS
from reference_solutions.bonds import confined_unit
from reference_solutions.bonds.confined_unit import Failure
from vv.case import Parameters

DELAYED = 0.95  # of the strain at failure under viscosity, since the run goes on beyond


def require_largest(p: Parameters, load: float, given: str) -> None:
    """Raise ValueError unless inclined bonds slide at the largest pressure, under a load [N].

    Viscosity on the base of the faster unit is a load as well.
    """
    for more in (0.0, RATES[0] * drag_on_base(p)):
        failed = under(p, load + more)
        if not failed.pressure > failed.held:
            viscous = f", with {more:.4g} N of viscosity" if more else ""
            raise ValueError(
                f"{given}{viscous}; its bonds slide below the pressure that opens the base, at "
                f"{failed.pressure:.4g} Pa, which must be above {failed.held:.4g} Pa"
            )


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


def require_fall(p: Parameters, opened: float) -> None:
    """Raise ValueError where the pressure does not fall as the base opens, at a strain.

    It must lose half of what it loses at rest before the load makes up for that: within half a
    swing, or within the time in which a motion under stronger viscosity decays.
    """
    swing = math.pi / _frequency(p) * max(1.0, _damping(p, _frequency(p)))
    grows, falls = RATES[0] * abs(p["rate"]) * swing / opened, 0.5 * lost(p)
    if not grows < falls:
        raise ValueError(
            f"rate = {p['rate']:.6g} 1/s: as the base opens, the pressure grows by {grows:.3g} of "
            f"itself in half a swing, and hides its fall; that must be below {falls:.3g}"
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


def _damping(p: Parameters, frequency: float) -> float:
    """The damping of an oscillation [1/s], over the critical one."""
    return p["eta"] / (2.0 * p["m"] * frequency)


def overshoot(p: Parameters) -> float:
    """How far the base swings beyond its new equilibrium, over its distance from it before."""
    z = _damping(p, _frequency(p))
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
    """The part of the oscillation after the base opens that viscosity leaves at failure."""
    late = (failed.opened - failed.strain) / (rate * abs(p["rate"]))
    return remaining(p, _frequency(p), late)


def remaining(p: Parameters, frequency: float, late: float) -> float:
    """The part of an oscillation [1/s] that viscosity leaves after a time [s].

    exp(-x)(1 + x), where x is time over that of decay: this holds for any damping.
    """
    z = _damping(p, frequency)
    x = frequency * late * (z if z <= 1.0 else 1.0 / (z + math.sqrt(z * z - 1.0)))
    return math.exp(-x) * (1.0 + x)


def under(p: Parameters, load: float) -> Failure:
    """The failure of a unit in equilibrium under inward loads [N] on its base."""
    return confined_unit.sliding_failure(element_of(p), p["d"], load, overshoot(p))


def hurried(p: Parameters, load: float, failed: Failure) -> float:
    """The most [Pa] that viscosity leaves in the strength that is extrapolated from RATES.

    load: on the base [N]. The top comes down at v, and an open base moves outwards at u, at which
    an inclined bond keeps its horizontal balance: kn (v cos a - u sin a) sin a = ks (u cos a + v
    sin a) cos a. With sin a = 1/sqrt3 that is u = v (1 - g) sqrt2/(1 + 2 g), g = ks/kn. Viscosity
    eta u on the base is a load as well, of which the strength is no linear function. Twice what the
    extrapolation leaves of the strength under it is allowed, since u also changes along the path.
    It is stated to three digits: of a difference of strengths that are solved to 1e-13 of their
    size, processors find other digits after these.
    """
    drag = drag_on_base(p)
    fast, slow = (under(p, load + rate * drag).pressure for rate in RATES)
    due = slow + (slow - fast) / (RATES[0] / RATES[1] - 1.0)
    return float(f"{2.0 * (due - failed.pressure):.3g}")


def late_strain(p: Parameters, load: float, strain: float) -> float:
    """The strain at which the last unit fails, under a load [N] on its base; strain: without drag.

    Viscosity on the base delays the failure.
    """
    return max(abs(strain), DELAYED * abs(under(p, load + drag_on_base(p)).strain))


def drag_on_base(p: Parameters) -> float:
    """Viscosity [N] on an element of an open base, in the slower unit: see `hurried`."""
    g, speed = p["ks"] / p["kn"], abs(p["rate"]) * p["d"] * CORNERS[0, 2]
    return float(p["eta"] * speed * abs(1.0 - g) * math.sqrt(2.0) / (1.0 + 2.0 * g))

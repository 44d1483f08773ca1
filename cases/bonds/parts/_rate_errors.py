"""What steady loading at two rates leaves in a strength that is extrapolated to zero rate.

A base element at the radius r obeys m r'' = -k (r - r_e) - eta r', where r_e is its equilibrium
under the top and k its stiffness. It follows r_e with the distances -(eta/k) r_e', which the
extrapolation removes as it is proportional to the rate, and -(m/k - eta^2/k^2) r_e'', which is as
the square of the rate, so that the extrapolation leaves twice that of the slower unit, of opposite
sign. As strains grow, k and the speed r_e' change by about the strain, and the first distance by
(eta/k)^2 r_e' times the rate. Viscosity and inertia begin at t = 0 at once, so that r also
oscillates from there on by those distances, which decay.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from cases.bonds.parts import _detour
from cases.bonds.parts._loading import EVERY, RATES
from cases.bonds.parts._open_base import remaining
from cases.bonds.parts._unit import CORNERS
from reference_solutions.bonds import lattice_material, tetrahedral_unit
from reference_solutions.bonds.tetrahedral_unit import State
from vv.case import Parameters
from vv.scene import Vector

RADIUS = float(np.hypot(*CORNERS[1, :2]))  # of the base, in diameters
SPARE = 2.0  # for the numbers near one that multiply these distances
LEFT = float(RATES[0] ** 2 + 2.0 * RATES[1] ** 2)  # of unsigned errors as the square of the rate
BACK = 0.05  # of the strain at failure: how far before it the curvature of the stress is taken


def bonded(p: Parameters, failed: State, which: Vector, stretch: float) -> float:
    """The relative error of the stress at which a bond of a unit with its base is overstretched.

    failed: the state there; which: the stretch of that bond by (u, r); stretch: that stretch [m]. A
    distance y of the base changes the force by K_ur y, and moves the top at failure by as much as
    the bond is stretched by y.
    """
    springs = _detour.stiffness(p["kn"], p["ks"])
    k, rate = springs[1, 1] / _detour.MOVED[1], abs(p["rate"])
    weight = abs(springs[0, 1] / failed.fz - which[1] / stretch)
    out = RADIUS * p["d"]
    bent = 2.0 * abs(tetrahedral_unit.poisson_slope(p["ks"] / p["kn"])) * out * rate**2
    nu = abs(lattice_material.poissons_ratio(p["kn"], p["ks"]))
    slow, lag = p["eta"] / k, p["eta"] / k * nu * out * rate
    shift = (p["m"] / k + slow**2) * bent + slow * lag * rate
    steady = 2.0 * SPARE * shift
    started = sum(
        share * (lag * times + shift * times**2)
        * remaining(p, math.sqrt(k / p["m"]), abs(failed.strain) / (times * rate))
        for times, share in zip(RATES, (1.0, RATES[0] / RATES[1]), strict=True)
    )  # fmt: skip
    return float(weight * (steady + started))


def opened(p: Parameters, strain: float, at: Callable[[float], State], slope: float) -> float:
    """The error [Pa] by inertia of the pressure at which an open base lets inclined bonds slide.

    at: the state at a strain; slope: the pressure by a load on the base [Pa/N]. Inertia m r'' is
    such a load, and viscosity one of eta^2/k r'' as the square of the rate.
    """
    k = (p["kn"] + 2.0 * p["ks"]) / 3.0
    h = BACK * strain
    lateral = [at(strain + step).lateral for step in (-h, 0.0, h)]
    bent = abs(lateral[0] - 2.0 * lateral[1] + lateral[2]) / h**2
    load = (p["m"] + p["eta"] ** 2 / k) * bent * RADIUS * p["d"] * p["rate"] ** 2
    return 2.0 * SPARE * slope * load


def between_outputs(p: Parameters, borne: Vector, stress: Vector, strain: Vector) -> float:
    """The error [Pa] of a stress that is extrapolated from the last two outputs before a failure.

    borne: the load of a bond over its strength in three states before the failure, the last of
    which is that at 1. An extrapolation over one output errs by its second difference times the
    distances to both outputs.
    """
    slopes = np.diff(stress) / np.diff(borne)
    curved = abs(slopes[1] - slopes[0]) / abs(borne[2] - borne[0])
    pace = (borne[2] - borne[1]) / (strain[2] - strain[1]) * p["rate"] * EVERY
    return float(2.0 * LEFT * curved * pace**2)

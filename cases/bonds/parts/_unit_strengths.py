"""The strengths of a unit of four, and how far each may be off when extrapolated to zero rate."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np

from cases.bonds.parts import _detour, _rate_errors
from cases.bonds.parts import _open_base as open_base
from cases.bonds.parts._loading import APART, FINEST, RATES, coarsest
from cases.bonds.parts._quartzite import element_of
from cases.bonds.parts._rate_errors import BACK
from reference_solutions.bonds import tetrahedral_unit
from reference_solutions.bonds.lattice_material import Element
from reference_solutions.bonds.tetrahedral_unit import State
from vv.case import Parameters
from vv.scene import Vector

ROUNDS = 5e-9  # of a strength: the rounding of coordinates, at least
NUDGE = 1e-3  # of what shears a bond: a load that shows how the strength grows with loads


class Strength(NamedTuple):
    """The state in which a unit fails, and the bound of the relative error of its stress.

    late: what is added per step [1/s] by schemes that use the length of a bond at its end.
    """

    state: State
    bound: float
    late: float = 0.0


def tension(p: Parameters) -> Strength:
    """Inclined bonds open."""
    return _while_bonded(p, tetrahedral_unit.tension_failure, _detour.ALONG)


def opening(p: Parameters) -> Strength:
    """The bonds of the base open."""
    return _while_bonded(p, tetrahedral_unit.opening_failure, _detour.RIM)


def sliding(p: Parameters) -> Strength:
    """Inclined bonds slide, after the base has opened."""
    element, d = element_of(p), p["d"]
    failed = tetrahedral_unit.sliding_failure(element, d)
    free = open_base.under(p, 0.0)
    load = NUDGE * p["fs0"]
    slope = abs(open_base.under(p, load).pressure - free.pressure) / load

    def at(strain: float) -> State:
        return tetrahedral_unit.opened(strain, element, d)

    def borne(state: State) -> float:
        return (p["ks"] * abs(state.x.xs1) + p["mu_p"] * p["kn"] * state.x.xn1) / p["fs0"]

    before = [at((1.0 - back) * failed.strain) for back in (2.0 * BACK, BACK)]
    off = (
        abs(open_base.hurried(p, 0.0, free))
        + open_base.swings(p, free)
        + _rate_errors.opened(p, failed.strain, at, slope)
        + _sampled(p, [(borne(state), state) for state in (*before, failed)])
    )
    late = 1.1 * _turned_late(p, failed.strain)
    return Strength(failed, off / abs(failed.stress) + ROUNDS, late)


def _turned_late(p: Parameters, strain: float) -> float:
    """What lengths of the end of a step change of the strength by sliding, per step [1/s].

    strain: at failure. A shear spring gains l' s'/2L more per step, as in `_detour`, which adds up
    as the base widens after it opens, by y: viscosity or the end of the run bounds the integral of
    y'^2. Balance of an open base ties shear and stretch, so that the stress changes only as bonds
    slide after less rotation: it is 3 fs0/(sin a - mu cos a) over the area.
    """
    element, d, mu = element_of(p), p["d"], p["mu_p"]
    before = tetrahedral_unit.opening_failure(element, d)
    after = tetrahedral_unit.opened(before.strain, element, d)
    y = (after.lateral - before.lateral) * _rate_errors.RADIUS * d
    lasts = (abs(strain) - abs(before.strain)) / abs(p["rate"])
    swung = (p["kn"] + 2.0 * p["ks"]) / 3.0 * y**2 / (2.0 * max(p["eta"], p["m"] / lasts))
    sooner = abs(_detour.ALONG[1] * _detour.ACROSS[1]) * swung / (2.0 * d**2)
    return float(sooner * (np.sqrt(2.0) + mu) / (1.0 - np.sqrt(2.0) * mu))


def _while_bonded(
    p: Parameters, fails: Callable[[Element, float], State], which: Vector
) -> Strength:
    """A bond of the unit with its base opens; which: its stretch by (u, r)."""
    element, d, xb = element_of(p), p["d"], p["xb"]
    parts = (1.0 - 2.0 * BACK, 1.0 - BACK, 1.0)
    path = [(part, fails(element._replace(xb=part * xb), d)) for part in parts]
    failed = path[-1][1]
    off = _sampled(p, path) / abs(failed.stress)
    rounded = max(ROUNDS, _rounded(p, abs(failed.strain), which))
    return Strength(failed, off + _rate_errors.bonded(p, failed, which, xb) + rounded)


def _rounded(p: Parameters, strain: float, which: Vector) -> float:
    """The error by rounding of positions at each step, at the finest step; strain: at failure.

    which: the stretch by (u, r) of the bond that fails. Shear springs add up displacements before
    these are rounded. An element that hardly moves in a step may be rounded the same way at every
    step, by half a rounding at its distance from the origin, where the slower unit is.
    """
    steps = strain / abs(p["rate"]) / (coarsest(p) / FINEST)
    units = zip((APART, 1.0), RATES, (1.0, RATES[0] / RATES[1]), strict=True)
    places = sum(share * where / times for where, times, share in units)
    slipped = 2.0**-53 * places * p["d"] * steps * abs(_detour.ACROSS[1])
    springs = _detour.stiffness(p["kn"], p["ks"])
    off = np.linalg.solve(springs, 3.0 * p["ks"] * slipped * _detour.ACROSS)
    return float(abs(which @ off) / p["xb"])


def _sampled(p: Parameters, path: Iterable[tuple[float, State]]) -> float:
    """The error [Pa] by outputs; path: the load of a bond over its strength, and states."""
    borne, states = zip(*path, strict=True)
    stress, strain = (np.array([getattr(one, of) for one in states]) for of in ("stress", "strain"))
    return _rate_errors.between_outputs(p, np.array(borne), stress, strain)

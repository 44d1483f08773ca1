"""The strengths of a unit of four, and how far each may be off when extrapolated to zero rate."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np

from cases.bonds.parts import _detour, _rate_errors
from cases.bonds.parts import _open_base as open_base
from cases.bonds.parts._quartzite import element_of
from cases.bonds.parts._rate_errors import BACK
from reference_solutions.bonds import tetrahedral_unit
from reference_solutions.bonds.lattice_material import Element
from reference_solutions.bonds.tetrahedral_unit import State
from vv.case import Parameters
from vv.scene import Vector

ROUNDS = 5e-9  # of a strength: the rounding of coordinates
NUDGE = 1e-3  # of what shears a bond: a load that shows how the strength grows with loads


class Strength(NamedTuple):
    """The state in which a unit fails, and the bound of the relative error of its stress."""

    state: State
    bound: float


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
    return Strength(failed, off / abs(failed.stress) + ROUNDS)


def _while_bonded(
    p: Parameters, fails: Callable[[Element, float], State], which: Vector
) -> Strength:
    """A bond of the unit with its base opens; which: its stretch by (u, r)."""
    element, d, xb = element_of(p), p["d"], p["xb"]
    parts = (1.0 - 2.0 * BACK, 1.0 - BACK, 1.0)
    path = [(part, fails(element._replace(xb=part * xb), d)) for part in parts]
    failed = path[-1][1]
    off = _sampled(p, path) / abs(failed.stress)
    return Strength(failed, off + _rate_errors.bonded(p, failed, which, xb) + ROUNDS)


def _sampled(p: Parameters, path: Iterable[tuple[float, State]]) -> float:
    """The error [Pa] by outputs; path: the load of a bond over its strength, and states."""
    borne, states = zip(*path, strict=True)
    stress, strain = (np.array([getattr(one, of) for one in states]) for of in ("stress", "strain"))
    return _rate_errors.between_outputs(p, np.array(borne), stress, strain)

"""A closed contact and how it came to be so in a step: what a law of contacts is told."""

from __future__ import annotations

from typing import NamedTuple

from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import Triple
from vv.scene import Vector


class Touch(NamedTuple):
    """A contact at the end of a step.

    overlap: now [m], opened: how much less than before the step. n, n_before, midway: the normal
    now, before the step, and at its middle. rates: how fast the gap opens before and now [m/s], by
    the velocities of two steps. relative: velocity of the surfaces at the contact in
    the step [m/s], changed: that less the one of the step before. twist: how far the surfaces
    turned about the normal [rad]; None if no sphere turns.
    """

    overlap: float
    opened: float
    n: Triple
    n_before: Triple
    midway: Triple
    rates: tuple[float, float]
    relative: Triple
    changed: Triple
    twist: float | None


@inlined
def reduced_mass(mass: Vector, i: int, j: int) -> float:
    """1/(1/m1 + 1/m2) [kg] of two rows, of which those beyond the masses (m,) cannot move."""
    inverse = 0.0
    if i < len(mass):
        inverse += 1.0 / mass[i]
    if j < len(mass):
        inverse += 1.0 / mass[j]
    return 1.0 / inverse

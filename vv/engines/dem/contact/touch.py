"""The kinematics of a closed contact over one step, from which contact laws compute forces."""

from __future__ import annotations

from typing import NamedTuple

from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import Triple
from vv.scene import Vector


class Touch(NamedTuple):
    """The state of a closed contact at the end of a step, and its change within the step.

    overlap: at the end of the step [m]; opened: its decrease within the step [m]. n, n_before,
    midway: the unit normal at the end, at the beginning and in the middle of the step. rates:
    opening rates [m/s] at the beginning and at the end, extrapolated from the mean velocities of
    two steps. relative: mean relative velocity of the surfaces [m/s]; changed: its difference from
    that of the previous step. twist: relative rotation about the normal [rad]; None if no sphere
    rotates.
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
    """The reduced mass 1/(1/m1 + 1/m2) [kg] of rows i and j; rows not in mass are fixed."""
    inverse = 0.0
    if i < len(mass):
        inverse += 1.0 / mass[i]
    if j < len(mass):
        inverse += 1.0 / mass[j]
    return 1.0 / inverse

"""The spheres of the bulk model as rows of numbers, sorted by cells."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import inlined, inlined_called
from vv.engines.kernels.triples import Triple
from vv.scene import Vector

Short = npt.NDArray[np.uint32]
Flags = npt.NDArray[np.uint8]
RADIUS, V, W, BEFORE, SPUN, WIDE = 3, 4, 7, 10, 13, 16
TURN, ACTS = 3, 8


class Given(NamedTuple):
    """The n spheres at t = 0: position, velocity (n, 3), spin (n, 3), radius, mass, inertia (n,).

    spin is None if none rotates; mass and inertia of fixed spheres are inf.
    """

    position: Vector
    velocity: Vector
    spin: Vector | None
    radius: Vector
    mass: Vector
    inertia: Vector


@bundle
class Grains(NamedTuple):
    """n spheres in an order that changes, and a row for the ground, which is at rest.

    row (n + 1, 16): position [m], radius [m], mean velocity [m/s] and spin [1/s] of the last step,
    and those of the step before it. acting (2 n + 2, 8): force [N] and torque [N m] on each, two
    unused numbers, and as many spare rows for forces from other chunks. mass, inertia (n,), inf for
    fixed spheres; original (n,): their numbers in the scene; since (n, 3): positions at the last
    neighbour search.
    """

    row: Vector
    acting: Vector
    mass: Vector
    inertia: Vector
    original: Short
    since: Vector


@inlined_called
def initial_grains(given: Given) -> Grains:
    """The spheres at t = 0, in the order of the scene."""
    n = len(given.mass)
    row, since, original = np.zeros((n + 1, WIDE)), np.zeros((n, 3)), np.empty(n, np.uint32)
    for i in range(n):
        for c in range(3):
            row[i, c] = given.position[i, c]
        row[i, RADIUS], original[i] = given.radius[i], i
    mass, inertia = given.mass.copy(), given.inertia.copy()
    return Grains(row, np.zeros((2 * n + 2, ACTS)), mass, inertia, original, since)


@inlined
def moving_mass(mass: float) -> float:
    """The mass [kg], or inertia, that has weight and kinetic energy: zero for fixed spheres."""
    return mass if mass < np.inf else 0.0


@inlined
def columns_of(row: Vector, i: int, first: int) -> Triple:
    """Three columns of row i of an array, from `first` on."""
    return row[i, first], row[i, first + 1], row[i, first + 2]


@inlined
def set_columns(row: Vector, i: int, first: int, a: Triple) -> None:
    """Set three columns of row i of an array, from `first` on."""
    row[i, first], row[i, first + 1], row[i, first + 2] = a

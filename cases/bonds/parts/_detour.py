"""The part of an incremental shear spring that depends on how the loaded unit came to rest.

The unit oscillates in two modes: the top rises by u, the base spreads by r. A shear spring changes
by S' = -L a', with the length L and the angle a of its bond. To second order in the displacements
that is l s'/L more than its ends move, with the stretch l and the displacement s across the bond.
On the slow path of the exact answer this adds up to l s/2L; on the path of the oscillation it adds
up to another number, which the spring keeps.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from vv.case import Parameters
from vv.scene import Vector

ALONG, ACROSS = np.array(
    [[np.sqrt(2 / 3), np.sqrt(1 / 3)], [np.sqrt(1 / 3), -np.sqrt(2 / 3)]]
)  # directions of an inclined bond in (u, r)
RIM = np.array([0.0, np.sqrt(3)])  # stretch of a level bond
MOVED = np.array([1.0, 3.0])  # number of elements that u and r move


def stiffness(kn: float, ks: float) -> Vector:
    """The stiffness (2, 2) [N/m] in (u, r): three inclined bonds and three level ones."""
    springs = ((kn, ALONG), (ks, ACROSS), (kn, RIM))
    return np.asarray(sum(3 * k * np.outer(way, way) for k, way in springs))


class RestErrors(NamedTuple):
    """Errors of a quantity at rest over its scale: kept at any step, late at the step dt [s]."""

    kept: float
    late: float
    dt: float


def rest_errors(p: Parameters, ks: float, fz: float, dt: float) -> Mapping[str, RestErrors]:
    """The errors of each quantity at rest after a load Fz [N] applied at once, at a step dt [s].

    late: of schemes that use the length of a bond at the end of a step, half a step late.
    """
    bonds = stiffness(p["kn"], ks)
    rest = np.asarray(np.linalg.solve(bonds, [fz, 0.0]), np.float64)
    swung = _integrals(bonds / (p["m"] * MOVED[:, None]), p["eta"] / p["m"], rest)
    slow = (ALONG @ rest) * (ACROSS @ rest) / 2
    lengths = (slow + ALONG @ swung[:2, 2:] @ ACROSS, dt / 2 * ALONG @ swung[2:, 2:] @ ACROSS)
    each = [
        _relative_errors(rest, np.linalg.solve(bonds, -3 * ks * one / p["d"] * ACROSS))
        for one in lengths
    ]
    return {name: RestErrors(kept, each[1][name], dt) for name, kept in each[0].items()}


def _relative_errors(rest: Vector, off: Vector) -> Mapping[str, float]:
    """The relative error of each quantity at rest by an error (2,) [m] of (u, r)."""
    errors = {"X_n1": ALONG @ off, "X_s1": ACROSS @ off, "X_n2": RIM @ off, "dz": off[0]}
    shares = {name: abs(float(value / rest[0])) for name, value in errors.items()}
    ratio = np.sqrt(2) * (off[1] - rest[1] * off[0] / rest[0]) / rest[0]
    return {**shares, "E": shares["dz"], "nu": abs(float(ratio)) / 0.2}


def _integrals(rates: Vector, damping: float, start: Vector) -> Vector:
    """(4, 4): integrals over all times of products of (y, y'), y'' = -rates y - damping y'."""
    matrix = np.block([[np.zeros((2, 2)), np.eye(2)], [-rates, -damping * np.eye(2)]])
    z, same = np.array([*start, 0.0, 0.0]), np.eye(4)
    both = np.kron(matrix, same) + np.kron(same, matrix)  # Lyapunov's equation
    return np.asarray(np.linalg.solve(both, -np.outer(z, z).ravel()).reshape(4, 4))

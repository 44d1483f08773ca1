"""The part of an incremental shear spring that depends on how the loaded unit came to rest.

The unit swings in two modes: the top rises by u, the base spreads by r. A shear spring grows by
S' = -L a' with the length L of its bond: to second order in the displacements by l s'/L beyond
what its ends moved, l the stretch and s the way across. On the slow path of the exact answer that
adds up to l s/2L; on the way that the modes take it is another number, which the spring keeps.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from vv.case import Parameters
from vv.scene import Vector

ALONG, ACROSS = np.array(
    [[np.sqrt(2 / 3), np.sqrt(1 / 3)], [np.sqrt(1 / 3), -np.sqrt(2 / 3)]]
)  # of an inclined bond, by (u, r)
RIM = np.array([0.0, np.sqrt(3)])  # stretch of a level bond
MOVED = np.array([1.0, 3.0])  # elements that u and r move


def stiffness(kn: float, ks: float) -> Vector:
    """(2, 2) [N/m] of (u, r): three inclined bonds and three level ones."""
    springs = ((kn, ALONG), (ks, ACROSS), (kn, RIM))
    return np.asarray(sum(3 * k * np.outer(way, way) for k, way in springs))


class Off(NamedTuple):
    """Errors of a quantity at rest, of its scale: at any step, and what is late at dt [s]."""

    kept: float
    late: float
    dt: float


def left_off(p: Parameters, ks: float, fz: float, dt: float) -> Mapping[str, Off]:
    """By how much each quantity is off at rest after a load Fz [N] at once, at a step dt [s].

    late: where the length of a bond is that of a step's end, half a step late.
    """
    bonds = stiffness(p["kn"], ks)
    rest = np.asarray(np.linalg.solve(bonds, [fz, 0.0]), np.float64)
    swung = _swung(bonds / (p["m"] * MOVED[:, None]), p["eta"] / p["m"], rest)
    slow = (ALONG @ rest) * (ACROSS @ rest) / 2
    lengths = (slow + ALONG @ swung[:2, 2:] @ ACROSS, dt / 2 * ALONG @ swung[2:, 2:] @ ACROSS)
    each = [
        _relative_errors(rest, np.linalg.solve(bonds, -3 * ks * one / p["d"] * ACROSS))
        for one in lengths
    ]
    return {name: Off(kept, each[1][name], dt) for name, kept in each[0].items()}


def _relative_errors(rest: Vector, off: Vector) -> Mapping[str, float]:
    """The relative error of each quantity that an error (2,) [m] of (u, r) at rest makes."""
    errors = {"X_n1": ALONG @ off, "X_s1": ACROSS @ off, "X_n2": RIM @ off, "dz": off[0]}
    shares = {name: abs(float(value / rest[0])) for name, value in errors.items()}
    ratio = np.sqrt(2) * (off[1] - rest[1] * off[0] / rest[0]) / rest[0]
    return {**shares, "E": shares["dz"], "nu": abs(float(ratio)) / 0.2}


def _swung(rates: Vector, damping: float, start: Vector) -> Vector:
    """(4, 4): integrals over all times of products of (y, y'), y'' = -rates y - damping y'."""
    matrix = np.block([[np.zeros((2, 2)), np.eye(2)], [-rates, -damping * np.eye(2)]])
    z, same = np.array([*start, 0.0, 0.0]), np.eye(4)
    both = np.kron(matrix, same) + np.kron(same, matrix)  # Lyapunov's equation
    return np.asarray(np.linalg.solve(both, -np.outer(z, z).ravel()).reshape(4, 4))

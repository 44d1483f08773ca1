"""Kernels for rotations: the exponential map, and inertia in the scene's frame."""

from __future__ import annotations

import numpy as np

from vv.engines.kernels.arrays import same_rows, zero_squares
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import Triple, dot
from vv.scene import Vector


@lent
def turn_by(angle: Triple, rotation: Vector, out: Vector) -> None:
    """Fill out (3, 3) with exp(angle x) rotation for a rotation vector [rad] (Rodrigues)."""
    square = dot(angle, angle)
    size = np.sqrt(square)
    sine = np.sin(size) / size if size > 0.0 else 0.0  # which zero angles multiply
    half = np.sin(0.5 * size) / size if size > 0.0 else 0.0
    versine = 2.0 * half * half
    x, y, z = angle
    a00, a01, a02 = 1.0 - versine * (y * y + z * z), versine * x * y - sine * z, 0.0
    a02 = versine * x * z + sine * y
    a10, a11, a12 = versine * x * y + sine * z, 1.0 - versine * (x * x + z * z), 0.0
    a12 = versine * y * z - sine * x
    a20, a21 = versine * x * z - sine * y, versine * y * z + sine * x
    a22 = 1.0 - versine * (x * x + y * y)
    for c in range(3):
        r0, r1, r2 = rotation[0, c], rotation[1, c], rotation[2, c]
        out[0, c] = a00 * r0 + a01 * r1 + a02 * r2
        out[1, c] = a10 * r0 + a11 * r1 + a12 * r2
        out[2, c] = a20 * r0 + a21 * r1 + a22 * r2


@called
def orthonormal(rotation: Vector) -> None:
    """Remove rounding from a rotation (3, 3) by one Newton step for its polar factor."""
    r = same_rows(rotation, 3)
    for i in range(3):
        for j in range(3):
            gram = 0.0
            for k in range(3):
                inner = r[0, k] * r[0, j] + r[1, k] * r[1, j] + r[2, k] * r[2, j]
                gram += r[i, k] * ((3.0 if k == j else 0.0) - inner)
            rotation[i, j] = 0.5 * gram


@lent
def turned_inertia(inertia: Vector, rotation: Vector, out: Vector) -> None:
    """Fill out with rotation inertia rotation^T, all (3, 3)."""
    for i in range(3):
        for j in range(3):
            total = 0.0
            for k in range(3):
                for m in range(3):
                    total += rotation[i, k] * inertia[k, m] * rotation[j, m]
            out[i, j] = total


@called
def held_inverse(inertia: Vector, hold: Vector, out: Vector) -> None:
    """Fill out (3, 3) with the inverse of the inertia in the free directions, zero in the others.

    hold: (3, 3) projector on the free directions. The projected inertia plus its trace times the
    projector on the locked directions is inverted, and the inverse is projected.
    """
    trace = inertia[0, 0] + inertia[1, 1] + inertia[2, 2]
    a = zero_squares(1)[0]
    for i in range(3):
        for j in range(3):
            for k in range(3):
                for m in range(3):
                    a[i, j] += hold[i, k] * inertia[k, m] * hold[m, j]
            a[i, j] += trace * ((1.0 if i == j else 0.0) - hold[i, j])
    for i in range(3):
        for j in range(3):
            p, q, r, s = (j + 1) % 3, (j + 2) % 3, (i + 1) % 3, (i + 2) % 3
            out[i, j] = a[p, r] * a[q, s] - a[p, s] * a[q, r]
    determinant = a[0, 0] * out[0, 0] + a[0, 1] * out[1, 0] + a[0, 2] * out[2, 0]
    for i in range(3):
        for j in range(3):
            a[i, j] = out[i, j] / determinant
    for i in range(3):
        for j in range(3):
            out[i, j] = 0.0
            for k in range(3):
                for m in range(3):
                    out[i, j] += hold[i, k] * a[k, m] * hold[m, j]

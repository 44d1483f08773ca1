"""Kernels on matrices (3, 3): products, and the exponential."""

from __future__ import annotations

from vv.engines.kernels.arrays import rows
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import Triple, at, dot, put
from vv.scene import Vector


@lent
def times_vector(matrix: Vector, a: Triple) -> Triple:
    """The product of a matrix (3, 3) and the vector a."""
    return dot(at(matrix, 0), a), dot(at(matrix, 1), a), dot(at(matrix, 2), a)


@lent
def moment_product(second: Vector, one: Vector, two: Vector) -> float:
    """The integral of rho (one r) . (two r) [kg m2]: tr(one second two^T) of slopes (3, 3)."""
    total = 0.0
    for r in range(3):
        total += dot(times_vector(second, at(one, r)), at(two, r))
    return total


@called
def congruent(out: Vector, whole: Vector, second: Vector) -> None:
    """Fill out (3, 3) with whole second whole^T; out may be second, which is symmetric."""
    half = rows(3)
    for r in range(3):
        put(half, r, times_vector(whole, at(second, r)))
    for r in range(3):
        put(out, r, times_vector(whole, (half[0, r], half[1, r], half[2, r])))


@called
def fill_exponential(whole: Vector, slope: Vector, terms: int) -> None:
    """Fill whole (3, 3): the exponential series of slope (3, 3), to `terms` terms."""
    old = rows(3)
    for r in range(3):
        for c in range(3):
            whole[r, c] = 1.0 if r == c else 0.0
    for k in range(terms, 0, -1):
        for r in range(3):
            put(old, r, at(whole, r))
        for r in range(3):
            for c in range(3):
                total = 0.0
                for m in range(3):
                    total += slope[r, m] * old[m, c]
                whole[r, c] = total / k + (1.0 if r == c else 0.0)

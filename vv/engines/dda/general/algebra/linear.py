"""Solvers for matrices stored in a profile: symmetric positive definite, or any; kernels."""

from __future__ import annotations

from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import larger
from vv.engines.kernels.compiled import lent
from vv.scene import Vector


@lent
def factorise(matrix: Vector, first: Index) -> None:
    """Replace the lower half of matrix (q, q) by L D L^T; first: (q,) the first column of each row.

    The diagonal becomes D, the part left of it L (Jennings and McKeown 1992, Sec. 4.6).
    """
    for i in range(len(first)):
        row = matrix[i]
        for j in range(first[i], i):
            other = matrix[j]
            total = row[j]
            for k in range(larger(first[i], first[j]), j):
                total -= row[k] * other[k]
            row[j] = total
        pivot = row[i]
        for j in range(first[i], i):
            scaled = row[j] / matrix[j, j]
            pivot -= scaled * row[j]
            row[j] = scaled
        row[i] = pivot


@lent
def forward(matrix: Vector, first: Index, right: Vector, solution: Vector) -> None:
    """Solve L solution (q,) = right (q,); L is below the diagonal of matrix, with unit diagonal."""
    for i in range(len(first)):
        total = right[i]
        for k in range(first[i], i):
            total -= matrix[i, k] * solution[k]
        solution[i] = total


@lent
def substitute(matrix: Vector, first: Index, right: Vector, solution: Vector) -> None:
    """Fill solution (q,) for a right-hand side (q,), with the factors of `factorise` in matrix."""
    n = len(first)
    forward(matrix, first, right, solution)
    for i in range(n):
        solution[i] /= matrix[i, i]
    for i in range(n - 1, -1, -1):
        for k in range(first[i], i):
            solution[k] -= matrix[i, k] * solution[i]


@lent
def eliminate(matrix: Vector, first: Index) -> None:
    """Replace matrix (q, q), of symmetric profile, by its factors L U; first: see `factorise`.

    L has ones on its diagonal. There is no pivoting, which would leave the profile.
    """
    for i in range(len(first)):
        row = matrix[i]
        for j in range(first[i], i):
            other = matrix[j]
            lower, upper = row[j], other[i]
            for k in range(larger(first[i], first[j]), j):
                lower -= row[k] * matrix[k, j]
                upper -= other[k] * matrix[k, i]
            row[j], other[i] = lower / other[j], upper
        pivot = row[i]
        for k in range(first[i], i):
            pivot -= row[k] * matrix[k, i]
        row[i] = pivot


@lent
def back(matrix: Vector, first: Index, right: Vector, solution: Vector) -> None:
    """Fill solution (q,) for a right-hand side (q,), with the factors of `eliminate` in matrix."""
    forward(matrix, first, right, solution)
    for i in range(len(first) - 1, -1, -1):
        solution[i] /= matrix[i, i]
        for k in range(first[i], i):
            solution[k] -= matrix[k, i] * solution[i]

"""Arrays that kernels make, and what they ask of whole arrays: each compiled once for all of them.

numba compiles each of its own functions anew for every shape and constant that it is called with.
"""

from __future__ import annotations

from typing import TypeVar

import numpy as np
import numpy.typing as npt

from vv.engines.kernels.compiled import called, inlined
from vv.scene import Mask, Vector

Index = npt.NDArray[np.int64]

Number = TypeVar("Number", int, float)


@called
def numbers(n: int) -> Vector:
    """Room for n numbers."""
    return np.empty(n)


@called
def counts(n: int) -> Index:
    """Room for n integers."""
    return np.empty(n, np.int64)


@called
def rows(n: int) -> Vector:
    """Room for n vectors (n, 3)."""
    return np.empty((n, 3))


@called
def squares(n: int) -> Vector:
    """Room for n matrices (n, 3, 3)."""
    return np.empty((n, 3, 3))


@called
def nil_numbers(n: int) -> Vector:
    """n zeros."""
    made = numbers(n)
    for i in range(n):
        made[i] = 0.0
    return made


@called
def nil_rows(n: int) -> Vector:
    """n vectors (n, 3) of zeros."""
    made = rows(n)
    clear(made)
    return made


@called
def nil_squares(n: int) -> Vector:
    """n matrices (n, 3, 3) of zeros."""
    made = squares(n)
    for i in range(n):
        clear(made[i])
    return made


@called
def unmarked(n: int) -> Mask:
    """n times False."""
    made = np.empty(n, np.bool_)
    for i in range(n):
        made[i] = False
    return made


@called
def clear(table: Vector) -> None:
    """Fill a table (n, m) with zeros."""
    for i in range(table.shape[0]):
        for j in range(table.shape[1]):
            table[i, j] = 0.0


@called
def marked(mask: Mask) -> bool:
    """Whether any is True."""
    found = False
    for one in mask:
        found = found or one
    return found


@called
def least_of(values: Vector) -> float:
    """The least of numbers, infinity if there are none."""
    least = np.inf
    for value in values:
        least = smaller(least, value)
    return least


@inlined
def larger(a: Number, b: Number) -> Number:
    """max(a, b)."""
    return b if b > a else a


@inlined
def smaller(a: Number, b: Number) -> Number:
    """min(a, b)."""
    return b if b < a else a

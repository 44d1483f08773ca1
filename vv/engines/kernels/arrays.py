"""Functions by which kernels make arrays or evaluate whole arrays, each compiled only once.

numba compiles its own functions again for every shape and constant with which they are called.
"""

from __future__ import annotations

from typing import TypeVar

import numpy as np
import numpy.typing as npt

from vv.engines.kernels import rooms
from vv.engines.kernels.compiled import called, inlined, lent
from vv.scene import Mask, Vector

Index = npt.NDArray[np.int64]

Number = TypeVar("Number", int, float)


@called
def numbers(n: int) -> Vector:
    """An uninitialised array of n numbers."""
    return rooms.numbers(n)


@called
def counts(n: int) -> Index:
    """An uninitialised array of n integers."""
    return rooms.counts(n)


@called
def table(n: int, m: int) -> Vector:
    """An uninitialised array of numbers (n, m)."""
    return rooms.table(n, m)


@called
def rows(n: int) -> Vector:
    """An uninitialised array of n vectors (n, 3)."""
    return table(n, 3)


@called
def squares(n: int) -> Vector:
    """An uninitialised array of n matrices (n, 3, 3)."""
    return rooms.squares(n)


@called
def zero_numbers(n: int) -> Vector:
    """n zeros."""
    made = numbers(n)
    for i in range(n):
        made[i] = 0.0
    return made


@called
def zero_counts(n: int) -> Index:
    """n integer zeros."""
    made = counts(n)
    for i in range(n):
        made[i] = 0
    return made


@called
def zero_table(n: int, m: int) -> Vector:
    """Zeros (n, m)."""
    made = table(n, m)
    clear(made)
    return made


@called
def zero_rows(n: int) -> Vector:
    """n vectors (n, 3) of zeros."""
    made = rows(n)
    clear(made)
    return made


@called
def zero_squares(n: int) -> Vector:
    """n matrices (n, 3, 3) of zeros."""
    made = squares(n)
    for i in range(n):
        clear(made[i])
    return made


@called
def unmarked(n: int) -> Mask:
    """n truth values, all False."""
    made = rooms.marks(n)
    for i in range(n):
        made[i] = False
    return made


@called
def in_order(n: int) -> Index:
    """The integers from 0 to n - 1."""
    made = counts(n)
    for i in range(n):
        made[i] = i
    return made


@called
def same_numbers(source: Vector, n: int) -> Vector:
    """A copy of the first n numbers."""
    made = numbers(n)
    for i in range(n):
        made[i] = source[i]
    return made


@called
def same_counts(source: Index, n: int) -> Index:
    """A copy of the first n integers."""
    made = counts(n)
    for i in range(n):
        made[i] = source[i]
    return made


@called
def same_rows(source: Vector, n: int) -> Vector:
    """A copy of the first n vectors (n, 3)."""
    made = rows(n)
    for i in range(n):
        for c in range(3):
            made[i, c] = source[i, c]
    return made


@lent
def clear(table: Vector) -> None:
    """Fill a table (n, m) with zeros."""
    for i in range(table.shape[0]):
        for j in range(table.shape[1]):
            table[i, j] = 0.0


@lent
def marked(mask: Mask) -> bool:
    """Whether any element is True."""
    found = False
    for one in mask:
        found = found or one
    return found


@lent
def all_finite(values: Vector) -> bool:
    """Whether no number is infinite or undefined."""
    finite = True
    for value in values:
        finite = finite and abs(value) < np.inf
    return finite


@lent
def least_of(values: Vector) -> float:
    """The least number, or infinity if there are none."""
    least = np.inf
    for value in values:
        least = smaller(least, value)
    return least


@inlined
def square_of(a: float) -> float:
    """a times a."""
    return a * a


@inlined
def larger(a: Number, b: Number) -> Number:
    """max(a, b)."""
    return b if b > a else a


@inlined
def smaller(a: Number, b: Number) -> Number:
    """min(a, b)."""
    return b if b < a else a

"""The memory layout of Python's tuples and numpy's arrays, and a check that it holds.

CPython and numpy guarantee the layout to C programs built for their version. Kernels are not built
for a version, so that the layout is checked before any kernel is compiled or loaded.
"""

from __future__ import annotations

import ctypes
import functools
import sys

import numpy as np

ITEMS = tuple.__basicsize__  # bytes before the items of a tuple
DATA = object.__basicsize__  # bytes before an array's pointer to its data
AXES = DATA + 8  # bytes before the number of its axes
SHAPE, STRIDES = DATA + 16, DATA + 24  # bytes before the pointers to these numbers of all axes
POINTER = ctypes.c_void_p


@functools.cache
def is_known() -> bool:
    """Whether tuples and arrays have the memory layout that kernels expect."""
    if sys.implementation.name != "cpython" or ctypes.sizeof(POINTER) != 8:
        return False
    strided = np.arange(60.0).reshape(5, 4, 3)[1::2, :, 1]
    return all(array_is_known(one) for one in (strided, np.ones(7))) and tuple_is_known()


def tuple_is_known() -> bool:
    """Whether the items of a tuple are at the expected offsets."""
    pair = (object(), object())
    return [word(pair, ITEMS + 8 * k) for k in range(2)] == [id(one) for one in pair]


def array_is_known(array: np.ndarray) -> bool:
    """Whether the words of an array are at the expected offsets.

    Words that may not be pointers are not dereferenced: numpy stores strides behind the shape.
    """
    if np.ndarray.__basicsize__ < max(DATA, SHAPE, STRIDES) + 8:
        return False
    shape, strides = word(array, SHAPE), word(array, STRIDES)
    axes = ctypes.c_int.from_address(id(array) + AXES).value
    if word(array, DATA) != array.ctypes.data or axes != array.ndim:
        return False
    if shape == 0 or strides != shape + 8 * array.ndim:
        return False
    kind = ctypes.c_int64 * array.ndim
    found = tuple(kind.from_address(shape)), tuple(kind.from_address(strides))
    return found == (array.shape, array.strides)


def word(one: object, offset: int) -> int:
    """The pointer at an offset [bytes] from the start of an object."""
    return POINTER.from_address(id(one) + offset).value or 0

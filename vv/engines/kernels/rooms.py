"""Allocates arrays in kernels without numba's checks.

numba checks whether the size is addressable, and raises an exception if there is no memory; here
the process ends in this case, which is reported as a crash.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from vv.engines.kernels.compiled import Deferred
from vv.scene import Mask, Vector

ALIGNED = 32  # bytes, numba's alignment of arrays


def _numbers(n: int) -> Vector:
    """An uninitialised array of n numbers."""
    return np.empty(n)


def _counts(n: int) -> npt.NDArray[np.int64]:
    """An uninitialised array of n integers."""
    return np.empty(n, np.int64)


def _marks(n: int) -> Mask:
    """An uninitialised array of n truth values."""
    return np.empty(n, np.bool_)


def _table(n: int, m: int) -> Vector:
    """An uninitialised array of numbers (n, m)."""
    return np.empty((n, m))


def _count_table(n: int, m: int) -> npt.NDArray[np.int64]:
    """An uninitialised array of integers (n, m)."""
    return np.empty((n, m), np.int64)


def _squares(n: int) -> Vector:
    """An uninitialised array of n matrices (n, 3, 3)."""
    return np.empty((n, 3, 3))


def _row_table(n: int, m: int) -> Vector:
    """An uninitialised array of vectors (n, m, 3)."""
    return np.empty((n, m, 3))


def _wrap(item: np.dtype[Any], tail: tuple[int, ...], zero: bool, function: Any) -> Any:
    """The object from which numba takes the type and code of such a function.

    tail: fixed lengths of the last axes; zero: whether the array is filled with zeros.
    """
    from numba.core import types
    from numba.core.registry import cpu_target
    from numba.extending import intrinsic
    from numba.np.numpy_support import from_dtype

    number: Any = from_dtype
    given = function.__code__.co_argcount
    kind = types.Array(number(item), given + len(tail), "C")
    signature = kind(*[types.intp] * given)

    def write(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        shape = [*args, *(context.get_constant(types.intp, n) for n in tail)]
        return allocated(context, builder, kind, item.itemsize, shape, zero)

    @intrinsic
    def one(context: Any, n: Any) -> Any:
        return signature, write

    @intrinsic
    def two(context: Any, n: Any, m: Any) -> Any:
        return signature, write

    typing: Any = cpu_target.typing_context
    typing.refresh()
    return SimpleNamespace(_numba_type_=typing.resolve_value_type(one if given == 1 else two))


def allocated(
    context: Any, builder: Any, kind: Any, size: int, shape: list[Any], zero: bool
) -> Any:
    """The code for an array of a shape and size of elements [bytes]; zero: filled with zeros."""
    from numba.core import cgutils, types
    from numba.np.arrayobj import populate_array

    from vv.engines.kernels.compiler.direct import end_process

    strides: list[Any] = [context.get_constant(types.intp, size)]
    for length in reversed(shape):
        strides.insert(0, builder.mul(strides[0], length))
    memory = context.nrt.meminfo_alloc_aligned_unchecked(builder, strides[0], ALIGNED)
    code: Any = cgutils
    with code.if_unlikely(builder, code.is_null(builder, memory)):
        end_process(builder)
    array = context.make_array(kind)(context, builder)
    data = builder.bitcast(context.nrt.meminfo_data(builder, memory), array.data.type)
    fill: Any = populate_array
    if zero:
        code.memset(builder, data, strides[0], 0)
    fill(array, data, shape, strides[1:], size, memory)
    return array._getvalue()


def _made(function: Any, item: Any, tail: tuple[int, ...] = (), zero: bool = False) -> Any:
    return cast(Any, Deferred(function, functools.partial(_wrap, np.dtype(item), tail, zero)))


def of_zero_records(item: np.dtype[Any]) -> Callable[[int], Any]:
    """A function that makes n records of this type, filled with zeros."""

    def records(n: int) -> Any:
        """n records."""
        return np.zeros(n, item)

    return cast(Callable[[int], Any], _made(records, item, zero=True))


numbers: Callable[[int], Vector] = _made(_numbers, np.float64)
counts: Callable[[int], npt.NDArray[np.int64]] = _made(_counts, np.int64)
marks: Callable[[int], Mask] = _made(_marks, np.bool_)
table: Callable[[int, int], Vector] = _made(_table, np.float64)
count_table: Callable[[int, int], npt.NDArray[np.int64]] = _made(_count_table, np.int64)
squares: Callable[[int], Vector] = _made(_squares, np.float64, (3, 3))
row_table: Callable[[int, int], Vector] = _made(_row_table, np.float64, (3,))

"""Python calls kernels with arguments that are read where they lie, and counts none of them."""

import ctypes
import sys
from typing import Any, NamedTuple

import numpy as np
import pytest
from numba.core.runtime import nrt

from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import compiled, entry
from vv.engines.kernels.compiler.entry import DATA, ITEMS, SHAPE, STRIDES
from vv.scene import Vector

runtime: Any = nrt


@bundle
class Scaled(NamedTuple):
    """numbers: (n,)."""

    numbers: Vector
    scale: float


@bundle
class Outer(NamedTuple):
    """A bundle within one."""

    inner: Scaled


class Both(NamedTuple):
    """A bundle within a tuple, beside a table and what is not there."""

    scaled: Scaled
    table: Vector
    absent: Vector | None


@compiled
def thousandths(out: Vector, both: Both, factor: float, times: int, whole: bool) -> int:
    """A sum of all that is given, and of `out` twice, which is filled with it."""
    total = out[0]
    for one in both.scaled.numbers:
        total += both.scaled.scale * one
    for i in range(both.table.shape[0]):
        for j in range(both.table.shape[1]):
            total += (10.0 * i + j + 1.0) * both.table[i, j]
    if both.absent is None and whole:
        total *= factor * times
    out[:] = total
    return int(1000.0 * total)


@compiled
def scale_within(outer: Outer) -> int:
    """The scale, as an integer."""
    return int(outer.inner.scale)


def arguments(table: Vector) -> tuple[Any, ...]:
    """What `thousandths` takes."""
    return np.full(3, 0.25), Both(Scaled(np.array([1.0, 2.0]), 0.5), table, None), 1.5, 2, True


TABLES = (np.arange(6.0).reshape(2, 3), np.arange(24.0).reshape(4, 6)[1::2, ::2])


@pytest.mark.parametrize("table", TABLES, ids=("whole", "strided"))
def test_a_kernel_reads_and_fills_what_python_gives_it(table: Vector) -> None:
    given, wanted = arguments(table), arguments(table)
    found = entry(thousandths, given)(*given)
    assert found == thousandths.py_func(*wanted)  # type: ignore[attr-defined]
    assert list(given[0]) == list(wanted[0])
    assert thousandths(*arguments(table)) == found


def test_a_call_keeps_and_frees_nothing_that_it_was_given() -> None:
    given = arguments(TABLES[0])
    call = entry(thousandths, given)
    runtime._nrt.memsys_enable_stats()
    before = runtime.rtsys.get_allocation_stats(), sys.getrefcount(given[1].table)
    for _ in range(10):
        call(*given)
    after = runtime.rtsys.get_allocation_stats(), sys.getrefcount(given[1].table)
    made = after[0].mi_alloc - before[0].mi_alloc
    assert made == after[0].mi_free - before[0].mi_free == 10  # the bundle, and no array
    assert after[1] == before[1]


def test_a_bundle_within_a_bundle_is_freed_once() -> None:
    given = (Outer(Scaled(np.ones(2), 3.0)),)
    call = entry(scale_within, given)
    runtime._nrt.memsys_enable_stats()
    before = runtime.rtsys.get_allocation_stats()
    assert call(*given) == 3
    after = runtime.rtsys.get_allocation_stats()
    assert after.mi_alloc - before.mi_alloc == after.mi_free - before.mi_free == 2


def test_another_number_of_arguments_and_what_is_no_number_are_refused() -> None:
    given = arguments(TABLES[0])
    call: Any = entry(thousandths, given)
    with pytest.raises(TypeError, match="takes 5 arguments"):
        call(*given[:-1])
    with pytest.raises(TypeError, match="bad argument"):
        call(given[0], given[1], "much", 2, True)


def test_arrays_and_tuples_have_their_words_where_kernels_read_them() -> None:
    table, pointer = TABLES[1], ctypes.c_void_p
    words = [pointer.from_address(id(table) + offset).value for offset in (DATA, SHAPE, STRIDES)]
    assert words[0] == table.ctypes.data
    along = [(ctypes.c_int64 * 2).from_address(word or 0) for word in words[1:]]
    assert [tuple(one) for one in along] == [table.shape, table.strides]
    pair = (table, along)
    items = [pointer.from_address(id(pair) + ITEMS + 8 * k).value for k in range(2)]
    assert items == [id(table), id(along)]

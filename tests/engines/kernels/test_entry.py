"""Claims about the entry of kernels: arguments are read in place, and no references are counted."""

import sys
from collections.abc import Iterator
from ctypes import c_int32
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np
import pytest
from numba.core.runtime import nrt

from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import cache_folder, compiled, entry
from vv.engines.kernels.compiler import layout
from vv.scene import Vector

runtime: Any = nrt


@bundle
class Scaled(NamedTuple):
    """A bundle; numbers: (n,)."""

    numbers: Vector
    scale: float


@bundle
class Outer(NamedTuple):
    """A bundle within a bundle."""

    inner: Scaled


class Both(NamedTuple):
    """A bundle within a tuple, beside a table and None."""

    scaled: Scaled
    table: Vector
    absent: Vector | None


@compiled
def thousandths(out: Vector, both: Both, factor: float, times: int, whole: bool) -> int:
    """A weighted sum of all arguments, with `out`, which is filled with it, twice."""
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
    """The arguments of `thousandths`."""
    return np.full(3, 0.25), Both(Scaled(np.array([1.0, 2.0]), 0.5), table, None), 1.5, 2, True


TABLES = (np.arange(6.0).reshape(2, 3), np.arange(24.0).reshape(4, 6)[1::2, ::2])


@pytest.mark.parametrize("table", TABLES, ids=("whole", "strided"))
def test_a_kernel_reads_and_fills_what_python_gives_it(table: Vector) -> None:
    given, wanted = arguments(table), arguments(table)
    found = entry(thousandths, given)(*given)
    assert found == thousandths.py_func(*wanted)  # type: ignore[attr-defined]
    assert list(given[0]) == list(wanted[0])
    assert thousandths(*arguments(table)) == found


def test_a_kernel_that_is_compiled_anew_gives_what_python_gives(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("VV_CACHE", str(tmp_path / "empty"))
    fresh: Any = compiled(thousandths.py_func)  # type: ignore[attr-defined]
    for table in TABLES:
        given, wanted = arguments(table), arguments(table)
        assert entry(fresh, given)(*given) == fresh.py_func(*wanted)
        assert list(given[0]) == list(wanted[0])


def test_types_of_arguments_are_built_once_and_other_types_get_code_of_their_own(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    first, strided = (entry(thousandths, arguments(table)) for table in TABLES)
    assert first is not strided
    dispatcher = thousandths.dispatcher  # type: ignore[attr-defined]
    monkeypatch.setattr(dispatcher, "typeof_pyval", None)
    larger = np.arange(20.0).reshape(4, 5)
    assert entry(thousandths, arguments(larger)) is first
    assert entry(thousandths, arguments(larger[:, ::2])) is strided


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


def total(numbers: Vector) -> int:
    """The sum, as an integer."""
    found = 0.0
    for one in numbers:
        found += one
    return int(found)


@pytest.fixture
def unknown(request: Any, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Make words of objects lie elsewhere than kernels expect them."""
    moved = {name: getattr(layout, there) for name, there in request.param.items()}
    for name, place in moved.items():
        monkeypatch.setattr(layout, name, place)
    layout.is_known.cache_clear()
    yield
    monkeypatch.undo()
    layout.is_known.cache_clear()


SWAPPED = {"SHAPE": "STRIDES", "STRIDES": "SHAPE"}
ELSEWHERE = ({"ITEMS": "SHAPE"}, {"DATA": "AXES"}, {"AXES": "DATA"}, {"SHAPE": "DATA"}, SWAPPED)


def test_arrays_and_tuples_lie_in_memory_as_kernels_read_them() -> None:
    assert layout.is_known.__wrapped__()
    for array in (np.ones((4, 2, 3)), np.arange(24.0).reshape(2, 3, 4)[:, ::2, 1:]):
        assert layout.array_is_known(array)


@pytest.mark.parametrize(
    ("name", "value"),
    [("sys", SimpleNamespace(implementation=SimpleNamespace(name="pypy"))), ("POINTER", c_int32)],
)
def test_another_python_or_another_size_of_pointers_is_not_known(
    name: str, value: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(layout, name, value)
    assert not layout.is_known.__wrapped__()


@pytest.mark.parametrize("name", ["DATA", "SHAPE", "STRIDES"])
def test_no_word_is_read_behind_the_end_of_an_array_object(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    end, read = np.ndarray.__basicsize__, list[int]()

    def word(one: object, offset: int) -> int:
        read.append(offset)
        return 0

    monkeypatch.setattr(layout, "word", word)
    for beyond in (-7, 0, 8):
        monkeypatch.setattr(layout, name, end + beyond)
        assert not layout.array_is_known(np.ones(3))
    assert not read


@pytest.mark.parametrize("unknown", ELSEWHERE, indirect=True)
def test_a_word_that_lies_elsewhere_is_noticed(unknown: None) -> None:
    assert not layout.is_known()


@pytest.mark.parametrize("unknown", [SWAPPED], indirect=True)
def test_a_kernel_is_right_where_arrays_lie_in_memory_as_nobody_knows(unknown: None) -> None:
    assert compiled(total)(np.arange(64.0)[:3]) == 3


def test_kernels_that_read_arrays_elsewhere_are_not_loaded(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    folders = []
    for known in (True, False):
        monkeypatch.setattr(layout, "is_known", lambda known=known: known)
        folders.append(cache_folder(Path(__file__)))
    assert folders[0] != folders[1]

"""Claims about parts of kernels that are called: what they are given, return and raise."""

import inspect
from typing import Any, NamedTuple

import numpy as np
import pytest
from numba.core.errors import TypingError
from numba.core.runtime import nrt

from vv.engines.kernels.arrays import zero_numbers
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called, compiled, lent
from vv.scene import Vector

runtime: Any = nrt


@bundle
class Held(NamedTuple):
    """A bundle; numbers: (n,)."""

    numbers: Vector


@lent
def last(held: Held) -> float:
    """The last of the numbers."""
    return float(held.numbers[-1])


@compiled
def last_of_many(held: Held, rounds: int) -> float:
    """The last number, read a number of times."""
    total = 0.0
    for _ in range(rounds):
        total += last(held)
    return total


@lent
def given(n: int) -> float:
    """A function that only borrows arrays and must not be returned one."""
    return float(zero_numbers(n)[0])


@compiled
def asks(n: int) -> float:
    """A function that calls one which is returned an array."""
    return given(n)


@called
def doubtful(number: int) -> int:
    """A function that may raise."""
    if number > 2:
        raise ValueError("too many")
    return number


@called
def between(number: int) -> int:
    """A function that raises nothing itself but calls one that may."""
    return doubtful(number)


@compiled
def told(number: int) -> int:
    """A function that calls, by way of another, one that may raise."""
    return between(number)


@called
def halves(n: int) -> tuple[Vector, Vector]:
    """Two arrays, of which one is set in one branch only."""
    low = zero_numbers(n)
    high = low
    if n > 2:
        high = zero_numbers(2 * n)
    return low, high


@compiled
def halved(n: int, rounds: int) -> int:
    """The length of the second array, made a number of times."""
    length = 0
    for _ in range(rounds):
        low, high = halves(n)
        length = len(high) + 0 * len(low)
    return length


@compiled
def looped(table: Vector, first: int, end: int) -> float:
    """Elements from both ends, over ranges of all kinds."""
    total = 0.0
    for i in range(end):
        for j in range(first, end):
            total += table[i, j] + 10.0 * table[-1 - i, -1]
    for i in range(end - 1, -1, -1):
        table[i, 0] = len(table)
    return total


@lent
def text_added(value: float) -> float:
    """A function that cannot be typed."""
    return value + "some"  # type: ignore[operator]


@compiled
def adds_text(value: float) -> float:
    """A function that calls one that cannot be typed."""
    return text_added(value)


@lent
def times_count(value: float, count: int) -> float:
    """A multiple of the value."""
    return value * count


@compiled
def three_times(value: float) -> float:
    """Six times the value, by constants of two sizes and a variable."""
    total = times_count(value, 1) + times_count(value, 2)
    for k in range(4):
        total += times_count(value, k) / 2.0
    return total


def test_a_lent_part_reads_a_bundle_and_leaves_its_references_alone() -> None:
    numbers = np.array([1.0, 2.5])
    last_of_many(Held(numbers), 1)
    runtime._nrt.memsys_enable_stats()
    before = runtime.rtsys.get_allocation_stats()
    assert last_of_many(Held(numbers), 4) == 10.0
    after = runtime.rtsys.get_allocation_stats()
    assert after.mi_alloc - before.mi_alloc == after.mi_free - before.mi_free


def test_a_lent_part_that_is_given_an_array_is_refused() -> None:
    with pytest.raises(TypingError, match="nothing would free it"):
        asks(2)


def test_an_error_of_types_names_the_line_of_the_part_that_has_it() -> None:
    with pytest.raises(TypingError) as failed:
        adds_text(1.0)
    source, first = inspect.getsourcelines(text_added.__wrapped__)  # type: ignore[attr-defined]
    line = first + next(k for k, text in enumerate(source) if "return" in text)
    assert f'test_called_parts.py", line {line}:' in str(failed.value)


def test_a_part_is_compiled_once_whatever_constants_it_is_given() -> None:
    assert three_times(2.0) == 12.0
    # A kernel that was kept compiles no part.
    three_times.recompile()  # type: ignore[attr-defined]
    signatures = times_count.dispatcher.signatures  # type: ignore[attr-defined]
    assert len(signatures) == 1


def test_what_a_part_raises_reaches_python() -> None:
    assert told(2) == 2
    with pytest.raises(ValueError, match="too many"):
        told(3)


def test_arrays_that_parts_return_are_freed() -> None:
    halved(3, 1)
    runtime._nrt.memsys_enable_stats()
    before = runtime.rtsys.get_allocation_stats()
    assert halved(3, 10) == 6
    after = runtime.rtsys.get_allocation_stats()
    assert after.alloc - before.alloc == after.free - before.free == 20


def test_elements_and_ranges_are_those_of_python() -> None:
    for table in (np.arange(9.0).reshape(3, 3), np.arange(18.0).reshape(3, 6)[:, ::2]):
        wanted = looped.py_func(table.copy(), 1, 3)  # type: ignore[attr-defined]
        assert looped(table, 1, 3) == wanted
        assert list(table[:, 0]) == [3.0, 3.0, 3.0]

"""Claims about kernels that others call by their addresses."""

from __future__ import annotations

from typing import Any, NamedTuple

import numba
import numpy as np
import pytest

from tests.support.plain import plain
from vv.engines.kernels.addressed import address_of, addressed
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import compiled
from vv.scene import Vector


@bundle
class Pair(NamedTuple):
    """Two arrays."""

    one: Vector
    other: Vector


def examples() -> tuple[Any, ...]:
    """Arguments of the types that `added` is called with."""
    return Pair(np.zeros(1), np.zeros(1)), 1.0, 1


@compiled
def added(pair: Pair, factor: float, k: int) -> int:
    """Add factor times pair.other to pair.one, but to element k; returns their number."""
    for i in range(len(pair.one)):
        if i != k:
            pair.one[i] += factor * pair.other[i]
    return len(pair.one)


@addressed(examples)
def added_at(address: int, pair: Pair, factor: float, k: int) -> int:
    """`added`, whose address is given."""
    return added(pair, factor, k)


@compiled
def outer(address: int, one: Vector, other: Vector, many: int) -> int:
    """Call `added` by its address a number of times, with a literal number."""
    total = 0
    for _ in range(many):
        total += added_at(address, Pair(one, other), 2.0, 1)
    return total


@compiled
def unfit(address: int, one: Vector) -> int:
    """Call `added` with two numbers of a wrong type."""
    return added_at(address, Pair(one, one), 2.0, 1.0)  # type: ignore[arg-type]


def test_a_kernel_calls_another_by_its_address() -> None:
    one, other = np.zeros(3), np.array([1.0, 2.0, 3.0])
    assert outer(address_of(added, examples), one, other, 4) == 12
    assert one.tolist() == [8.0, 0.0, 24.0]
    assert address_of(added, examples) == address_of(added, examples)


def test_run_by_python_it_calls_what_stands_in_its_body() -> None:
    one, other = np.zeros(3), np.array([1.0, 2.0, 3.0])
    assert plain(outer)(0, one, other, 4) == 12
    assert one.tolist() == [8.0, 0.0, 24.0]


def test_arguments_of_other_types_than_the_examples_are_refused_when_it_is_compiled() -> None:
    with pytest.raises(numba.core.errors.TypingError, match=r"added_at takes .* after its address"):
        unfit(0, np.zeros(1))

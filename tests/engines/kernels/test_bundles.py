"""Claims about bundles, which kernels pass as one pointer, and about functions within kernels."""

from typing import Any, NamedTuple

import numba
import numpy as np
from numba.core.runtime import nrt

from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called, compiled
from vv.scene import Vector


@bundle
class Pair(NamedTuple):
    """A bundle; numbers: (n,)."""

    numbers: Vector
    scale: float


@bundle
class Nest(NamedTuple):
    """A bundle of a bundle."""

    pair: Pair
    rounds: int


@called
def scaled(pair: Pair) -> Pair:
    """The pair with its numbers scaled once more."""
    return Pair(pair.scale * pair.numbers, 2.0 * pair.scale)


@compiled
def grown(nest: Nest) -> float:
    """The last number after a number of scalings."""
    pair = nest.pair
    for _ in range(nest.rounds):
        pair = scaled(pair)
    nest.pair.numbers[0] = pair.scale
    return float(pair.numbers[-1])


plain: Any = numba.njit  # which has types that mypy takes for our own
runtime: Any = nrt


@plain  # type: ignore[untyped-decorator]
def once(pair: Pair) -> float:
    """A kernel compiled by numba's own compiler, which calls a part too."""
    return float(scaled(pair).numbers[-1])


def nest(rounds: int) -> Nest:
    """Numbers 1, 2 and 3 with a scale of 3."""
    return Nest(Pair(np.array([1.0, 2.0, 3.0]), 3.0), rounds)


def test_a_bundle_is_a_named_tuple_to_python() -> None:
    whole = nest(2)
    assert isinstance(whole, tuple)
    assert whole.pair._replace(scale=1.0).scale == 1.0
    assert Pair.__doc__ == "A bundle; numbers: (n,)."


def test_kernels_make_bundles_and_read_those_within_others() -> None:
    assert grown(nest(3)) == 3.0 * 3.0 * 6.0 * 12.0


def test_arrays_of_a_bundle_are_those_of_python() -> None:
    whole = nest(1)
    grown(whole)
    assert whole.pair.numbers[0] == 6.0


def test_bundles_are_freed_with_their_arrays() -> None:
    whole = nest(50)
    grown(whole)
    runtime._nrt.memsys_enable_stats()
    before = runtime.rtsys.get_allocation_stats()
    grown(whole)
    after = runtime.rtsys.get_allocation_stats()
    assert after.alloc - before.alloc >= 50
    assert after.alloc - before.alloc == after.free - before.free
    assert after.mi_alloc - before.mi_alloc == after.mi_free - before.mi_free


def test_a_part_can_be_called_by_what_numba_compiles_as_ever() -> None:
    assert once(nest(0).pair) == 9.0

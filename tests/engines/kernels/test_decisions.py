"""Claims about what the compiler of kernels decides: what it keeps, reads and counts itself."""

from __future__ import annotations

import operator
from types import SimpleNamespace
from typing import Any

import numba
import pytest
from llvmlite import ir
from numba.core import compiler, types

from vv.engines.kernels.compiled import compiled
from vv.engines.kernels.compiler import lowering
from vv.engines.kernels.compiler.lean import names_element, steps_by_one
from vv.engines.kernels.compiler.lowering import Lower
from vv.engines.kernels.compiler.passes import CachedFlags, CachingContext, is_cacheable

WORD = ir.IntType(64)
ARRAY, NUMBER, INDEX = types.float64[:, ::1], types.float64, types.int64
ANY: Any = types  # whose hints do not fit its own classes
PART: Any = types.Dispatcher(numba.njit(lambda x: x))


def settled(nrt: bool) -> Any:
    """Settled flags with one value."""
    plain: Any = compiler.Flags()  # type: ignore[no-untyped-call]
    plain.nrt = nrt
    return CachedFlags(plain)


def test_settled_flags_are_equal_if_their_values_are() -> None:
    assert settled(True) == settled(True)
    assert settled(True) != settled(False)


def function(key: Any) -> Any:
    """The type of a function that numba knows by a key."""
    template = type("Template", (), {"key": key})
    made: Any = types.Function.__new__(types.Function)
    made.templates, made.typing_key = (template,), key
    return made


@pytest.mark.parametrize(("called", "args", "kept"), [
    (PART, (ARRAY, types.none), True),
    (function(operator.add), (NUMBER, INDEX), True),
    (function(operator.add), (NUMBER, ARRAY), False),
    (function(operator.getitem), (ARRAY, types.slice2_type), True),
    (function(operator.getitem), (types.none, INDEX), False),
    (function(operator.setitem), (ARRAY, types.slice2_type), False),
    (types.none, (NUMBER,), False),
])  # fmt: skip
def test_types_are_kept_of_calls_of_parts_and_arithmetic_and_of_elements(
    called: Any, args: Any, kept: bool
) -> None:
    assert is_cacheable(called, args) is kept
    asked: list[Any] = []

    def resolve(*given: Any) -> int:
        asked.append(given)
        return len(asked)

    context = CachingContext(SimpleNamespace(resolve_function_type=resolve), {})
    said = [context.resolve_function_type(called, args, {}) for _ in range(2)]
    assert said == ([1, 1] if kept else [1, 2])
    named = [context.resolve_function_type(called, args, {"x": NUMBER}) for _ in range(2)]
    assert named[0] != named[1]


@pytest.mark.parametrize(("array", "index", "one"), [
    (ARRAY, ANY.UniTuple(INDEX, 2), True),
    (ARRAY, INDEX, False),
    (types.float64[:], types.uint64, True),
    (types.float64[:], types.slice2_type, False),
    (ANY.Array(NUMBER, 1, "F"), INDEX, False),
    (ANY.Array(NUMBER, 1, "C", aligned=False), INDEX, False),
    (ANY.Array(ANY.UniTuple(NUMBER, 2), 1, "C"), INDEX, False),
    (ANY.UniTuple(NUMBER, 3), INDEX, False),
])  # fmt: skip
def test_an_element_is_named_by_as_many_whole_numbers_as_an_array_has_axes(
    array: Any, index: Any, one: bool
) -> None:
    assert names_element(array, index) is one


@pytest.mark.parametrize(("place", "step", "by_one"), [
    ([2], ir.Constant(WORD, 1), True),
    ([1], ir.Constant(WORD, 1), False),
    ([2], ir.Constant(WORD, 2), False),
    ([2], SimpleNamespace(constant=1), False),
])  # fmt: skip
def test_a_range_steps_by_one_if_its_last_word_is_the_constant_one(
    place: list[int], step: Any, by_one: bool
) -> None:
    assert steps_by_one(SimpleNamespace(operands=[None, step], indices=place)) is by_one


@pytest.mark.parametrize(("counts", "holds"), [(True, True), (True, False), (False, True)])
def test_references_are_counted_of_what_holds_them_where_they_are_counted(
    monkeypatch: pytest.MonkeyPatch, counts: bool, holds: bool
) -> None:
    monkeypatch.setattr(lowering, "holds_references", lambda manager, kind: kind == holds)
    context = SimpleNamespace(enable_nrt=counts, data_model_manager=None)
    one: Any = SimpleNamespace(context=context, fndesc=SimpleNamespace(typemap={"x": True}))
    assert Lower.is_counted(one, "x") is (counts and holds)


def test_kernels_say_that_numba_may_not_compile(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(numba.config, "DISABLE_JIT", True)
    with pytest.raises(RuntimeError, match="NUMBA_DISABLE_JIT is set"):
        compiled(lambda: 0.0)()

"""Tells numba how kernels ask which mutant is on; the copy has it as vv/switch_numba.py."""

import ctypes
from collections.abc import Callable
from typing import Any

import llvmlite.binding
from llvmlite import ir
from numba.core import types
from numba.core.registry import cpu_target
from numba.extending import intrinsic, overload
from vv.switch_compiled import WORD, either, on  # type: ignore[import-not-found]  # in the copy

llvmlite.binding.add_symbol("vv_mutant", ctypes.addressof(WORD))


def _word(typing_context: Any) -> Any:
    """The number of the mutant that is on."""

    def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        found = builder.module.globals.get("vv_mutant")
        if found is None:
            found = ir.GlobalVariable(builder.module, ir.IntType(64), "vv_mutant")
        return builder.load(found)

    return types.int64(), code


word: Any = intrinsic(_word)


@overload(on.function)
def _on(number):  # type: ignore[no-untyped-def]  # numba compares the signatures
    return lambda number: word() == number


@overload(either.function)
def _either(number, old, new):  # type: ignore[no-untyped-def]
    if isinstance(old, types.Integer):
        return lambda number, old, new: int(new) if word() == number else old
    return lambda number, old, new: new if word() == number else old


def type_of(function: Callable[..., Any]) -> Any:
    """numba's type of one of these functions."""
    context: Any = cpu_target.typing_context
    context.refresh()
    return context.resolve_value_type(function)

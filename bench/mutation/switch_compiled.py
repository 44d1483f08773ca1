"""Lets kernels ask which mutant is on; the copy that holds mutants has it as vv/switch_compiled.py.

The number is a word of the process that kernels read each time: it is no part of what is compiled.
"""

import ctypes
from typing import Any

import llvmlite.binding
from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic, overload
from vv.switch import ON, on  # type: ignore[import-not-found]  # it is there in the copy

WORD = ctypes.c_int64(ON)
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


@overload(on)
def _on(number):  # type: ignore[no-untyped-def]  # numba compares the signatures
    return lambda number: word() == number


def either(number: int, old: Any, new: Any) -> Any:
    """What is there, or what a mutant makes of it; where that is a whole number, one again."""
    return new if on(number) else old


@overload(either)
def _either(number, old, new):  # type: ignore[no-untyped-def]
    if isinstance(old, types.Integer):
        return lambda number, old, new: int(new) if word() == number else old
    return lambda number, old, new: new if word() == number else old

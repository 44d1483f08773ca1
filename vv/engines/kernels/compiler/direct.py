"""How parts of kernels are called: they are given values as they are, and return one.

numba takes structures apart for each call and puts them together again on the other side, returns
through memory, and has whoever calls ask whether something was raised. A part that may raise is
called in that way still.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba.core import callconv, cgutils, errors, imputils

CONVENTION: Any = callconv.CPUCallConv
CODE: Any = cgutils
OURS: Any = imputils
NUMBA_ERROR: Any = errors.NumbaError


class MayRaiseError(NUMBA_ERROR):  # type: ignore[misc]
    """A function that was to be called directly may raise, which only numba's way can tell."""


class Outward(CONVENTION):  # type: ignore[misc]
    """numba's way to call its own functions, for a function that could not hand on what they raise.

    The process ends there, as where an index of an array is wrong.
    """

    def return_user_exc(self, builder: Any, *_: Any, **__: Any) -> None:
        """Raise what numba raises for a wrong index or shape."""
        end_process(builder)
        builder.unreachable()

    def return_status_propagate(self, builder: Any, status: Any) -> None:
        """Raise what one of numba's functions raised."""
        end_process(builder)
        builder.unreachable()


class Direct(CONVENTION):  # type: ignore[misc]
    """The way in which a function that cannot raise is called, and returns."""

    def get_function_type(self, restype: Any, argtypes: Any) -> Any:
        """The type of the function."""
        kinds = [self.context.get_value_type(kind) for kind in argtypes]
        return ir.FunctionType(self.context.get_value_type(restype), kinds)

    def decode_arguments(self, builder: Any, argtypes: Any, func: Any) -> Any:
        """The values that the function is given."""
        return func.args

    def return_user_exc(self, *_: Any, **__: Any) -> None:
        """Raise what the source of the function raises."""
        raise MayRaiseError("a function that is called directly cannot raise")

    return_dynamic_user_exc = return_user_exc


def end_process(builder: Any) -> None:
    """The code that ends the process, which is told as a crash of the code."""
    kind = ir.FunctionType(ir.VoidType(), [])
    builder.call(CODE.get_or_insert_function(builder.module, kind, "llvm.trap"), [])


def declared(context: Any, module: Any, described: Any) -> Any:
    """A function that is called directly."""
    kind = Direct(context).get_function_type(described.restype, described.argtypes)
    function = CODE.get_or_insert_function(module, kind, described.mangled_name)
    if described.inline:
        function.attributes.add("alwaysinline")
    return function


def direct_call(described: Any, library: Any) -> Any:
    """What writes the code that calls such a function."""

    def call(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        value = builder.call(declared(context, builder.module, described), args)
        return OURS.impl_ret_new_ref(context, builder, described.restype, value)

    made: Any = call
    made.signature, made.libs = described.argtypes, (library,)
    return made


def call_that_raises(described: Any, library: Any) -> Any:
    """What writes the code that calls a function in numba's way, from what can hand on an error."""
    ours = OURS.user_function(described, (library,))

    def call(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        if getattr(context, "direct", False):
            raise MayRaiseError("a function that is called directly cannot hand on what is raised")
        return ours(context, builder, signature, args)

    made: Any = call
    made.signature, made.libs = ours.signature, ours.libs
    return made

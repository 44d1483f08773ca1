"""The calling convention of functions within kernels: values are passed and returned directly.

numba disassembles structures for each call and reassembles them in the callee, returns through
memory, and lets the caller check for exceptions. Functions that may raise are still called in this
way.
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
    """A function to be called directly may raise, which only numba's convention can report."""


class Outward(CONVENTION):  # type: ignore[misc]
    """numba's convention for calls of its own functions from one that cannot pass on exceptions.

    An exception ends the process, as a wrong index of an array does.
    """

    def return_user_exc(self, builder: Any, *_: Any, **__: Any) -> None:
        """End the process where numba raises an exception, for example for a wrong index."""
        end_process(builder)
        builder.unreachable()

    def return_status_propagate(self, builder: Any, status: Any) -> None:
        """End the process where one of numba's functions has raised an exception."""
        end_process(builder)
        builder.unreachable()


class Direct(CONVENTION):  # type: ignore[misc]
    """The convention for calling a function that cannot raise."""

    def get_function_type(self, restype: Any, argtypes: Any) -> Any:
        """The LLVM type of the function."""
        kinds = [self.context.get_value_type(kind) for kind in argtypes]
        return ir.FunctionType(self.context.get_value_type(restype), kinds)

    def decode_arguments(self, builder: Any, argtypes: Any, func: Any) -> Any:
        """The values of the function's arguments."""
        return func.args

    def return_user_exc(self, *_: Any, **__: Any) -> None:
        """Refuse to compile the function, since its source raises an exception."""
        raise MayRaiseError("a function that is called directly cannot raise")

    return_dynamic_user_exc = return_user_exc


def end_process(builder: Any) -> None:
    """Generate the code that ends the process, which is reported as a crash."""
    kind = ir.FunctionType(ir.VoidType(), [])
    builder.call(CODE.get_or_insert_function(builder.module, kind, "llvm.trap"), [])


def declared(context: Any, module: Any, described: Any) -> Any:
    """The declaration in a module of a function that is called directly."""
    kind = Direct(context).get_function_type(described.restype, described.argtypes)
    function = CODE.get_or_insert_function(module, kind, described.mangled_name)
    if described.inline:
        function.attributes.add("alwaysinline")
    return function


def direct_call(described: Any, library: Any) -> Any:
    """The generator of code that calls such a function."""

    def call(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        value = builder.call(declared(context, builder.module, described), args)
        return OURS.impl_ret_new_ref(context, builder, described.restype, value)

    made: Any = call
    made.signature, made.libs = described.argtypes, (library,)
    return made


def call_that_raises(described: Any, library: Any) -> Any:
    """The generator of code that calls a function by numba's convention.

    The caller must be able to pass on an exception.
    """
    ours = OURS.user_function(described, (library,))

    def call(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        if getattr(context, "direct", False):
            raise MayRaiseError("a function that is called directly cannot hand on what is raised")
        return ours(context, builder, signature, args)

    made: Any = call
    made.signature, made.libs = ours.signature, ours.libs
    return made

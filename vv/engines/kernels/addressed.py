"""Lets kernels call a kernel that is compiled apart, by the address of its machine code.

A kernel is compiled with all that it calls, whether or not a scene needs it. A part that few scenes
need can be a kernel of its own, which is compiled when it is first asked for its address.
"""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any, TypeVar, cast

from vv.engines.kernels.compiled import Deferred

Function = TypeVar("Function", bound=Callable[..., int])
Examples = Callable[[], tuple[Any, ...]]


def address_of(kernel: Callable[..., int], examples: Examples) -> int:
    """The address of a kernel for the types of these arguments; it is compiled if necessary."""
    dispatcher = cast(Deferred, kernel).dispatcher
    kinds = tuple(map(dispatcher.typeof_pyval, examples()))
    if kinds not in dispatcher.overloads:
        dispatcher.compile(kinds)
    made = dispatcher.overloads[kinds]
    return int(made.library.get_pointer_to_function(made.fndesc.llvm_func_name))


def addressed(examples: Examples) -> Callable[[Function], Function]:
    """A function that kernels replace by a call of the kernel at its first argument, an address.

    Its body says what is called if it is run by Python. The other arguments must have the types of
    `examples`, by which the address is found: the machine code at an address checks nothing.
    """

    def decorate(function: Function) -> Function:
        return cast(Function, Deferred(function, lambda called: _wrap(called, examples)))

    return decorate


def _wrap(function: Any, examples: Examples) -> Any:
    """The object from which numba takes the type of this function and generates its code."""
    from numba.core import errors
    from numba.core import types as numba_types
    from numba.core.registry import cpu_target
    from numba.core.typing.typeof import typeof
    from numba.extending import intrinsic

    from vv.engines.kernels.compiler.direct import CONVENTION, Outward

    types: Any = numba_types
    wanted = tuple(map(typeof, examples()))

    def ask(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        inner = CONVENTION(context).get_function_type(types.int64, wanted)
        place = builder.inttoptr(args[0], inner.as_pointer())
        given = zip(range(len(wanted)), signature.args[1], wanted, strict=True)
        values = [
            context.cast(builder, builder.extract_value(args[1], k), kind, want)
            for k, kind, want in given
        ]
        status, value = Outward(context).call_function(builder, place, types.int64, wanted, values)
        with builder.if_then(status.is_error, likely=False):
            Outward(context).return_status_propagate(builder, status)
        return value

    @intrinsic
    def call(context: Any, address: Any, *given: Any) -> Any:
        found = tuple(map(types.unliteral, given))
        if found != wanted:
            told = f"{function.__name__} takes {wanted} after its address, not {found}"
            raise errors.TypingError(told)
        return types.int64(types.int64, types.StarArgTuple(given)), ask

    typing: Any = cpu_target.typing_context
    typing.refresh()
    return SimpleNamespace(_numba_type_=typing.resolve_value_type(call))

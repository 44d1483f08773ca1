"""Lets kernels prefetch a row of an array into the cache."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

from vv.engines.kernels.compiled import Deferred
from vv.scene import Vector

READ, KEPT, DATA = 0, 3, 1  # arguments of llvm.prefetch: access, locality, kind of cache


def _begin_to_read(rows: Vector, i: int, column: int) -> None:
    """Prefetch the cache line that contains rows[i, column]; for kernels only."""


def _wrap(function: Any) -> Any:
    """The object from which numba takes the type of this function and generates its code."""
    from llvmlite import ir
    from numba.core import types
    from numba.core.registry import cpu_target
    from numba.extending import intrinsic

    from vv.engines.kernels.compiler.lean import place_of

    pair: Any = cast(Any, types).UniTuple(types.uintp, 2)

    def ask(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        kinds = signature.args[0], pair
        index = [
            context.cast(builder, value, kind, types.uintp)
            for value, kind in zip(args[1:], signature.args[1:], strict=True)
        ]
        both = context.make_tuple(builder, kinds[1], index)
        place = place_of(context, builder, kinds, args[0], both)
        number, address = ir.IntType(32), ir.IntType(8).as_pointer()
        kind = ir.FunctionType(ir.VoidType(), [address, number, number, number])
        name = "llvm.prefetch.p0"
        module = builder.module
        asked = module.globals.get(name) or ir.Function(module, kind, name)
        builder.call(
            asked, [builder.bitcast(place, address), number(READ), number(KEPT), number(DATA)]
        )
        return context.get_dummy_value()

    @intrinsic
    def read(context: Any, rows: Any, i: Any, column: Any) -> Any:
        return types.void(rows, i, types.intp), ask

    typing: Any = cpu_target.typing_context
    typing.refresh()
    return SimpleNamespace(_numba_type_=typing.resolve_value_type(read))


begin_to_read = cast(Any, Deferred(_begin_to_read, _wrap))

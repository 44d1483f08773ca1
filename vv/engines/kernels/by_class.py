"""Lets kernels call the function of a given name in the file of the class of its first argument."""

from __future__ import annotations

import sys
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any, TypeVar, cast

from vv.engines.kernels.compiled import HIDDEN, LENT, ROUNDING, Deferred

Function = TypeVar("Function", bound=Callable[..., object])


def of_its_file(function: Function) -> Function:
    """A function that kernels call and inline: the one of this name beside the named tuple's class.

    It may only borrow arrays. numba is loaded when a kernel is first called.
    """
    return cast(Function, Deferred(function, wrap))


def wrap(function: Any) -> Any:
    """The object from which numba takes the type of such a function."""
    from numba.core.registry import cpu_target
    from numba.extending import overload

    from vv.engines.kernels.compiler.parts import PartCompiler

    inline: Any = {"forceinline": True, "pipeline_class": PartCompiler}
    options: Any = {**inline, **LENT, **HIDDEN, **ROUNDING}

    @overload(function, jit_options=options, strict=False)
    def typed(one: Any, *_: Any) -> Any:
        return hook_of(one, function.__name__).__wrapped__

    context: Any = cpu_target.typing_context
    context.refresh()
    return SimpleNamespace(_numba_type_=context.resolve_value_type(function))


def hook_of(kind: Any, name: str) -> Any:
    """The function of a name in the module of a numba type's class, or None if there is none."""
    return getattr(sys.modules[kind.instance_class.__module__], name, None)

"""Runs kernels as plain Python, so that a test by hand need not wait for a compiler.

Python rounds as kernels do, but for products and sums that the compiler fuses, and raises where
they divide by zero.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from types import FunctionType, ModuleType, SimpleNamespace
from typing import Any

from vv.engines.kernels import by_class
from vv.engines.kernels.compiled import Deferred

Names = dict[str, Any]
NAMES: dict[int, Names] = {}  # of each module with kernels, by the identity of its own names


def plain(kernel: Callable[..., Any]) -> Callable[..., Any]:
    """A kernel as a Python function, which calls others in the same way."""
    if not isinstance(kernel, Deferred):
        return kernel
    if kernel._wrap is by_class.wrap:
        return _of_its_file(kernel._function.__name__)
    function: Any = kernel._function
    names = _names(function.__globals__)
    return FunctionType(function.__code__, names, function.__name__, function.__defaults__)


def _of_its_file(name: str) -> Callable[..., Any]:
    """The function of a name in the file of the class of its first argument."""

    def call(one: Any, *others: Any) -> Any:
        return plain(getattr(sys.modules[type(one).__module__], name))(one, *others)

    return call


def _names(given: Names) -> Names:
    """The names of a module, with plain functions for kernels."""
    if id(given) not in NAMES:
        NAMES[id(given)] = made = dict(given)  # kept before it is filled: kernels call each other
        for name, value in given.items():
            if isinstance(value, Deferred):
                made[name] = plain(value)
            elif isinstance(value, ModuleType) and value.__name__.startswith("vv.engines."):
                made[name] = SimpleNamespace(**_names(vars(value)))
    return NAMES[id(given)]

"""Lets kernels ask which mutant is on; the copy that holds mutants has it as vv/switch_compiled.py.

The number is a word of the process that kernels read each time: it is no part of what is compiled.
numba is loaded when it asks for the type of these functions, so that files with kernels can be
imported without it, as those of the project can.
"""

import ctypes
import functools
import importlib
from collections.abc import Callable
from typing import Any

from vv import switch  # type: ignore[attr-defined]  # it is there in the copy

WORD = ctypes.c_int64(switch.ON)


class Known:
    """A function that numba knows, too."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self.function = function

    def __call__(self, *given: Any) -> Any:
        return self.function(*given)

    @functools.cached_property
    def _numba_type_(self) -> Any:
        return importlib.import_module("vv.switch_numba").type_of(self.function)


def _either(number: int, old: Any, new: Any) -> Any:
    """What is there, or what a mutant makes of it; where that is a whole number, one again."""
    return new if switch.on(number) else old


on, either = Known(switch.on), Known(_either)

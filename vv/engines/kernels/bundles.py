"""Bundles of arrays, which kernels pass on as one pointer.

A named tuple of twenty arrays has 150 words. numba disassembles and reassembles it wherever it is
passed or stored, and has to compile all that code. In kernels, a `bundle` is a pointer to fields
that never change; in Python it is an ordinary named tuple.
"""

from __future__ import annotations

import sys
from typing import Any, TypeVar, cast

Fields = TypeVar("Fields", bound=type)


class Bundled(type):
    """The class of named tuples that kernels make as bundles."""


UNKNOWN: list[tuple[type, type]] = []  # bundles not yet registered with numba


def bundle(origin: Fields) -> Fields:
    """Decorate a named tuple so that kernels pass it as a pointer; in Python it stays the same."""
    named = {name: getattr(origin, name) for name in ("__module__", "__doc__", "__qualname__")}
    made: Any = Bundled(origin.__name__, (origin,), {**named, "__slots__": ()})
    UNKNOWN.append((origin, made))
    if "numba" in sys.modules:
        register_all()
    return cast(Fields, made)


def register_all() -> None:
    """Register all bundles with numba."""
    from vv.engines.kernels.bundle_types import register

    while UNKNOWN:
        register(*UNKNOWN.pop())

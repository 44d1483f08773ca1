"""Bundles of arrays that kernels pass on as one pointer, where numba would pass every word of each.

A named tuple of twenty arrays is 150 words, which numba takes apart and puts together wherever
it is passed on or kept, and so that much code to compile. To kernels a `bundle` is a pointer to
its fields, which never change; from Python it is the named tuple that it was.
"""

from __future__ import annotations

import sys
from typing import Any, TypeVar, cast

Fields = TypeVar("Fields", bound=type)


class Bundled(type):
    """A named tuple that kernels make as a bundle."""


UNKNOWN: list[tuple[type, type]] = []  # bundles that numba does not know of yet


def bundle(origin: Fields) -> Fields:
    """Let kernels pass a named tuple on as a pointer; returns it, to be made as ever."""
    named = {name: getattr(origin, name) for name in ("__module__", "__doc__", "__qualname__")}
    made: Any = Bundled(origin.__name__, (origin,), {**named, "__slots__": ()})
    UNKNOWN.append((origin, made))
    if "numba" in sys.modules:
        introduce()
    return cast(Fields, made)


def introduce() -> None:
    """Let numba know of all bundles."""
    from vv.engines.kernels.bundle_types import learn

    while UNKNOWN:
        learn(*UNKNOWN.pop())

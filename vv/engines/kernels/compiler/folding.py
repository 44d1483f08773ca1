"""Writes code without taking out of a structure what was just put into it."""

from __future__ import annotations

from typing import Any

from llvmlite import ir

BUILDER: Any = ir.IRBuilder


class Folding(BUILDER):  # type: ignore[misc]
    """A builder of code that finds words of structures where they came from."""

    def extract_value(self, agg: Any, idx: Any, name: str = "") -> Any:
        """A word of a structure."""
        whole, path = origin(agg, tuple(idx) if isinstance(idx, list | tuple) else (idx,))
        return super().extract_value(whole, path, name) if path else whole


def origin(whole: Any, path: tuple[int, ...]) -> tuple[Any, tuple[int, ...]]:
    """Where a word of a structure was put in, as far as that can be followed, and its path there.

    An empty path says that the word itself was found.
    """
    while path and isinstance(whole, ir.instructions.InsertValue):
        put = tuple(whole.indices)
        if put == path[: len(put)]:
            whole, path = whole.operands[1], path[len(put) :]
        elif path == put[: len(path)]:
            return whole, path  # only a part of it was put in here
        else:
            whole = whole.operands[0]
    return whole, path


def together(builder: Any, kind: Any, *values: Any) -> Any:
    """A structure of values."""
    whole = ir.Constant(kind, ir.Undefined)
    for place, value in enumerate(values):
        whole = builder.insert_value(whole, value, place)
    return whole

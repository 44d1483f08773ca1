"""Generates code that does not extract from a structure what was just inserted into it."""

from __future__ import annotations

from typing import Any

from llvmlite import ir

BUILDER: Any = ir.IRBuilder


class Folding(BUILDER):  # type: ignore[misc]
    """A code builder that takes words of structures from where they were inserted."""

    def extract_value(self, agg: Any, idx: Any, name: str = "") -> Any:
        """A word of a structure, or the value that was inserted as this word."""
        whole, path = origin(agg, tuple(idx) if isinstance(idx, list | tuple) else (idx,))
        return super().extract_value(whole, path, name) if path else whole


def origin(whole: Any, path: tuple[int, ...]) -> tuple[Any, tuple[int, ...]]:
    """The value from which a word of a structure comes, as far as known, and its path in it.

    An empty path means that the value is the word itself.
    """
    while path and isinstance(whole, ir.instructions.InsertValue):
        put = tuple(whole.indices)
        if put == path[: len(put)]:
            whole, path = whole.operands[1], path[len(put) :]
        elif path == put[: len(path)]:
            return whole, path  # only a part of it was inserted here
        else:
            whole = whole.operands[0]
    return whole, path


def together(builder: Any, kind: Any, *values: Any) -> Any:
    """A structure of the given type made of values."""
    whole = ir.Constant(kind, ir.Undefined)
    for place, value in enumerate(values):
        whole = builder.insert_value(whole, value, place)
    return whole

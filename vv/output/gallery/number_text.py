"""Writes declared numbers as short texts: fields of frozen data, lists, and data of scenes."""

from __future__ import annotations

import dataclasses
import enum
import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from vv.scene import Vector

LISTED = 6  # the most numbers of a list that are written one by one
ROUNDING = 1e-9  # numbers below this part of the largest beside them are zero, but for rounding
DERIVED = ("body", "faces", "centroid")  # of bodies: numbers of order, or that vertices give
AXES = ("x", "y", "z")


def fields(thing: Any, name: str = "") -> Iterator[tuple[str, str]]:
    """The numbers in frozen data, with the names of the fields that lead to them.

    Prose, infinite limits, and fields that have their default value are left out.
    """
    if dataclasses.is_dataclass(thing):
        own = {one.name: getattr(thing, one.name) for one in dataclasses.fields(thing)
               if one.name == "value" or getattr(thing, one.name) != one.default}  # fmt: skip
        scalars = {key: _scalar(value) for key, value in own.items() if _scalar(value)}
        if scalars:
            yield name, ", ".join(f"{key} {text}" for key, text in scalars.items())
        yield from fields({key: one for key, one in own.items() if key not in scalars}, name)
    elif isinstance(thing, Mapping):
        for key, value in thing.items():
            word = key.value if isinstance(key, enum.Enum) else str(key)
            yield from fields(value, f"{name} {word}".strip())
    elif _scalar(thing):
        yield name, _scalar(thing)
    elif isinstance(thing, tuple) and any(True for _ in _flat(thing)):
        yield name, listed(np.array([*_flat(thing)]))


def _scalar(value: object) -> str:
    """The text of one number or choice; '' for anything else."""
    if isinstance(value, enum.Enum):
        return str(value.value)
    return f"{value:g}" if isinstance(value, int | float) and math.isfinite(value) else ""


def gathered(value: Any, name: str = "") -> Iterator[tuple[str, str]]:
    """Each field below a value in JSON with its numbers, those of all objects of a list together.

    Fields in which all numbers are zero are left out.
    """
    if isinstance(value, list) and value and isinstance(value[0], dict):
        keys = dict.fromkeys(key for one in value for key in one if key not in DERIVED)
        value = {key: [one.get(key) for one in value] for key in keys}
    if isinstance(value, dict):
        for key, one in value.items():
            if key not in DERIVED:
                yield from gathered(one, f"{name} {key}".strip())
    else:
        found = np.array([*_flat(value)])
        if found.any():
            yield name, _by_axis(found)


def _flat(value: Any) -> Iterator[float]:
    """The numbers in a value or in nested lists; nothing for prose."""
    if isinstance(value, list | tuple):
        for one in value:
            yield from _flat(one)
    elif isinstance(value, int | float):
        yield float(value)


def _by_axis(found: Vector) -> str:
    """Few numbers one by one; many in summary, vectors by their components."""
    if len(found) <= LISTED or len(found) % len(AXES):
        return listed(found)
    columns, scale = found.reshape(-1, len(AXES)).T, float(np.abs(found).max())
    texts = (listed(one, scale=scale) for one in columns)
    return "; ".join(f"{axis} {text}" for axis, text in zip(AXES, texts, strict=True))


def listed(found: Vector, digits: int = 6, scale: float = 0.0) -> str:
    """Few numbers one by one; the range and means of many. scale: the size of others beside them.

    Numbers that differ from zero, or from each other, by rounding only are written as equal.
    """
    small = ROUNDING * max([scale, *np.abs(found[np.isfinite(found)])])

    def text(value: float) -> str:
        return "0" if abs(value) <= small else f"{value:.{digits}g}"

    if len(found) <= LISTED:
        return ", ".join(map(text, found))
    low, high = float(found.min()), float(found.max())
    if high - low <= small:
        return f"{text(high)} in all"
    mean, square = found.mean(), np.sqrt(np.mean(found**2))
    return f"{text(low)} to {text(high)}, mean {text(mean)}, root mean square {text(square)}"

"""Writes the parts of commands: numbers, boxes, groups, files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from vv.scene import Vector

AXES = "xyz"
FEW = 100  # the most ids that are listed one by one


def numbers(values: Iterable[float]) -> str:
    """Numbers as LIGGGHTS reads them, with all their digits."""
    return " ".join(repr(float(value)) for value in values)


def bounds(low: Vector, high: Vector) -> str:
    """A box as a region of the style block reads it."""
    return numbers(np.column_stack([low, high]).ravel())


def group(name: str, indices: Sequence[int]) -> str:
    """The command that groups the spheres of these indices; ids count from 1.

    Consecutive ids are written as a range: LIGGGHTS searches all atoms for each id in a list.
    """
    first, many = min(indices), len(indices)
    if many > FEW and list(indices) == list(range(first, first + many)):
        return f"group           {name} id <> {first + 1} {first + many}"
    return f"group           {name} id {' '.join(str(i + 1) for i in indices)}"


def printed(file: str, lines: Iterable[str]) -> Iterator[str]:
    """Commands that write a file of these lines."""
    for number, line in enumerate(lines):
        yield f'print "{line}" {"append" if number else "file"} {file} screen no'


def parts(name: str, vector: Iterable[float]) -> str:
    """A vector as the command `set` takes it."""
    return " ".join(f"{name}{a} {x!r}" for a, x in zip(AXES, vector, strict=True))

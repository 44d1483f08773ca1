"""Damaged files: JSON with every part of a wrong type, or cut short."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterator
from typing import Any

CONTROL = "".join(map(chr, range(32)))
HOSTILE: tuple[Any, ...] = (
    None, True, -1, 1e300, "", "a", CONTROL, "\x1b[31m", [], ["a"], {}, {"a": 1}, [[[]]]
)  # fmt: skip


def cut_short(text: str, parts: int = 12) -> Iterator[str]:
    """The beginnings of a text, none of them whole, and the text with a byte of nonsense in it."""
    whole = text.rstrip()
    for k in range(parts):
        yield whole[: k * len(whole) // parts]
        yield whole[: k * len(whole) // parts] + "\0" + whole[k * len(whole) // parts :]


def of_wrong_types(text: str) -> Iterator[str]:
    """A JSON text with each of its parts, first of its kind in a place, as something else."""
    data = json.loads(text)
    for path in _paths(data):
        for value in HOSTILE:
            changed = copy.deepcopy(data)
            inner = changed
            for key in path[:-1]:
                inner = inner[key]
            inner[path[-1]] = value
            yield json.dumps(changed)
        if isinstance(path[-1], str):
            changed = copy.deepcopy(data)
            inner = changed
            for key in path[:-1]:
                inner = inner[key]
            inner[CONTROL] = inner.pop(path[-1])
            yield json.dumps(changed)


def _paths(data: Any) -> Iterator[list[Any]]:
    """Where the parts of a JSON text are; of a list the first only."""
    entries = data.items() if isinstance(data, dict) else list(enumerate(data))[:1]
    for key, one in entries:
        yield [key]
        if isinstance(one, dict | list):
            yield from ([key, *more] for more in _paths(one))

"""Caches exact histories, which several quantities and all codes share."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np

from vv.scene import Vector

T = TypeVar("T")
LATEST = 16  # sets of times for which a history is kept: outputs of a few settings


def remembered(history: Callable[[Vector], T]) -> Callable[[Vector], T]:
    """A function of times (k,) that is evaluated once for the same times.

    Returned arrays, alone or in a tuple, are made read-only, because they are shared.
    """
    known: dict[bytes, T] = {}

    def at(times: Vector) -> T:
        key = times.tobytes()
        if key not in known:
            if len(known) == LATEST:
                del known[next(iter(known))]
            known[key] = _read_only(history(times))
        return known[key]

    return at


def _read_only(found: T) -> T:
    for part in found if isinstance(found, tuple) else (found,):
        if isinstance(part, np.ndarray):
            part.setflags(write=False)
    return found

"""Reads plain values: texts, truths, whole numbers and finite numbers."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from typing import Any

from vv.records.codec.damaged import MISSING, refuse

Reader = Callable[[Any], Any]
LARGEST = sys.float_info.max


def _text(data: Any) -> str:
    return data if type(data) is str else refuse(data, "must be a text")


def _truth(data: Any) -> bool:
    return data if type(data) is bool else refuse(data, "must be true or false")


def whole(data: Any) -> int:
    """A whole number; raises DamagedError for anything else."""
    if type(data) is not int:
        refuse(data, "must be a whole number")
    number: int = data
    return number if abs(number) < 1 << 63 else refuse(MISSING, "must be below 2^63")


def number(data: Any) -> float:
    """A finite number; raises DamagedError for anything else."""
    if type(data) is not float and type(data) is not int:
        refuse(data, "must be a number")
    if not -LARGEST <= data <= LARGEST:
        refuse(MISSING, "must be finite")  # such as 1e999, which JSON reads as infinity
    read: float = data
    return read


PLAIN_READERS: Mapping[Any, Reader] = {str: _text, bool: _truth, int: whole, float: number}

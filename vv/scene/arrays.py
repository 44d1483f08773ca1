"""Checks the array fields of frozen dataclasses and makes them read-only."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

Vector = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]


def freeze(owner: Any, name: str, shape: tuple[int, ...], unit: str, kind: type = float) -> None:
    """Replace field `name` of `owner` by a read-only array of the given shape and type.

    Raises ValueError naming the field if its shape differs or a value is not finite.
    """
    array: npt.NDArray[Any] = np.array(getattr(owner, name), dtype=kind)
    label = f"{type(owner).__name__}.{name}"
    if array.shape != shape:
        raise ValueError(f"{label} has shape {array.shape}; it must be {shape}")
    if not np.isfinite(array).all():
        where = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise ValueError(f"{label}{list(where)} = {array[where]} {unit}; values must be finite")
    array.flags.writeable = False
    object.__setattr__(owner, name, array)

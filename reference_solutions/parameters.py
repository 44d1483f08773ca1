"""Checks of parameters of formulas; they raise ValueError with name, value and rule."""

from math import isfinite

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def require_times(t: ArrayLike) -> Array:
    """t [s] as an array. Raises ValueError unless all are finite and at least 0."""
    times = np.asarray(t, dtype=np.float64)
    bad = ~(np.isfinite(times) & (times >= 0.0))
    if bad.any():
        where = f"[{', '.join(str(i) for i in np.argwhere(bad)[0])}]" if times.ndim else ""
        raise ValueError(f"t{where} = {times[bad][0]} s; times must be finite and at least 0")
    return times


def require_finite(unit: str, **values: float) -> None:
    """Raises ValueError for a value that is not finite."""
    for name, value in values.items():
        if not isfinite(value):
            raise ValueError(f"{name} = {value} {unit}; it must be finite")


def require_positive(unit: str, **values: float) -> None:
    """Raises ValueError for a value that is not finite and positive."""
    for name, value in values.items():
        if not (isfinite(value) and value > 0.0):
            raise ValueError(f"{name} = {value} {unit}; it must be finite and positive")


def require_at_least_0(unit: str, **values: float) -> None:
    """Raises ValueError for a value that is not finite or is negative."""
    for name, value in values.items():
        if not (isfinite(value) and value >= 0.0):
            raise ValueError(f"{name} = {value} {unit}; it must be finite and at least 0")


def require_few(what: str, count: float, most: int) -> None:
    """Raises ValueError if more than `most` are to be solved, which would take many seconds."""
    if not count <= most:
        raise ValueError(f"{count:.4g} {what}; at most {most} are solved")


def require_acute(**degrees: float) -> None:
    """Raises ValueError for an angle that is not in [0, 90) degrees."""
    for name, value in degrees.items():
        if not 0.0 <= value < 90.0:
            raise ValueError(f"{name} = {value} degrees; it must be at least 0 and below 90")

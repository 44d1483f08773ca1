"""The largest values of smooth data, and the rate at which evenly spaced data grow."""

from __future__ import annotations

import numpy as np

from vv.scene import Vector


def smooth_maximum(rows: Vector) -> float:
    """The largest value of smooth data, from the parabola through the three largest."""
    i = int(np.clip(rows.argmax(), 1, len(rows) - 2))
    before, at, after = rows[i - 1 : i + 2]
    bend = before - 2.0 * at + after
    return float(at - 0.125 * (after - before) ** 2 / bend) if bend < 0 else float(at)


def growth(rows: Vector, every: float) -> Vector:
    """The rate of rows at times `every` [s] apart, without the first two and last two.

    By differences of fourth order.
    """
    near, far = rows[3:-1] - rows[1:-3], rows[4:] - rows[:-4]
    return np.asarray((8.0 * near - far) / (12.0 * every))

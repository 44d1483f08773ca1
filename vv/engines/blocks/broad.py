"""Finds pairs of blocks that are close: kernels that sweep bounding boxes along one axis."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index, Shapes
from vv.engines.blocks.sorting import ordered
from vv.engines.kernels.arrays import counts, larger, numbers, rows, smaller
from vv.engines.kernels.compiled import called
from vv.engines.kernels.triples import put
from vv.scene import Mask, Vector


@called
def bounds(shapes: Shapes, vertex: Vector) -> tuple[Vector, Vector]:
    """The least and greatest coordinates (n, 3) of each block [m]."""
    n = len(shapes.size)
    low, high = rows(n), rows(n)
    for i in range(n):
        put(low, i, (np.inf, np.inf, np.inf))
        put(high, i, (-np.inf, -np.inf, -np.inf))
        for k in range(shapes.vertex_start[i], shapes.vertex_start[i + 1]):
            for c in range(3):
                low[i, c] = smaller(low[i, c], vertex[k, c])
                high[i, c] = larger(high[i, c], vertex[k, c])
    return low, high


@called
def longer(found: Index) -> Index:
    """An array of twice the length that begins with the given one."""
    room = counts(2 * len(found))
    for k in range(len(found)):
        room[k] = found[k]
    return room


@called
def ascending(found: Index, count: int) -> Index:
    """The first `count` integers in ascending order."""
    order, result = ordered(found, count), counts(count)
    for k in range(count):
        result[k] = found[order[k]]
    return result


@called
def close_pairs(shapes: Shapes, vertex: Vector, moves: Mask, margin: float) -> Index:
    """Pairs a < b of blocks whose bounding boxes are within `margin` [m], as codes a n + b.

    The codes ascend. Pairs of two blocks that do not move are left out.
    """
    n = len(shapes.size)
    found, count = counts(4 * n), 0 * n
    if n < 2:
        return counts(count)
    low, high = bounds(shapes, vertex)
    least = numbers(n)
    for i in range(n):
        least[i] = low[i, 0]
    order = ordered(least, n)
    for p in range(n):
        i = order[p]
        for q in range(p + 1, n):
            j = order[q]
            if low[j, 0] > high[i, 0] + margin:
                break
            apart = larger(low[j, 1] - high[i, 1], low[i, 1] - high[j, 1])
            apart = larger(apart, low[j, 2] - high[i, 2])
            apart = larger(apart, low[i, 2] - high[j, 2])
            if apart <= margin and (moves[i] or moves[j]):
                if count == len(found):
                    found = longer(found)
                found[count] = smaller(i, j) * n + larger(i, j)
                count += 1
    return ascending(found, count)

"""Kernels that sort: those of numpy take seconds to compile, and are no faster on short arrays."""

from __future__ import annotations

from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import counts, smaller
from vv.engines.kernels.compiled import called
from vv.scene import Vector


@called
def ordered(key: Vector | Index, n: int) -> Index:
    """The indices (n,) that sort the first n keys in ascending order, by a stable merge sort."""
    run = 1
    order, spare = counts(n), counts(n)
    for k in range(n):
        order[k] = k
    while run < n:
        for low in range(0, n, 2 * run):
            middle, high = smaller(low + run, n), smaller(low + 2 * run, n)
            i, j = low, middle
            for k in range(low, high):
                if i < middle and (j >= high or key[order[i]] <= key[order[j]]):
                    spare[k], i = order[i], i + 1
                else:
                    spare[k], j = order[j], j + 1
        order, spare, run = spare, order, 2 * run
    return order

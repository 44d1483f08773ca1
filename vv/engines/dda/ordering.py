"""Orders the blocks of a scene so that the rows of the equations of DDA become short.

A row begins at the first block that its block touches, and the cost of a solution grows with the
squares of these lengths. Blocks of a long wall that are listed by course touch others a whole
course before them.
"""

from __future__ import annotations

import dataclasses

import numpy as np
import numpy.typing as npt

from vv.engines.blocks.geometry import Index
from vv.engines.dda.limits import REACH
from vv.scene import Block, Scene

Flags = npt.NDArray[np.bool_]
LESS = 0.5  # part of the cost at which another order is worth that results change by rounding


def short_rows(scene: Scene) -> tuple[Scene, Index]:
    """The scene with its blocks in the cheapest order, and the place (n,) of each block in it.

    The orders are the scene's own, unless another takes less than LESS of its cost, and those of
    the centroids along each axis.
    """
    blocks = scene.blocks
    low = np.array([block.vertices.min(axis=0) for block in blocks])
    high = np.array([block.vertices.max(axis=0) for block in blocks])
    reach = REACH * (high - low).max(axis=1).min()
    near = (low[:, None] <= high[None] + reach).all(axis=2)
    rows = [bool(block.free.any() or block.free_spin.any()) for block in blocks]
    near &= near.T & np.outer(rows, rows)  # blocks that are held have no rows
    np.fill_diagonal(near, val=True)
    orders = [np.argsort(at, kind="stable") for at in (0.5 * (low + high) @ scene.axes.T).T]
    costs = [_cost(near[np.ix_(order, order)]) for order in orders]
    own, best = np.arange(len(blocks)), orders[int(np.argmin(costs))]
    if not min(costs) < LESS * _cost(near):
        return scene, own
    place = np.empty_like(own)
    place[best] = own
    ordered = iter([blocks[i] for i in best])
    bodies = tuple(next(ordered) if isinstance(one, Block) else one for one in scene.bodies)
    return dataclasses.replace(scene, bodies=bodies), place


def _cost(near: Flags) -> float:
    """The sum of squares of the rows' lengths, in blocks; near: (n, n) whether two may touch."""
    lengths = np.arange(len(near)) - near.argmax(axis=1)
    return float((lengths**2).sum())

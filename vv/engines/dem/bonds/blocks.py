"""Arranges the bonds of a scene in blocks; a kernel computes a block in one vectorised loop."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from vv.engines.dem.rows import Index
from vv.scene import Vector

if TYPE_CHECKING:
    from vv.engines.dem.bonds.law import Springs

Ends = npt.NDArray[np.uint32]
Numbers = npt.NDArray[Any]

WIDE = 64  # bonds in a block
OFFSET, SLIP, FIRST, STRAINED, RADII, KN, KS, TENSION, SHEAR = 0, 3, 6, 7, 8, 10, 11, 12, 13
"""Places of the numbers of each bond in a block: a vector takes three places, the radii two."""
LIKE, ALL = KN, SHEAR + 1  # places in a block: if bonds are alike, if they differ
MOVED, STEP, SPIN_I, SPIN_J = 0, 3, 6, 9  # places in scratch: motion of ends
FORCE, TORQUE, ARMS, NORMAL, SHEARED, HIT, SCRATCH = 12, 15, 18, 20, 21, 22, 23
CHUNKS, LEAST = 8, 16  # most chunks; fewest blocks in a chunk


class Blocks(NamedTuple):
    """The bonds of a scene in k blocks, which are divided among c chunks.

    ends: rows of both spheres (k, 2 WIDE); table: numbers of the bonds (k, places x WIDE); like:
    kn, ks, tension and shear strength common to all bonds, None if they differ or ks is zero;
    share: chunk c has the blocks share[c] to share[c + 1] (exclusive); window: (c, 2) the rows that
    chunk c acts on, from the first to the last (exclusive), without the ground's. The chunks depend
    on the scene alone.
    """

    ends: Ends
    table: Vector
    like: tuple[float, float, float, float] | None
    share: Index
    window: Index


def bond_blocks(springs: Springs, own: Vector, ground: int, joined: bool = True) -> Blocks:
    """The blocks of springs (`law.py`); own: (4, b) kn, ks and both strengths of each bond.

    joined: whether a value common to all bonds is stored once.
    """
    rows, offset, first, strained, _, radius = springs
    # Without shear springs only kn is read: a common value is no faster than that of each bond.
    alike = bool(joined and own[1].any() and (own == own[:, :1]).all())
    numbers = np.zeros((LIKE if alike else ALL, len(rows)))
    numbers[OFFSET:SLIP], numbers[FIRST], numbers[STRAINED] = offset.T, first, strained
    numbers[RADII:KN] = radius.T
    if not alike:
        numbers[KN:] = own
    ends = _blocked(np.asarray(rows.T, np.uint32))
    chunks = max(1, min(CHUNKS, len(ends) // LEAST))
    share = np.arange(chunks + 1) * len(ends) // chunks
    kn, ks, tension, shear = own[:, 0].tolist()
    like = (kn, ks, tension, shear) if alike else None
    window = np.array([_window(rows[WIDE * a : WIDE * b], ground) for a, b in pairwise(share)])
    return Blocks(ends, _blocked(numbers), like, share, window)


def _blocked(numbers: Numbers) -> Numbers:
    """The array (places, b) as (k, places x WIDE); the last block is padded with zeros."""
    places, many = numbers.shape
    count = -(-many // WIDE)
    whole = np.zeros((places, count * WIDE), numbers.dtype)
    whole[:, :many] = numbers
    inner = whole.reshape(places, count, WIDE).transpose(1, 0, 2)
    return np.ascontiguousarray(inner.reshape(count, places * WIDE))


def _window(rows: Index, ground: int) -> tuple[int, int]:
    moving = rows[rows < ground]
    return int(moving.min()), int(moving.max()) + 1

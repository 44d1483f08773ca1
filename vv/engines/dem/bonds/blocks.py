"""Lays the bonds of a scene out in blocks, of which a kernel computes several bonds at a time."""

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
"""Where a block has a number of each of its bonds: vectors and radii take three places and two."""
LIKE, ALL = KN, SHEAR + 1  # places, where all bonds have the same stiffnesses and strengths or not
CHUNKS, LEAST = 8, 16  # into which bonds are shared out, and blocks in a chunk, at least


class Blocks(NamedTuple):
    """ends: rows of both spheres (k, 2 WIDE); table: numbers of the bonds (k, places x WIDE).

    like: kn, ks, tension and shear of all bonds, and None if they differ or none has shear springs;
    share: the blocks of chunk c go from share[c] to share[c + 1]; window: (c, 2) the first row it
    acts on, and the one after the last, but for the ground's. The shares depend on the scene alone.
    """

    ends: Ends
    table: Vector
    like: tuple[float, float, float, float] | None
    share: Index
    window: Index


def blocks(springs: Springs, own: Vector, ground: int) -> Blocks:
    """Lay out springs (`law.py`); own: (4, b) kn, ks, tension and shear of each bond."""
    rows, offset, first, strained, _, radius = springs
    # Without shear springs one stiffness is read, which is no gain over that of the bond itself.
    alike = bool(own[1].any() and (own == own[:, :1]).all())
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
    """(places, b) as (k, places x WIDE); the last block is filled up with zeros."""
    places, many = numbers.shape
    count = -(-many // WIDE)
    whole = np.zeros((places, count * WIDE), numbers.dtype)
    whole[:, :many] = numbers
    inner = whole.reshape(places, count, WIDE).transpose(1, 0, 2)
    return np.ascontiguousarray(inner.reshape(count, places * WIDE))


def _window(rows: Index, ground: int) -> tuple[int, int]:
    moving = rows[rows < ground]
    return int(moving.min()), int(moving.max()) + 1

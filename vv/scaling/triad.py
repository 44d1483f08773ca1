"""Measures the memory bandwidth by the triad of the STREAM benchmark: a = b + s c."""

from __future__ import annotations

import time

import numpy as np

LENGTH, BLOCK = 8_000_000, 16_384  # numbers in an array, which exceeds all caches, and in a block
ROUNDS, SCALE = 5, 3.0
COUNTED = 3 * 8  # bytes: two numbers are read for one that is written


def bandwidth() -> float:
    """The bytes per second of CPU time, the best of several rounds.

    Blocks of the product stay in the cache, so that memory traffic is that of the three arrays.
    """
    a, b, c = np.zeros(LENGTH), np.ones(LENGTH), np.ones(LENGTH)
    product, least = np.empty(BLOCK), np.inf
    for _ in range(ROUNDS):
        begun = time.process_time()
        for first in range(0, LENGTH, BLOCK):
            part = slice(first, min(first + BLOCK, LENGTH))
            scaled = np.multiply(c[part], SCALE, out=product[: part.stop - first])
            np.add(b[part], scaled, out=a[part])
        least = min(least, time.process_time() - begun)
    return COUNTED * LENGTH / max(least, 1e-9)


def least_traffic(contacts: float) -> float:
    """The bytes that a step must read and write for a sphere that is not in a cache.

    Its position, velocity and spin, and the shear spring of each contact, are read and written.
    """
    return 2 * 8 * (9 + 3 * contacts)

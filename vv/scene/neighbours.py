"""Finds the pairs of spheres that overlap, by a grid of cells, in linear time."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np

from vv.scene.arrays import Vector
from vv.scene.bodies import Spheres
from vv.scene.bonds import Pairs

MOST_CELLS = 2**20  # along an axis, so that the number of a cell fits into 63 bits
HALF = [step for step in itertools.product((-1, 0, 1), repeat=3) if step >= (0, 0, 0)]


def overlapping(spheres: Spheres, least: float = 0.0) -> Pairs:
    """The pairs i < j (k, 2) of spheres closer than (1 - least) of the sum of their radii.

    They are sorted by i, then j. A cell is as wide as the largest sphere, so that overlapping
    spheres lie in the same cell or in neighbouring ones.
    """
    pairs = np.concatenate([np.zeros((0, 2), np.int64), *_candidates(spheres)])
    i, j = np.sort(pairs, axis=1).T
    distance = np.linalg.norm(spheres.position[j] - spheres.position[i], axis=1)
    near = distance < (1 - least) * (spheres.radius[j] + spheres.radius[i])
    order = np.lexsort((j[near], i[near]))
    return np.column_stack([i[near], j[near]])[order]


def _candidates(spheres: Spheres) -> Iterator[Pairs]:
    """Pairs (k, 2) that lie in the same cell or in two that touch, each pair once."""
    if len(spheres) < 2:
        return
    numbers, strides = _cells(spheres.position, float(spheres.radius.max()))
    order = np.argsort(numbers, kind="stable")
    ordered = numbers[order]
    for step in HALF:
        wanted = ordered + int(np.dot(step, strides))
        first = np.searchsorted(ordered, wanted, side="left")
        last = np.searchsorted(ordered, wanted, side="right")
        if step == (0, 0, 0):
            first = np.arange(len(ordered)) + 1  # in the same cell: those that come after it
        one = np.repeat(np.arange(len(ordered)), last - first)
        started = np.repeat(np.cumsum(last - first) - (last - first), last - first)
        other = np.arange(len(one)) - started + np.repeat(first, last - first)
        yield np.column_stack([order[one], order[other]])


def _cells(position: Vector, radius: float) -> tuple[Pairs, Pairs]:
    """The number of each sphere's cell (n,), and how far apart neighbours along an axis are (3,).

    A margin of a cell around all of them keeps a step across the border from coming back inside.
    """
    low = position.min(axis=0)
    size = max(2 * radius, float(np.ptp(position, axis=0).max()) / MOST_CELLS) * (1 + 1e-9)
    place = np.floor((position - low) / size).astype(np.int64) + 1
    counts = place.max(axis=0) + 2
    strides = np.array([counts[1] * counts[2], counts[2], 1], np.int64)
    return place @ strides, strides

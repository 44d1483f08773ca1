"""Positions of the blocks of a facade: courses in running bond, door, window, lintels, arch.

The facade is symmetric about x = 0. Every function raises ValueError for a facade that has no room
for its openings.
"""

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from reference_solutions.parameters import require_few

Array = NDArray[np.float64]
VOUSSOIRS = 9
_MOST = 2000  # blocks: about a second of calculation


def areas(columns: int, courses: int, length: float, height: float) -> tuple[float, float]:
    """The areas [m2] of the courses, without openings, and of the arch, with chords as edges."""
    open_ = sum(2 * half * (top - low) for half, low, top in openings(columns, courses))
    inner, outer = rings(columns, length)
    chords = VOUSSOIRS * (outer**2 - inner**2) / 2 * math.sin(math.pi / VOUSSOIRS)
    return (columns * courses - open_) * length * height, chords


def openings(columns: int, courses: int) -> tuple[tuple[float, int, int], ...]:
    """Half width [blocks], first course and lintel's course of the door and of any window above."""
    if columns < 6 or columns % 2:
        raise ValueError(f"columns = {columns}; the number must be even and at least 6")
    if courses < 5:
        raise ValueError(f"courses = {courses}; the openings need at least 5")
    door = (1.0, 0, 3) if courses < 12 else (1.5, 0, 7)
    return (door,) if courses < 12 else (door, (1.0, 9, 12))


def courses(columns: int, courses: int, length: float) -> Iterator[tuple[int, float, float]]:
    """The course and the left and right ends [m] of each block, listed from the lower left."""
    gaps = openings(columns, courses)
    require_few("blocks", float(columns) * float(courses), _MOST)
    for course in range(courses):
        joints = np.arange(-columns / 2, columns / 2 + 0.25, 0.5)
        joints = joints[(course % 2) :: 2] if course % 2 else joints[::2]
        ends = {-columns / 2, columns / 2, *joints.tolist()}
        for half, first, lintel in gaps:
            if first <= course < lintel:
                ends = {x for x in ends if abs(x) > half} | {-half, half}
            if course == lintel:
                ends = {x for x in ends if abs(x) > half + 0.5} | {-half - 0.5, half + 0.5}
        row = sorted(ends)
        for left, right in pairwise(row):
            open_ = any(
                first <= course < lintel and abs(left + right) / 2 < half
                for half, first, lintel in gaps
            )
            if not open_:
                yield course, left * length, right * length


def rings(columns: int, length: float) -> tuple[float, float]:
    """The radii [m] of the circles on which the corners of voussoirs lie."""
    mean = length * min(columns / 2 - 1.0, 2.5)
    return 0.85 * mean, 1.15 * mean


def arch(columns: int, length: float) -> list[Array]:
    """The corners (4, 2) [m] of each voussoir of a semicircular arch that springs from height 0."""
    inner, outer = rings(columns, length)
    angle = np.linspace(0.0, np.pi, VOUSSOIRS + 1)
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return [
        np.array([inner * ring[k], outer * ring[k], outer * ring[k + 1], inner * ring[k + 1]])
        for k in range(VOUSSOIRS)
    ]

"""Kernels that order the equations of blocks with few neighbours in a band, and solve them."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import counts, larger, same_counts, smaller
from vv.engines.kernels.compiled import called, inlined, lent
from vv.engines.rigid.solver.assembly import Bodies, Joints
from vv.scene import Vector


@inlined
def can_move(bodies: Bodies, i: int) -> bool:
    """Whether impulses can move a body."""
    free = bodies.inverse[i, 0, 0] + bodies.inverse[i, 1, 1] + bodies.inverse[i, 2, 2]
    turns = bodies.inverse_spin[i, 0, 0] + bodies.inverse_spin[i, 1, 1]
    return bool(free + turns + bodies.inverse_spin[i, 2, 2] > 0.0)


@inlined
def coupled(joints: Joints, c: int, bodies: Bodies) -> bool:
    """Whether a contact couples two bodies: both can move."""
    return can_move(bodies, joints.first[c]) and can_move(bodies, joints.second[c])


@called
def neighbours(joints: Joints, bodies: Bodies, blocks: int) -> tuple[Index, Index]:
    """The blocks coupled to each block i: other[start[i]:start[i + 1]], some of them repeated."""
    start = counts(blocks + 1)
    for i in range(blocks + 1):
        start[i] = 0
    for c in range(len(joints.first)):
        if coupled(joints, c, bodies):
            start[joints.first[c] + 1] += 1
            start[joints.second[c] + 1] += 1
    for i in range(blocks):
        start[i + 1] += start[i]
    other, filled = counts(start[blocks]), same_counts(start, blocks)
    for c in range(len(joints.first)):
        a, b = joints.first[c], joints.second[c]
        if coupled(joints, c, bodies):
            other[filled[a]], other[filled[b]] = b, a
            filled[a] += 1
            filled[b] += 1
    return start, other


@called
def number_layers(
    place: Index, start: Index, other: Index, root: int, count: int
) -> tuple[int, int]:
    """Number the unnumbered blocks connected to `root` from `count` on, by breadth-first search.

    place: (n,) the numbers, -1 for unnumbered blocks. Returns the count after that, and the last
    block that was numbered.
    """
    queue, done, last = counts(len(place)), 0, root
    queue[0], place[root] = root, count
    many = done + 1
    while done < many:
        i = queue[done]
        last, done = i, done + 1
        for k in range(start[i], start[i + 1]):
            j = other[k]
            if place[j] < 0:
                place[j], queue[many] = count + many, j
                many += 1
    return count + many, last


@called
def band_ordering(joints: Joints, bodies: Bodies, blocks: int) -> tuple[Index, int]:
    """An ordering (n,) in which coupled blocks are close, and the largest distance of two of them.

    Blocks are numbered by breadth-first search from a block far from others (Cuthill and McKee
    1969).
    """
    start, other = neighbours(joints, bodies, blocks)
    place, count = counts(blocks), 0 * blocks
    for i in range(blocks):
        place[i] = -1
    for root in range(blocks):
        if place[root] < 0:
            trial = same_counts(place, blocks)
            _, far = number_layers(trial, start, other, root, count)
            count, _ = number_layers(place, start, other, far, count)
    apart = 0 * blocks
    for c in range(len(joints.first)):
        if coupled(joints, c, bodies):
            apart = larger(apart, abs(place[joints.first[c]] - place[joints.second[c]]))
    return place, apart


@called
def equation_numbers(bodies: Bodies, place: Index) -> tuple[Index, int]:
    """The equation (6 n,) of each of the six velocities of each block, and the number of equations.

    Equations follow the ordering `place` (n,) of the blocks; -1 for a locked velocity.
    """
    blocks, count = len(place), 0 * len(place)
    block, row = counts(blocks), counts(6 * blocks)
    for i in range(blocks):
        block[place[i]] = i
    for k in range(blocks):
        i = block[k]
        for r in range(6):
            free = bodies.inverse[i, r, r] if r < 3 else bodies.inverse_spin[i, r - 3, r - 3]
            row[6 * i + r] = count if free > 0.0 else -1
            count += 1 if free > 0.0 else 0
    return row, count


@called
def half_width(joints: Joints, row: Index, blocks: int) -> int:
    """The half-width of the band of the equations `row` that `equation_numbers` returns."""
    far = 5 + 0 * blocks
    for c in range(len(joints.first)):
        a, b = joints.first[c], joints.second[c]
        if a < blocks and b < blocks:
            for k in range(6):
                for r in range(6):
                    one, two = row[6 * a + k], row[6 * b + r]
                    if one >= 0 and two >= 0:
                        far = larger(far, abs(one - two))
    return far


@inlined
def subtract(
    matrix: Vector, i: int, k: int, at_i: np.uint64, at_k: np.uint64, many: np.uint64, part: float
) -> None:
    """Subtract `part` times `many` elements of row k, from at_k on, from those of row i, from at_i.

    Indices are unsigned: a loop over indices that may be negative is not vectorised and takes six
    times as long.
    """
    for j in range(many):
        matrix[i, at_i + j] -= part * matrix[k, at_k + j]


@lent
def eliminate(matrix: Vector, right: Vector, half: int) -> None:
    """Replace right (m,) by the solution of a banded system; the matrix is overwritten.

    matrix: (m, 3 half + 1), with element (i, j) in row i and column j - i + half, zero farther than
    `half` from the diagonal. Gaussian elimination; its pivots fill the other columns, of which only
    those are computed that rows taken as pivots so far can fill: few, as most are on the diagonal.
    """
    last, most = len(right) - 1, 0
    for k in range(len(right)):
        best, low = k, smaller(k + half, last)
        for i in range(k + 1, low + 1):
            if abs(matrix[i, k - i + half]) > abs(matrix[best, k - best + half]):
                best = i
        most = larger(most, smaller(best + half, last))
        if best != k:
            for j in range(k, most + 1):
                one, two = matrix[k, j - k + half], matrix[best, j - best + half]
                matrix[k, j - k + half], matrix[best, j - best + half] = two, one
            right[k], right[best] = right[best], right[k]
        for i in range(k + 1, low + 1):
            part = matrix[i, k - i + half] / matrix[k, half]
            if part != 0.0:
                here, there = np.uint64(half + 1 + k - i), np.uint64(half + 1)
                subtract(matrix, i, k, here, there, np.uint64(most - k), part)
                right[i] -= part * right[k]
    for k in range(last, -1, -1):
        for j in range(k + 1, smaller(k + 2 * half, last) + 1):
            right[k] -= matrix[k, j - k + half] * right[j]
        right[k] /= matrix[k, half]

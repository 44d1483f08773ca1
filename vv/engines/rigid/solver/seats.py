"""Assigns contacts to batches: those of one pair of bodies to a lane, and pairs to a batch."""

from __future__ import annotations

from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import counts, larger, same_counts, zero_counts
from vv.engines.kernels.compiled import called
from vv.engines.rigid.solver.assembly import Bodies, Joints
from vv.engines.rigid.solver.banded import can_move

LANES = 8
DEPTH = 8  # most contacts of a pair in a lane; further contacts go to another lane


@called
def runs(joints: Joints) -> tuple[Index, Index]:
    """The run (c,) of each contact, -1 if it cannot act, and the first contact (r,) of each run.

    A run is a sequence of at most DEPTH contacts between the same two bodies.
    """
    count = len(joints.first)
    run, begin, many, size = counts(count), counts(count + 1), 0 * count, 0 * count
    for c in range(count):
        run[c] = -1
        if joints.across[c] <= 0.0:
            continue
        b = begin[many - 1] if many > 0 else c
        same = joints.first[b] == joints.first[c] and joints.second[b] == joints.second[c]
        if many == 0 or size == DEPTH or not same:
            begin[many] = c
            many, size = many + 1, 0
        run[c] = many - 1
        size += 1
    return run, same_counts(begin, many)


@called
def seated(joints: Joints, bodies: Bodies, run: Index, begin: Index) -> tuple[Index, Index]:
    """The seat (r,) of each run, batch times LANES plus lane, and the depth (k,) of each batch.

    The longest runs are seated first, each in the first batch with a free lane that contains none
    of its moving bodies.
    """
    many, b = len(begin), len(bodies.centre)
    size, degree, most = zero_counts(many), zero_counts(b), 0 * many
    for c in range(len(run)):
        if run[c] >= 0:
            size[run[c]] += 1
    for r in range(many):
        for body in (joints.first[begin[r]], joints.second[begin[r]]):
            degree[body] += 1
            if can_move(bodies, body):
                most = larger(most, degree[body])
    limit = many // LANES + 2 * most + 1
    taken = zero_counts(b * limit)
    seat, filled, depth = counts(many), zero_counts(limit), zero_counts(limit)
    begun, last = 0 * many, 0 * many
    for less in range(DEPTH):
        for r in range(many):
            if size[r] != DEPTH - less:
                continue
            one, two = joints.first[begin[r]], joints.second[begin[r]]
            k = begun
            while filled[k] == LANES or taken[one * limit + k] + taken[two * limit + k] > 0:
                k += 1
            seat[r] = k * LANES + filled[k]
            filled[k] += 1
            depth[k] = larger(depth[k], size[r])
            last = larger(last, k + 1)
            taken[one * limit + k] += 1 if can_move(bodies, one) else 0
            taken[two * limit + k] += 1 if can_move(bodies, two) else 0
            while filled[begun] == LANES:
                begun += 1
    return seat, same_counts(depth, last)

"""Contacts in batches of eight that share no moving body, so that one instruction serves all.

A sweep in order waits for each contact before it goes to the next. Those of a batch do not see one
another, and their numbers lie side by side: a compiler makes a loop over them one of wide
instructions, at a third of the time. It must know how far apart the fields of a batch are, so that
these are records.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from vv.engines.blocks.geometry import Index
from vv.engines.kernels import rooms
from vv.engines.kernels.arrays import counts, larger, nil_counts, square_of
from vv.engines.kernels.compiled import called, inlined, lent
from vv.engines.kernels.triples import Triple, at
from vv.engines.rigid.solver.assembly import Bodies, Joints
from vv.engines.rigid.solver.banded import moving
from vv.engines.rigid.solver.cone import Friction, limit
from vv.scene import Vector

LANES = 8
Record = Any  # an element of an array of BATCH or PAIRS, whose fields are arrays


def _field(numbers: int) -> tuple[type, tuple[int, int]]:
    return (np.float64, (numbers, LANES))


BATCH = np.dtype(
    [
        ("filled", np.uint64),  # unsigned, or lanes counted up to it might be negative
        ("first", np.int64, LANES),  # rows of the velocities
        ("second", np.int64, LANES),
        *((name, *_field(3)) for name in ("normal", "arm_first", "arm_second", "pull")),
        *((name, *_field(3)) for name in ("p", "last", "centre")),
        *((name, *_field(6)) for name in ("inverse_first", "spin_first")),
        *((name, *_field(6)) for name in ("inverse_second", "spin_second")),
        *((name, np.float64, LANES) for name in ("need", "across", "along", "radius", "stiff")),
    ]
)
"""Up to eight contacts, so many as are filled. As in `Joints` and `Friction`, but for these.

across, along: the inverses of those [kg], nil where they are nil; stiff: the square of the larger
[1/kg2]; centre, radius: those of `limit`, for a unit impulse; last: p a sweep before; inverses of
masses and inertias as `upper` has them.
"""

PAIRS = np.dtype(
    [
        *((name, *_field(3)) for name in ("v_first", "w_first", "v_second", "w_second")),
        ("square", np.float64, LANES),
        ("largest", np.float64, LANES),
    ]
)
"""Velocities of the bodies of a batch, and what impulses changed by: see `changed`."""

batch_room, pairs_room = rooms.of_records(BATCH), rooms.of_records(PAIRS)


@called
def batched(joints: Joints, bodies: Bodies) -> Index:
    """The place (c,) of each contact, its batch times LANES and its lane; -1 where none can push.

    Each goes to the first batch with room that none of its moving bodies is in.
    """
    count, b = len(joints.first), len(bodies.centre)
    degree, most = nil_counts(b), 0 * count
    for c in range(count):
        for body in (joints.first[c], joints.second[c]):
            degree[body] += 1
            if moving(bodies, body):
                most = larger(most, degree[body])
    limit = count // LANES + 2 * most + 1
    taken = nil_counts(b * limit)
    place, filled, begin = counts(count), nil_counts(limit), 0 * count
    for c in range(count):
        place[c] = -1
        if joints.across[c] <= 0.0:
            continue
        one, two, k = joints.first[c] * limit, joints.second[c] * limit, begin
        while filled[k] == LANES or taken[one + k] + taken[two + k] > 0:
            k += 1
        place[c] = k * LANES + filled[k]
        filled[k] += 1
        taken[one + k] += 1 if moving(bodies, joints.first[c]) else 0
        taken[two + k] += 1 if moving(bodies, joints.second[c]) else 0
        while filled[begin] == LANES:
            begin += 1
    return place


@called
def packed(p: Vector, joints: Joints, bodies: Bodies, friction: Friction, place: Index) -> Record:
    """The batches of contacts with impulses p (c, 3), for their places from `batched`."""
    many = 0 * len(p)
    for c in range(len(p)):
        many = larger(many, place[c] // LANES + 1)
    batches = batch_room(many)
    for k in range(many):
        batches[k].filled = 0
    for c in range(len(p)):
        if place[c] >= 0:
            batch, lane = batches[place[c] // LANES], place[c] % LANES
            batch.filled = lane + 1
            fill(batch, lane, c, joints, bodies, friction)
            set_lane(batch.p, lane, at(p, c))
            set_lane(batch.last, lane, at(p, c))
    return batches


@lent
def fill(
    batch: Record, lane: int, c: int, joints: Joints, bodies: Bodies, friction: Friction
) -> None:
    """Write all but the impulse of a contact into a lane."""
    a, b = joints.first[c], joints.second[c]
    batch.first[lane], batch.second[lane] = a, b
    set_lane(batch.normal, lane, at(joints.normal, c))
    set_lane(batch.arm_first, lane, at(joints.arm_first, c))
    set_lane(batch.arm_second, lane, at(joints.arm_second, c))
    set_lane(batch.pull, lane, at(joints.pull, c))
    upper(batch.inverse_first, lane, bodies.inverse, a)
    upper(batch.inverse_second, lane, bodies.inverse, b)
    upper(batch.spin_first, lane, bodies.inverse_spin, a)
    upper(batch.spin_second, lane, bodies.inverse_spin, b)
    batch.need[lane], batch.across[lane] = friction.need[c], 1.0 / joints.across[c]
    batch.along[lane] = 1.0 / joints.along[c] if joints.along[c] > 0.0 else 0.0
    batch.stiff[lane] = square_of(larger(joints.across[c], joints.along[c]))
    centre, radius = limit(friction.mu, at(friction.d, c), at(friction.turn, c))
    set_lane(batch.centre, lane, centre)
    batch.radius[lane] = radius


@inlined
def upper(field: Vector, lane: int, matrices: Vector, i: int) -> None:
    """Write the symmetric matrices[i] (3, 3) into a lane: xx, xy, xz, yy, yz, zz."""
    k = 0
    for row in range(3):
        for column in range(row, 3):
            field[k, lane] = matrices[i, row, column]
            k += 1


@lent
def unpacked(p: Vector, batches: Record, place: Index) -> None:
    """Fill p (c, 3) with the impulses of batches."""
    for c in range(len(p)):
        if place[c] >= 0:
            batch, lane = batches[place[c] // LANES], place[c] % LANES
            for k in range(3):
                p[c, k] = batch.p[k, lane]


@inlined
def lane_of(field: Vector, lane: int) -> Triple:
    """The three numbers of a lane."""
    return field[0, lane], field[1, lane], field[2, lane]


@inlined
def set_lane(field: Vector, lane: int, a: Triple) -> None:
    """Write the three numbers of a lane."""
    field[0, lane], field[1, lane], field[2, lane] = a

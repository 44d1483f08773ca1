"""Contacts in batches of eight that share no moving body, so that one instruction serves all.

A sweep in order waits for each contact before it goes to the next. Those of a batch do not see one
another, and their numbers lie side by side: a compiler makes a loop over them one of wide
instructions, at a third of the time. Faces touch at several corners: a batch has the contacts of
eight pairs of bodies, one of each pair in a layer, so that what is known of the bodies is fetched
once for all of them, which would take longer than to compute a layer. A compiler must know how far
apart fields are, so that these are records.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from vv.engines.blocks.geometry import Index
from vv.engines.kernels import rooms
from vv.engines.kernels.arrays import counts, larger, square_of
from vv.engines.kernels.compiled import called, inlined, lent
from vv.engines.kernels.triples import Triple, at
from vv.engines.rigid.solver.assembly import Bodies, Joints
from vv.engines.rigid.solver.cone import Friction, limit
from vv.engines.rigid.solver.seats import LANES, runs, seated
from vv.scene import Vector

Record = Any  # an element of an array of BATCH, LAYER or PAIRS, whose fields are arrays


def _field(numbers: int) -> tuple[type, tuple[int, int]]:
    return (np.float64, (numbers, LANES))


BATCH = np.dtype(
    [
        ("filled", np.uint64),  # unsigned, or lanes counted up to it might be negative
        ("lanes", np.uint64),
        ("begin", np.int64),
        ("end", np.int64),
        ("first", np.int64, LANES),  # rows of the velocities
        ("second", np.int64, LANES),
        *((name, *_field(6)) for name in ("inverse_first", "spin_first")),
        *((name, *_field(6)) for name in ("inverse_second", "spin_second")),
    ]
)
"""Up to eight pairs of bodies, so many as are filled, whose contacts are layers[begin:end].

lanes: LANES, which a compiler must not know, or it would make no vectors of a loop so short;
inverses of masses and inertias as `upper` has them.
"""

LAYER = np.dtype(
    [
        *((name, *_field(3)) for name in ("normal", "arm_first", "arm_second", "pull")),
        *((name, *_field(3)) for name in ("p", "last", "centre")),
        *((name, np.float64, LANES) for name in ("need", "across", "along", "radius", "stiff")),
    ]
)
"""A contact of each pair of a batch; all nil where a pair has none, which pushes nothing.

As in `Joints` and `Friction`, but for across, along: the inverses of those [kg], nil where they are
nil; stiff: the square of the larger [1/kg2]; centre, radius: those of `limit`, for a unit impulse;
last: p a sweep before.
"""

PAIRS = np.dtype(
    [
        *((name, *_field(3)) for name in ("v_first", "w_first", "v_second", "w_second")),
        ("square", np.float64, LANES),
        ("largest", np.float64, LANES),
    ]
)
"""Velocities of the bodies of a batch, and what impulses changed by: see `changed`."""

batch_room, layer_room, pairs_room = map(rooms.of_nil_records, (BATCH, LAYER, PAIRS))


@called
def packed(
    p: Vector, joints: Joints, bodies: Bodies, friction: Friction
) -> tuple[Record, Record, Index]:
    """The batches and layers of contacts with impulses p (c, 3).

    With the place (c,) of each contact, its layer times LANES and its lane; -1 where none can push.
    """
    run, begin = runs(joints)
    seat, depth = seated(joints, bodies, run, begin)
    batches, place, layer = batch_room(len(depth)), counts(len(p)), 0 * len(p)
    for k in range(len(depth)):
        batches[k].lanes, batches[k].begin = LANES, layer
        layer += depth[k]
        batches[k].end = layer
    layers = layer_room(layer)
    nth = 0 * layer
    for c in range(len(p)):
        place[c], r = -1, run[c]
        if r >= 0:
            nth = 0 if begin[r] == c else nth + 1
            batch, lane = batches[seat[r] // LANES], seat[r] % LANES
            if nth == 0:
                fill_pair(batch, lane, joints.first[c], joints.second[c], bodies)
            here = batch.begin + nth
            fill(layers[here], lane, c, joints, friction)
            set_lane(layers[here].p, lane, at(p, c))
            set_lane(layers[here].last, lane, at(p, c))
            place[c] = here * LANES + lane
    return batches, layers, place


@lent
def fill_pair(batch: Record, lane: int, a: int, b: int, bodies: Bodies) -> None:
    """Write two bodies into a lane."""
    batch.filled = larger(batch.filled, np.uint64(lane + 1))
    batch.first[lane], batch.second[lane] = a, b
    upper(batch.inverse_first, lane, bodies.inverse, a)
    upper(batch.inverse_second, lane, bodies.inverse, b)
    upper(batch.spin_first, lane, bodies.inverse_spin, a)
    upper(batch.spin_second, lane, bodies.inverse_spin, b)


@lent
def fill(layer: Record, lane: int, c: int, joints: Joints, friction: Friction) -> None:
    """Write all but the impulse of a contact into a lane."""
    set_lane(layer.normal, lane, at(joints.normal, c))
    set_lane(layer.arm_first, lane, at(joints.arm_first, c))
    set_lane(layer.arm_second, lane, at(joints.arm_second, c))
    set_lane(layer.pull, lane, at(joints.pull, c))
    layer.need[lane], layer.across[lane] = friction.need[c], 1.0 / joints.across[c]
    layer.along[lane] = 1.0 / joints.along[c] if joints.along[c] > 0.0 else 0.0
    layer.stiff[lane] = square_of(larger(joints.across[c], joints.along[c]))
    centre, radius = limit(friction.mu, at(friction.d, c), at(friction.turn, c))
    set_lane(layer.centre, lane, centre)
    layer.radius[lane] = radius


@inlined
def upper(field: Vector, lane: int, matrices: Vector, i: int) -> None:
    """Write the symmetric matrices[i] (3, 3) into a lane: xx, xy, xz, yy, yz, zz."""
    k = 0
    for row in range(3):
        for column in range(row, 3):
            field[k, lane] = matrices[i, row, column]
            k += 1


@lent
def unpacked(p: Vector, layers: Record, place: Index) -> None:
    """Fill p (c, 3) with the impulses of layers."""
    for c in range(len(p)):
        if place[c] >= 0:
            layer, lane = layers[place[c] // LANES], place[c] % LANES
            for k in range(3):
                p[c, k] = layer.p[k, lane]


@inlined
def lane_of(field: Vector, lane: int) -> Triple:
    """The three numbers of a lane."""
    return field[0, lane], field[1, lane], field[2, lane]


@inlined
def set_lane(field: Vector, lane: int, a: Triple) -> None:
    """Write the three numbers of a lane."""
    field[0, lane], field[1, lane], field[2, lane] = a

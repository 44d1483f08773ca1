"""Contacts in batches of eight that share no moving body, so that SIMD instructions can solve them.

In a sweep over single contacts, each waits for the one before. The contacts of a batch are
independent, and their data lie side by side: the compiler vectorises a loop over them, which takes
a third of the time. Since faces touch at several corners, a batch holds the contacts of eight pairs
of bodies, with one contact of each pair in a layer. The data of the bodies are then fetched once
for all layers; fetching takes longer than computing a layer. Batches are records, because the
compiler must know the offsets of fields.
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
from vv.engines.rigid.solver.cone import limit
from vv.engines.rigid.solver.problem import Friction
from vv.engines.rigid.solver.seats import LANES, runs, seated
from vv.scene import Vector

Record = Any  # an element of an array of BATCH, LAYER or PAIRS, whose fields are arrays


def _field(numbers: int) -> tuple[type, tuple[int, int]]:
    return (np.float64, (numbers, LANES))


BATCH = np.dtype(
    [
        ("filled", np.uint64),  # unsigned, so that lane numbers cannot be negative
        ("lanes", np.uint64),
        ("begin", np.int64),
        ("end", np.int64),
        ("first", np.int64, LANES),  # rows of the velocities
        ("second", np.int64, LANES),
        *((name, *_field(6)) for name in ("inverse_first", "spin_first")),
        *((name, *_field(6)) for name in ("inverse_second", "spin_second")),
    ]
)
"""Up to eight pairs of bodies, whose contacts are layers[begin:end].

filled: the number of pairs; lanes: always LANES, as a variable, since the compiler does not
vectorise a loop known to be so short; inverse masses and inertias in the form of `upper`.
"""

LAYER = np.dtype(
    [
        *((name, *_field(3)) for name in ("normal", "arm_first", "arm_second", "pull")),
        *((name, *_field(3)) for name in ("p", "last", "centre")),
        *((name, np.float64, LANES) for name in ("need", "across", "along", "radius", "stiff")),
    ]
)
"""One contact of each pair of a batch; all zero, and without effect, for a pair that has none.

Fields are those of `Joints` and `Friction`, except: across, along: inverses of the mobilities [kg],
zero where these are zero; stiff: the square of the larger mobility [1/kg2]; centre, radius: those
of `limit` for a unit normal impulse; p: impulse; last: p after the sweep before.
"""

PAIRS = np.dtype(
    [
        *((name, *_field(3)) for name in ("v_first", "w_first", "v_second", "w_second")),
        ("square", np.float64, LANES),
        ("largest", np.float64, LANES),
    ]
)
"""Velocities of the bodies of a batch, and the changes of impulses in a sweep: see `change_of`."""

batch_room, layer_room, pairs_room = map(rooms.of_zero_records, (BATCH, LAYER, PAIRS))


@called
def packed(
    p: Vector, joints: Joints, bodies: Bodies, friction: Friction
) -> tuple[Record, Record, Index]:
    """The batches and layers of contacts with impulses p (c, 3), and the places (c,) of contacts.

    A place is the layer times LANES plus the lane, or -1 for a contact that cannot act.
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
    """Write the data of two bodies into a lane."""
    batch.filled = larger(batch.filled, np.uint64(lane + 1))
    batch.first[lane], batch.second[lane] = a, b
    upper(batch.inverse_first, lane, bodies.inverse, a)
    upper(batch.inverse_second, lane, bodies.inverse, b)
    upper(batch.spin_first, lane, bodies.inverse_spin, a)
    upper(batch.spin_second, lane, bodies.inverse_spin, b)


@lent
def fill(layer: Record, lane: int, c: int, joints: Joints, friction: Friction) -> None:
    """Write the data of a contact, without its impulse, into a lane."""
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
    """Write the symmetric matrices[i] (3, 3) into a lane as xx, xy, xz, yy, yz, zz."""
    k = 0
    for row in range(3):
        for column in range(row, 3):
            field[k, lane] = matrices[i, row, column]
            k += 1


@lent
def unpacked(p: Vector, layers: Record, place: Index) -> None:
    """Fill p (c, 3) with the impulses in layers."""
    for c in range(len(p)):
        if place[c] >= 0:
            layer, lane = layers[place[c] // LANES], place[c] % LANES
            for k in range(3):
                p[c, k] = layer.p[k, lane]


@inlined
def lane_of(field: Vector, lane: int) -> Triple:
    """The three numbers in a lane."""
    return field[0, lane], field[1, lane], field[2, lane]


@inlined
def set_lane(field: Vector, lane: int, a: Triple) -> None:
    """Write three numbers into a lane."""
    field[0, lane], field[1, lane], field[2, lane] = a

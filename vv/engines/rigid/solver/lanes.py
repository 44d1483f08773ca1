"""A sweep over batches of contacts: `cone.sweep` for several contacts at once."""

from __future__ import annotations

import numpy as np

from vv.engines.kernels.arrays import larger
from vv.engines.kernels.compiled import inlined, lent
from vv.engines.kernels.triples import Triple, add_scaled, cross, dot
from vv.engines.rigid.solver.batches import Record, lane_of, set_lane
from vv.engines.rigid.solver.seats import LANES
from vv.scene import Vector


@inlined
def fetch(pairs: Record, batch: Record, velocities: Vector) -> None:
    """Copy the velocities (b, 6) of a batch's bodies into the lanes of pairs."""
    for lane in range(batch.filled):
        a, b = batch.first[lane], batch.second[lane]
        for k in range(3):
            pairs.v_first[k, lane], pairs.w_first[k, lane] = velocities[a, k], velocities[a, 3 + k]
            pairs.v_second[k, lane] = velocities[b, k]
            pairs.w_second[k, lane] = velocities[b, 3 + k]


@inlined
def give_back(pairs: Record, batch: Record, velocities: Vector) -> None:
    """Copy the velocities of a batch's bodies back to their rows (b, 6)."""
    for lane in range(batch.filled):
        a, b = batch.first[lane], batch.second[lane]
        for k in range(3):
            velocities[a, k], velocities[a, 3 + k] = pairs.v_first[k, lane], pairs.w_first[k, lane]
            velocities[b, k] = pairs.v_second[k, lane]
            velocities[b, 3 + k] = pairs.w_second[k, lane]


@inlined
def relative_in_lane(pairs: Record, layer: Record, lane: int) -> Triple:
    """The relative velocity of the contact in a lane [m/s]."""
    one = cross(lane_of(pairs.w_first, lane), lane_of(layer.arm_first, lane))
    two = cross(lane_of(pairs.w_second, lane), lane_of(layer.arm_second, lane))
    u = add_scaled(lane_of(pairs.v_second, lane), -1.0, lane_of(pairs.v_first, lane))
    return add_scaled(add_scaled(u, 1.0, two), -1.0, one)


@inlined
def normal_step(layer: Record, lane: int, u: Triple, had: float) -> float:
    """The normal impulse [N s] after one projected step from `had`."""
    n = lane_of(layer.normal, lane)
    wanted = had - (dot(u, n) - layer.need[lane]) * layer.across[lane]
    return wanted if wanted > 0.0 else 0.0


@inlined
def tangential_step(layer: Record, lane: int, u: Triple, p: Triple, normal: float) -> Triple:
    """The tangential impulse after one projected step from p, for a given normal impulse [N s]."""
    n = lane_of(layer.normal, lane)
    flat = add_scaled(p, -dot(p, n), n)
    flat = add_scaled(flat, -layer.along[lane], add_scaled(u, -dot(u, n), n))
    centre = add_scaled((0.0, 0.0, 0.0), normal, lane_of(layer.centre, lane))
    left = add_scaled(flat, -1.0, centre)
    size, radius = np.sqrt(dot(left, left)), normal * layer.radius[lane]
    return add_scaled(centre, radius / size if size > radius else 1.0, left)


@inlined
def add_impulse(velocity: Vector, inverse: Vector, lane: int, sign: float, p: Triple) -> None:
    """Add `sign` times the effect of an impulse, or of its moment, to a velocity or spin."""
    velocity[0, lane] += sign * (
        inverse[0, lane] * p[0] + inverse[1, lane] * p[1] + inverse[2, lane] * p[2]
    )
    velocity[1, lane] += sign * (
        inverse[1, lane] * p[0] + inverse[3, lane] * p[1] + inverse[4, lane] * p[2]
    )
    velocity[2, lane] += sign * (
        inverse[2, lane] * p[0] + inverse[4, lane] * p[1] + inverse[5, lane] * p[2]
    )


@lent
def update_layer(pairs: Record, batch: Record, layer: Record) -> None:
    """Update each contact of a layer; add the changes of impulses to pairs.square and .largest."""
    for lane in range(batch.lanes):
        n, p, u = (
            lane_of(layer.normal, lane),
            lane_of(layer.p, lane),
            relative_in_lane(pairs, layer, lane),
        )
        had = dot(p, n)
        normal = normal_step(layer, lane, u, had)
        u = add_scaled(u, normal - had, lane_of(layer.pull, lane))
        after = add_scaled(tangential_step(layer, lane, u, p, normal), normal, n)
        change = add_scaled(after, -1.0, p)
        one = cross(lane_of(layer.arm_first, lane), change)
        two = cross(lane_of(layer.arm_second, lane), change)
        add_impulse(pairs.v_first, batch.inverse_first, lane, -1.0, change)
        add_impulse(pairs.w_first, batch.spin_first, lane, -1.0, one)
        add_impulse(pairs.v_second, batch.inverse_second, lane, 1.0, change)
        add_impulse(pairs.w_second, batch.spin_second, lane, 1.0, two)
        set_lane(layer.p, lane, after)
        square = dot(change, change)
        pairs.square[lane] += square
        pairs.largest[lane] = larger(pairs.largest[lane], square * layer.stiff[lane])


@lent
def sweep_batches(
    pairs: Record, batches: Record, layers: Record, velocities: Vector
) -> tuple[float, float]:
    """One pass over all batches; the results are those of `change_of`."""
    for lane in range(LANES):
        pairs.square[lane] = pairs.largest[lane] = 0.0
    for k in range(len(batches)):
        fetch(pairs, batches[k], velocities)
        for m in range(batches[k].begin, batches[k].end):
            update_layer(pairs, batches[k], layers[m])
        give_back(pairs, batches[k], velocities)
    size, largest = 0.0, 0.0
    for lane in range(LANES):
        size += pairs.square[lane]
        largest = larger(largest, pairs.largest[lane])
    return size, np.sqrt(largest)

"""Claims about sweeps over batches of contacts: they equal sweeps over one contact at a time."""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
import pytest

from tests.engines.rigid.test_momentum import pile
from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import zero_rows
from vv.engines.rigid.solver.assembly import Bodies, Joints
from vv.engines.rigid.solver.batches import packed, pairs_room, unpacked
from vv.engines.rigid.solver.cone import sweep
from vv.engines.rigid.solver.lanes import sweep_batches
from vv.engines.rigid.solver.momentum import joined, separated
from vv.engines.rigid.solver.problem import Friction
from vv.engines.rigid.solver.seats import DEPTH, LANES, runs, seated
from vv.scene import Vector

SWEEPS = 5


def _side_by_side(
    joints: Joints, bodies: Bodies, friction: Friction, v: Vector
) -> tuple[Index, Vector]:
    p, w = zero_rows(len(joints.first)), zero_rows(len(v))
    batches, layers, place = packed(p, joints, bodies, friction)
    pairs, velocities = pairs_room(1), joined(v, w)
    for _ in range(SWEEPS):
        sweep_batches(pairs[0], batches, layers, velocities)
    unpacked(p, layers, place)
    separated(velocities, v, w)
    return place, p


def _one_by_one(joints: Joints, bodies: Bodies, friction: Friction, v: Vector) -> Vector:
    p, w = zero_rows(len(joints.first)), zero_rows(len(v))
    for _ in range(SWEEPS):
        sweep(p, joints, bodies, friction, v, w)
    return p


side_by_side: Any = numba.njit(_side_by_side)  # not cached on disk, as in test_momentum.py


def _seats(joints: Joints, bodies: Bodies) -> tuple[Index, Index]:
    return seated(joints, bodies, *runs(joints))


seats: Any = numba.njit(_seats)
one_by_one: Any = numba.njit(_one_by_one)


@pytest.mark.parametrize(("height", "mu"), [(1, 0.5), (9, 0.5), (30, 0.05)])
def test_a_sweep_over_batches_is_one_in_their_order(height: int, mu: float) -> None:
    joints, bodies, friction, falls = pile(height, mu)
    rng = np.random.default_rng(height)
    some = rng.normal(size=(2, len(joints.first), 3))
    directions = some[0] / np.linalg.norm(some[0], axis=1)[:, None]
    friction = friction._replace(need=-1e-3 * rng.random(len(joints.first)), d=directions)
    fast, slow = falls.copy(), falls.copy()
    place, p = side_by_side(joints, bodies, friction, fast)
    order = np.argsort(place)
    fields: list[Any] = [field[order] for field in joints]
    ordered = Joints(*fields)
    rubbing = friction._replace(need=friction.need[order], d=friction.d[order])
    expected = one_by_one(ordered, bodies, rubbing, slow)
    assert np.abs(p[order] - expected).max() <= 1e-14
    assert np.abs(fast - slow).max() <= 1e-14


def test_no_block_is_twice_in_a_batch_and_few_lanes_are_empty() -> None:
    joints, bodies, friction, falls = pile(60, 0.5)
    place, _ = side_by_side(joints, bodies, friction, falls)
    assert len(np.unique(place)) == len(place)
    seat, depth = seats(joints, bodies)
    for batch in range(len(depth)):
        pairs = 4 * np.flatnonzero(seat // LANES == batch)
        blocks = np.concatenate([joints.first[pairs], joints.second[pairs]])
        blocks = blocks[blocks < 60]
        assert len(np.unique(blocks)) == len(blocks)
    assert place.max() + 1 <= 1.2 * len(place)


def test_contacts_of_a_pair_share_a_lane_and_what_is_too_many_has_another() -> None:
    joints, bodies, _, falls = pile(2, 0.5)
    fields: list[Any] = [np.repeat(field, 3, axis=0) for field in joints]
    place, _ = side_by_side(
        Joints(*fields),
        bodies,
        Friction(0.5, np.zeros(24), np.zeros((24, 3)), np.zeros((24, 3))),
        falls,
    )
    for pair in (place[:12], place[12:]):
        assert len(np.unique(pair[:DEPTH] % LANES)) == 1
        assert (np.diff(pair[:DEPTH]) == LANES).all()
        assert len(np.unique(pair[DEPTH:] % LANES)) == 1
        assert set(pair[DEPTH:] // LANES).isdisjoint(pair[:DEPTH] // LANES)


def test_a_contact_that_nothing_can_push_is_in_no_batch() -> None:
    joints, bodies, friction, falls = pile(3, 0.5)
    locked = joints._replace(across=np.where(np.arange(12) < 4, 0.0, joints.across))
    place, p = side_by_side(locked, bodies, friction, falls)
    assert (place[:4] == -1).all()
    assert (place[4:] >= 0).all()
    assert not p[:4].any()


def test_where_no_contact_can_push_there_is_no_batch() -> None:
    joints, bodies, *_ = pile(3, 0.5)
    locked = joints._replace(across=np.zeros(12))
    seat, depth = seats(locked, bodies)
    assert (len(seat), len(depth)) == (0, 0)

"""Claims about contacts of blocks in any position: distances, areas, pairs, order, units."""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
import pytest

from tests.engines.blocks.test_contacts import touching
from tests.scenes.blocks.block_scenes import box
from vv.engines.blocks.broad import close_pairs
from vv.engines.blocks.contacts import matched
from vv.engines.blocks.geometry import shapes
from vv.engines.blocks.sorting import ordered
from vv.scene import Block, Vector, Wall

DEEP = 0.004  # m, by which blocks that touch overlap
SEEDS = range(24)


def turned(random: np.random.Generator) -> Vector:
    """A random rotation."""
    matrix = np.linalg.qr(random.normal(size=(3, 3)))[0]
    return np.asarray(matrix * np.sign(np.linalg.det(matrix)))


def axes_of(one: Block, other: Block) -> Vector:
    """The directions along which two boxes can be farthest apart: of faces and pairs of edges."""
    edges = [
        np.diff(block.vertices[[0, k]], axis=0)[0] for block in (one, other) for k in (1, 2, 4)
    ]
    sides = [e / np.linalg.norm(e) for e in edges]
    across = [np.cross(a, b) for a in sides[:3] for b in sides[3:]]
    longs = [n / np.linalg.norm(n) for n in across if np.linalg.norm(n) > 1e-6]
    return np.array([sign * n for n in [*sides, *longs] for sign in (1.0, -1.0)])


def apart(one: Block, other: Block) -> float:
    """How far two boxes are apart, and less than zero if they overlap."""
    axes = axes_of(one, other)
    return float(((other.vertices @ axes.T).min(0) - (one.vertices @ axes.T).max(0)).max())


def pressed(seed: int, metre: float = 1.0, frame: Vector | None = None) -> tuple[Block, Block]:
    """Two boxes of random sizes and directions, the second pushed towards the first until DEEP."""
    random = np.random.default_rng(seed)
    halves, spun = random.uniform(0.2, 0.6, (2, 3)), [turned(random) for _ in range(2)]
    if seed % 2:
        spun[1] = spun[0] @ np.array([[1.0, 0.0, 0.0], [0.0, 0.8, 0.6], [0.0, -0.6, 0.8]])
    away = random.normal(size=3)
    away /= np.linalg.norm(away)
    frame = np.eye(3) if frame is None else frame

    def placed(far: float, unit: float, frame: Vector) -> tuple[Block, Block]:
        return (
            box("one", np.zeros(3), unit * halves[0], spun[0] @ frame),
            box("other", unit * far * away @ frame, unit * halves[1], spun[1] @ frame),
        )

    low, high = 0.0, 3.0
    for _ in range(60):
        far = 0.5 * (low + high)
        low, high = (far, high) if apart(*placed(far, 1.0, np.eye(3))) < -DEEP else (low, far)
    return placed(low, metre, frame)


@pytest.mark.parametrize("seed", SEEDS)
def test_blocks_overlap_by_the_least_way_that_separates_them(seed: int) -> None:
    one, other = pressed(seed)
    found = touching(one, other)
    assert found.gap.min() == pytest.approx(-DEEP, abs=1e-9)
    k = found.gap.argmin()
    for block, side in ((one, -0.5), (other, 0.5)):
        on = found.point[k] + side * found.gap[k] * found.normal[k]
        outward = -2.0 * side * found.normal[k]
        assert (block.vertices @ outward).max() >= on @ outward - 1e-9


@pytest.mark.parametrize("seed", SEEDS)
def test_contacts_know_neither_frame_nor_unit_nor_the_order_of_blocks(seed: int) -> None:
    found = touching(*pressed(seed))
    frame = turned(np.random.default_rng(100 + seed))
    for metre in (1.0, 1e3, 1e-3):
        seen = touching(*pressed(seed, metre, frame), margin=0.01 * metre)
        assert seen.key.tolist() == found.key.tolist()
        assert seen.gap == pytest.approx(metre * found.gap, abs=1e-12 * metre)
        assert seen.point == pytest.approx(metre * found.point @ frame, abs=1e-11 * metre)
        assert seen.normal == pytest.approx(found.normal @ frame, abs=1e-11)
        assert seen.area == pytest.approx(metre**2 * found.area, abs=1e-11 * metre**2)
    back = touching(*reversed(pressed(seed)))
    assert np.sort(back.gap)[0] == pytest.approx(np.sort(found.gap)[0], abs=1e-12)
    assert back.normal[back.gap.argmin()] == pytest.approx(-found.normal[found.gap.argmin()])


def test_a_square_on_a_square_turned_by_an_eighth_shares_an_octagon() -> None:
    s = np.sqrt(0.5)
    eighth = np.array([[s, s, 0.0], [-s, s, 0.0], [0.0, 0.0, 1.0]])
    lower, upper = (box(n, [0.0, 0.0, z], [0.5] * 3, a)
                    for n, z, a in (("lower", 0.5, np.eye(3)), ("upper", 1.5, eighth)))  # fmt: skip
    found = touching(lower, upper)
    assert len(found.gap) == 8
    assert found.area == pytest.approx(np.full(8, 2.0 * (np.sqrt(2.0) - 1.0) / 8.0))
    edge = np.sqrt(2.0) - 1.0
    assert np.abs(found.point[:, :2]).min(1) == pytest.approx(np.full(8, 0.5 * edge), abs=0.25)
    assert np.linalg.norm(found.point[:, :2], axis=1) == pytest.approx(
        np.full(8, np.hypot(0.5, 0.5 * edge))
    )


def test_a_face_on_an_inclined_wall_that_has_moved_shares_its_area() -> None:
    """A box of 0.6 x 1.0 x 0.4 m, over a wall whose normal is (0.6, 0, 0.8)."""
    axes = np.array([[0.8, 0.0, -0.6], [0.0, 1.0, 0.0], [0.6, 0.0, 0.8]])
    normal, point = axes[2], np.array([5.0, -2.0, 1.0])
    block = box("on", point + 0.203 * normal + axes[0], [0.3, 0.5, 0.2], axes)
    found = touching(Wall(point, normal), block)
    assert found.gap == pytest.approx(np.full(4, 0.003))
    assert found.area == pytest.approx(np.full(4, 0.6 * 1.0 / 4.0))
    assert found.normal == pytest.approx(np.tile(normal, (4, 1)))
    assert (found.point - point) @ normal == pytest.approx(np.full(4, 0.0015))
    assert touching(Wall(point, normal), block, margin=0.0029).gap.size == 0


def _pairs(form: Any, vertex: Vector, moves: Any, margin: float) -> Any:
    return close_pairs(form, vertex, moves, margin)


@pytest.mark.parametrize("side", [0.3, 3.0])
def test_close_pairs_are_those_of_all_whose_boxes_are_near(side: float) -> None:
    """Among 40 boxes, every third of which is held; dense ones have more than 4 pairs each."""
    random, margin, n = np.random.default_rng(3), 0.05, 40
    blocks = tuple(
        box(str(k), random.uniform(-side, side, 3), random.uniform(0.05, 0.2, 3)) for k in range(n)
    )
    moves = np.arange(n) % 3 > 0
    kernel: Any = numba.njit(_pairs)
    form = shapes(blocks)
    codes = kernel(form, np.concatenate([b.vertices for b in blocks]), moves, margin)
    low = np.array([b.vertices.min(0) for b in blocks])
    high = np.array([b.vertices.max(0) for b in blocks])
    due = [
        a * n + b
        for a in range(n)
        for b in range(a + 1, n)
        if max((low[a] - high[b]).max(), (low[b] - high[a]).max()) <= margin
        and (moves[a] or moves[b])
    ]
    assert codes.tolist() == due
    assert (len(due) > 4 * n) == (side < 1.0)


def _sorted(key: Any, n: int) -> Any:
    return ordered(key, n)


def _matched(key: Any, count: int, old: Any) -> Any:
    return matched(key, count, old)


@pytest.mark.parametrize("n", [0, 1, 2, 3, 7, 16, 33])
def test_keys_are_sorted_as_numpy_does_and_found_again(n: int) -> None:
    random = np.random.default_rng(n)
    key = random.integers(0, 12, n + 3)
    kernel: Any = numba.njit(_sorted)
    assert kernel(key, n).tolist() == np.argsort(key[:n], kind="stable").tolist()
    key, old = random.permutation(60)[: n + 3], random.permutation(60)[:25]
    find: Any = numba.njit(_matched)
    places = {k: i for i, k in enumerate(old.tolist())}
    assert find(key, n, old).tolist() == [places.get(k, -1) for k in key[:n].tolist()]

"""Claims about the contacts that are found among blocks and walls, and about their keys."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.engines.blocks.test_any_blocks import turned
from tests.engines.blocks.test_contacts import QUARTER, ROLLED
from tests.scenes.blocks.block_scenes import HELD, box
from vv.engines.blocks.contacts import SAME, Contacts, detect, empty_contacts
from vv.engines.blocks.geometry import Planes, shapes
from vv.scene import Block

pytestmark = pytest.mark.usefixtures("in_python")
S = np.sqrt(0.5)
SPACE = (0.0, 0.0, 0.0)
TOP = 1  # the face of a box along the third of its axes
UP = [0.0, 0.0, 1.0]
NONE = np.empty((0, 3))
LABELS = 24 + 2 * 72  # of the vertices and the clipped corners of three boxes
SPAN = 18 * LABELS + 36 * 36  # of their pairs of a face and a label, and of two edges


def found(
    *blocks: Block, walls: Any = NONE, normals: Any = NONE, shift: Any = None,
    depth: Any = SPACE, margin: float = 0.01, room: int = 20,
) -> tuple[int, Contacts]:  # fmt: skip
    """The number of contacts of blocks with each other and with walls, and their rows."""
    form, points = shapes(blocks), np.array(walls, float)
    rows = empty_contacts(room)
    count = detect(
        rows, form, np.concatenate([b.vertices for b in blocks]), form.normal,
        np.array([b.free.any() for b in blocks]), Planes(points, np.array(normals, float)),
        np.zeros_like(points) if shift is None else np.array(shift, float),
        np.array(depth, float), margin,
    )  # fmt: skip
    return count, Contacts(*(part[:count] for part in rows))  # type: ignore[arg-type]


@pytest.mark.parametrize(("part", "left"), [(0.9, 2), (1.1, 4)])
def test_corners_of_a_block_that_is_askew_by_rounding_are_one(part: float, left: int) -> None:
    """On a wall and on a larger block: two sides are askew to the depth by SAME of its size."""
    tilt = part * SAME * 0.6 / 0.2
    askew = np.array([[1.0, -tilt, 0.0], [tilt, 1.0, 0.0], UP])
    askew /= np.linalg.norm(askew, axis=1, keepdims=True)
    block = box("askew", [0.0, 0.0, 0.2], [0.3, 0.1, 0.2], askew)
    for count, rows in (
        found(block, walls=[[5.0, 5.0, 0.0]], normals=[UP], depth=[0.0, 1.0, 0.0]),
        found(box("large", [0, 0, -2.0], [3, 1, 2]), block, depth=[0.0, 1.0, 0.0]),
    ):
        assert count == left
        assert rows.area == pytest.approx(np.full(left, 0.6 * 0.2 / left))


def test_a_key_tells_the_pair_the_face_and_the_corner() -> None:
    """Bodies 0 to 2 are boxes and 3 is a wall; the third box lies on the second."""
    far, lower = box("far", [50, 0, 9], [1, 1, 1]), box("lower", [0, 0, 1.0], [1, 1, 1])
    upper = box("upper", [0.5, 0.2, 2.5], [1.0, 0.5, 0.5])
    count, rows = found(far, lower, upper, walls=[[9, 9, 0]], normals=[UP])
    assert count == 8
    pair, feature = np.divmod(rows.key, SPAN)
    assert pair.tolist() == [3 * 4 + 1] * 4 + [1 * 4 + 2] * 4
    assert feature[:4].tolist() == [8, 9, 10, 11]
    face, label = np.divmod(feature[4:], LABELS)
    assert face.tolist() == [6 + TOP] * 4
    inside = {int(k) for k in label if k < 24}
    assert inside == {16, 18}
    east = {int(k) - 24 for k in label if k >= 24}
    corner = 24 + 4 * TOP + 1
    assert east == {2 * corner, 2 * corner + 1}
    assert rows.first.tolist() == [3] * 4 + [1] * 4
    assert rows.second.tolist() == [1] * 4 + [2] * 4


def test_a_key_tells_the_edges_that_cross() -> None:
    lower = box("lower", [0, 0, -0.2 * 2 * S], [0.2, 0.2, 0.2], ROLLED)
    upper = box("upper", [0, 0, 0.3 * 2 * S], [0.3, 0.3, 0.3], ROLLED @ QUARTER)
    count, rows = found(box("far", [50, 0, 0], [1, 1, 1]), lower, upper)
    assert count == 1
    form = shapes((box("far", [50, 0, 0], [1, 1, 1]), lower, upper))
    vertex = np.concatenate([np.full((8, 3), np.nan), lower.vertices, upper.vertices])
    pair, feature = divmod(int(rows.key[0]), SPAN)
    assert pair == 1 * 3 + 2
    one, two = divmod(feature - 18 * LABELS, 36)
    for edge, along in ((one, 1), (two, 0)):
        ends = vertex[form.edge[edge, :2]]
        assert np.delete(ends, along, axis=1) == pytest.approx(np.zeros((2, 2)))
    assert (rows.first[0], rows.second[0], rows.area[0]) == (1, 2, 0.0)


@pytest.mark.parametrize("first", ["lower", "upper"])
def test_only_corners_within_the_margin_touch_and_share_the_area(first: str) -> None:
    """A box tilted by 0.1 over a broad one, in a turned frame; two corners are farther up."""
    frame = turned(np.random.default_rng(8))
    c, s = np.array([1.0, 0.1]) / np.hypot(1.0, 0.1)
    axes = np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]]) @ frame
    lower = box("lower", -3.0 * frame[2], [5.0, 4.0, 3.0], frame)
    raised = 0.004 + 0.3 * s + 0.1 * c
    upper = box("upper", raised * frame[2], [0.3, 0.2, 0.1], axes)
    height, sign = 0.004 + 0.6 * s, 1.0 if first == "lower" else -1.0
    for margin, due in ((0.99 * height, 2), (1.01 * height, 4)):
        count, rows = found(*((lower, upper) if sign > 0.0 else (upper, lower)), margin=margin)
        assert count == due
        assert np.sort(rows.gap)[:2] == pytest.approx([0.004, 0.004])
        assert rows.area == pytest.approx(np.full(due, 0.6 * c * 0.4 / 4))
        assert rows.normal == pytest.approx(np.tile(sign * frame[2], (due, 1)))
        assert rows.point @ frame[2] == pytest.approx(0.5 * rows.gap)


def test_the_corners_of_a_block_touch_a_wall_where_it_is_now() -> None:
    """A wall that has moved by 0.25 m along its normal, and far along itself."""
    normal, along = np.array([0.6, 0.0, 0.8]), np.array([0.8, 0.0, -0.6])
    axes = np.array([along, [0.0, 1.0, 0.0], normal])
    point = np.array([1.0, 2.0, 3.0])
    block = box("b", point + 0.453 * normal, [0.3, 0.1, 0.2], axes)
    fixed = box("fixed", point - normal, [0.3, 0.1, 0.2], free=HELD)
    given: dict[str, Any] = {
        "walls": [[50.0, 0, 0], point], "normals": [[-1.0, 0, 0], normal],
        "shift": [SPACE, 0.25 * normal + 3.0 * along],
    }  # fmt: skip
    blocks = (fixed, box("far", [0, 0, 50], [1, 1, 1]), block)
    count, rows = found(*blocks, **given)
    assert count == 4
    assert rows.first.tolist() == [3 + 1] * 4
    assert rows.second.tolist() == [2] * 4
    assert (rows.key // SPAN).tolist() == [(3 + 1) * (3 + 2) + 2] * 4
    assert rows.gap == pytest.approx(np.full(4, 0.003))
    assert (rows.point - point) @ normal == pytest.approx(np.full(4, 0.25 + 0.0015))
    assert rows.normal == pytest.approx(np.tile(normal, (4, 1)))
    assert rows.area == pytest.approx(np.full(4, 0.6 * 0.2 / 4))
    assert found(*blocks, margin=0.0029, **given)[0] == 0
    assert found(*blocks, room=2, **given)[0] == 4


def test_a_tilted_face_on_a_wall_gives_its_area_to_the_corners_that_touch() -> None:
    """A quarter each of its projection, though only two corners are within the margin."""
    axes = np.array([[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]])
    upright = box("b", [0, 0, 0], [0.3, 0.1, 0.4], axes)
    block = box("b", [0, 0, -upright.vertices[:, 2].min()], [0.3, 0.1, 0.4], axes)
    count, rows = found(box("far", [0, 0, 50], [1, 1, 1]), block, walls=[[9, 9, 0]], normals=[UP])
    assert count == 2
    assert rows.area == pytest.approx(np.full(2, 0.6 * 0.2 * 0.8 / 4))


@pytest.mark.parametrize(("cosine", "touches"), [(0.48, True), (0.52, False), (-0.52, False)])
def test_walls_across_the_plane_of_a_plane_scene_do_not_touch(cosine: float, touches: bool) -> None:
    normal = np.array([np.sqrt(1 - cosine**2), cosine, 0.0])
    block = box("b", [0, 0, 0], [0.3, 0.3, 0.3])
    given: dict[str, Any] = {"walls": [0.01 * normal], "normals": [normal], "margin": 0.0}
    assert found(block, **given)[0] > 0
    assert (found(block, depth=[0.0, 1.0, 0.0], **given)[0] > 0) == touches

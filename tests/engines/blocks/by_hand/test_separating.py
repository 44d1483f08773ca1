"""Claims about the faces and edges along whose normal two blocks are farthest apart."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.engines.blocks.by_hand.test_edges import FAR, pair, placed
from tests.engines.blocks.test_any_blocks import turned
from tests.engines.blocks.test_contacts import QUARTER, ROLLED
from tests.scenes.blocks.block_scenes import box
from vv.engines.blocks.overlap import (
    EDGES,
    FACE_OF_FIRST,
    FACE_OF_SECOND,
    LIKELY,
    face_apart,
    nearest,
    separation,
)
from vv.scene import Block

pytestmark = pytest.mark.usefixtures("in_python")
SPACE = np.zeros(3)
S = np.sqrt(0.5)
AROUND = np.array([[S, S, 0.0], [-S, S, 0.0], [0.0, 0.0, 1.0]])  # an eighth about the third axis
TOP, SIDE = 1, 5  # the faces of a box along the third and the first of its axes


@pytest.mark.parametrize("seed", range(6))
def test_the_farthest_face_is_that_of_all(seed: int) -> None:
    one, other = pair(seed)
    form, vertex, normal = placed(one, other)
    for a, b, here, there in ((0, 1, one, other), (1, 0, other, one)):
        due = [(there.vertices @ n).min() - here.vertices[f[0]] @ n
               for f, n in zip(here.faces, here.normals, strict=True)]  # fmt: skip
        face, far = face_apart(a, b, form, vertex, normal, SPACE, FAR)
        assert face == form.face_start[a] + int(np.argmax(due))
        assert far == pytest.approx(max(due))
        n = tuple(here.normals[1])
        assert nearest(form, vertex, b, n) == pytest.approx((there.vertices @ n).min())
        enough = sorted(due)[0]
        face, far = face_apart(a, b, form, vertex, normal, SPACE, enough)
        first = next(k for k, one_far in enumerate(due) if one_far > enough)
        assert face == form.face_start[a] + first
        assert far == pytest.approx(due[first])


@pytest.mark.parametrize("cosine", [0.48, 0.52])
def test_faces_towards_the_depth_of_a_plane_scene_are_left_out(cosine: float) -> None:
    """Those whose normal is less than 60 degrees from it, on either side."""
    random = np.random.default_rng(5)
    axes = turned(random)
    one = box("one", [0, 0, 0], [1, 1, 1], axes)
    depth = axes.T @ [cosine, 0.3, np.sqrt(1 - 0.09 - cosine**2)]
    far = {}
    for axis in (0, 1, 2):
        for side in (1.0, -1.0):
            other = box("other", side * 5.0 * axes[axis], [1, 1, 1], axes)
            form, vertex, normal = placed(one, other)
            far[axis, side] = face_apart(0, 1, form, vertex, normal, depth, FAR)[1]
    assert far[1, 1.0] == far[1, -1.0] == pytest.approx(3.0)
    assert far[2, 1.0] == far[2, -1.0] == pytest.approx(-2.0)
    seen = cosine < 0.5
    assert far[0, 1.0] == far[0, -1.0] == pytest.approx(3.0 if seen else -2.0)


def parted(one: Block, other: Block, depth: Any = SPACE, margin: float = 0.1) -> Any:
    """What `separation` tells of two blocks."""
    return separation(0, 1, *placed(one, other), np.array(depth, float), margin)


@pytest.mark.parametrize(("lead", "kind"), [(0.9, FACE_OF_FIRST), (1.1, FACE_OF_SECOND)])
def test_a_face_of_the_second_block_is_taken_if_it_leads(lead: float, kind: int) -> None:
    """A broad box tilted over a narrow one: its face is farther by the tilt times 0.5 m."""
    size = 0.6
    tilt = lead * LIKELY * size / 0.5
    axes = np.array([[1.0, 0.0, tilt], [0.0, 1.0, 0.0], [-tilt, 0.0, 1.0]])
    axes /= np.hypot(1.0, tilt)
    lower = box("lower", [0, 0, 0], [0.3, 0.2, 0.1])
    upper = box("upper", [0, 0, 0.4], [0.8, 0.2, 0.3], axes)
    told = parted(lower, upper)
    assert told[0] == kind
    assert told[1] == (TOP if kind == FACE_OF_FIRST else 6)
    assert told[2] == -1
    assert told[3] == pytest.approx(-(0.8 if kind == FACE_OF_FIRST else 0.3) * tilt, rel=1e-3)


@pytest.mark.parametrize(("lead", "kind"), [(0.9, FACE_OF_FIRST), (1.1, EDGES)])
def test_edges_are_taken_if_they_lead(lead: float, kind: int) -> None:
    """A ridge descends over the side of a box: its end, 0.3 m farther, is below the top."""
    slope = lead * LIKELY * 0.4 / 0.3
    down = np.array([[1.0, 0.0, -slope], [0.0, 1.0, 0.0], [slope, 0.0, 1.0]])
    down /= np.linalg.norm(down, axis=1, keepdims=True)
    lower = box("lower", [0, 0, -0.2], [0.2, 0.2, 0.2])
    height = 0.01 + 0.2 * slope + 0.6 * S
    upper = box("upper", [0, 0, height], [0.3, 0.5, 0.3], ROLLED @ QUARTER @ down)
    told = parted(lower, upper)
    assert told[0] == kind
    assert told[3] == pytest.approx(0.01 - (0.3 * slope if kind == FACE_OF_FIRST else 0), abs=1e-9)
    if kind == EDGES:
        assert told[4] == pytest.approx((slope, 0.0, 1.0))
        assert min(told[1:3]) >= 0
    else:
        assert told[2] == -1


@pytest.mark.parametrize("axis", range(3))
def test_in_a_plane_scene_edges_never_touch(axis: int) -> None:
    """Ridges that cross, which only faces part if the depth is any of the three axes."""
    lower = box("lower", [0, 0, -0.4 * S], [0.2, 0.2, 0.2], ROLLED)
    upper = box("upper", [0, 0, 0.6 * S - 0.01], [0.3, 0.3, 0.3], ROLLED @ QUARTER)
    assert parted(lower, upper)[0] == EDGES
    told = parted(lower, upper, depth=np.eye(3)[axis])
    assert told[0] in (FACE_OF_FIRST, FACE_OF_SECOND)
    assert told[2] == -1


@pytest.mark.parametrize("far", [0.15, 0.3])
def test_blocks_beyond_the_margin_are_parted_by_the_first_face_that_parts_them(far: float) -> None:
    """A corner towards the side of a box, in either order: only that side parts them so far."""
    one = box("one", [0, 0, 0], [1, 1, 1])
    corner = box("corner", [1 + far + 3 * np.sqrt(2.0), 0, 0], [3, 3, 3], AROUND)
    assert parted(one, corner)[:4] == (FACE_OF_FIRST, SIDE, -1, pytest.approx(far))
    assert parted(corner, one)[:4] == (FACE_OF_SECOND, 6 + SIDE, -1, pytest.approx(far))
    ridge = box("ridge", [0, 0, 1.15 + 3 * np.sqrt(2.0)], [3, 4, 3], ROLLED @ QUARTER)
    assert parted(one, ridge)[:4] == (FACE_OF_FIRST, TOP, -1, pytest.approx(0.15))


def test_a_search_that_ended_at_a_face_looks_no_further() -> None:
    """Ridges that cross 0.5 m apart; the faces of each part them by (0.5 - the other's half) S."""
    lower = box("lower", [0, 0, -0.4 * S], [0.2, 0.2, 0.2], ROLLED)
    upper = box("upper", [0, 0, 0.6 * S + 0.5], [0.3, 0.3, 0.3], ROLLED @ QUARTER)
    for margin, kind, due in (
        (0.1, FACE_OF_FIRST, 0.2 * S), (0.2, FACE_OF_SECOND, 0.3 * S), (0.25, EDGES, 0.5)
    ):  # fmt: skip
        told = parted(lower, upper, margin=margin)
        assert (told[0], told[2] >= 0, told[3]) == (kind, kind == EDGES, pytest.approx(due))
        assert told[4] == pytest.approx((0.0, 0.0, float(kind == EDGES)))

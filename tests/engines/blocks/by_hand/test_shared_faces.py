"""Claims about faces clipped to those opposite them, and about edges that cross."""

from __future__ import annotations

import numpy as np
import pytest

from tests.scenes.blocks.block_scenes import box
from vv.engines.blocks.clip import ON, SLIVER, crossing, face_points, facing
from vv.engines.blocks.geometry import shapes
from vv.scene import Block, Vector

pytestmark = pytest.mark.usefixtures("in_python")
TOP = 1  # number of the face of a box along the third of its axes


def test_the_face_that_is_opposite_has_the_most_opposed_normal() -> None:
    one, other = box("one", [9.0, 8.0, 7.0], [1, 1, 1]), box("other", [0, 0, 0], [1, 2, 3])
    form = shapes((one, other))
    for block, first in ((0, 0), (1, 6)):
        for number in range(6):
            n = -form.normal[first + number] + [0.3, 0.2, 0.1]
            assert facing(form, form.normal, block, tuple(n)) == first + number


@pytest.mark.parametrize(("lead", "taken"), [(-1e-10, 0), (0.95e-9, 0), (1.05e-9, 1)])
def test_a_later_face_is_opposite_only_if_it_leads(lead: float, taken: int) -> None:
    """Two faces of a cube, opposed to a direction by nearly the same angle."""
    form = shapes((box("one", [0, 0, 0], [1, 1, 1]),))
    faces = (form.normal @ [0.0, 1.0, 0.0] > 0.5, form.normal @ [1.0, 0.0, 0.0] > 0.5)
    early, late = sorted(int(np.flatnonzero(face)[0]) for face in faces)
    n = -0.7 * form.normal[early] - (0.7 + lead) * form.normal[late]
    assert facing(form, form.normal, 0, tuple(n)) == (early, late)[taken]


def above(
    lower: Block, upper: Block, size: float, face: int = TOP
) -> tuple[Vector, Vector, list[int], float]:
    """The side of a box that is opposite a face of another, clipped to it.

    Its points, their heights, their labels and the area.
    """
    form = shapes((lower, upper))
    vertex = np.concatenate([lower.vertices, upper.vertices])
    count, points, height, label, area = face_points(face, 1, form, vertex, form.normal, size)
    return points[:count], height[:count], label[:count].tolist(), area


def test_a_face_clipped_to_another_has_heights_labels_and_area() -> None:
    """A tilted box over one side of a broader one; only new corners have labels of its sides."""
    tilt = np.array([[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]])
    lower = box("lower", [5.0, 6.0, 0.5], [2.0, 1.0, 0.25])
    upper = box("upper", [6.5, 6.2, 2.0], [1.0, 0.5, 0.5], tilt)
    points, height, labels, area = above(lower, upper, 1.0)
    bottom = upper.vertices[[0, 2, 3, 1]]
    inside = bottom[bottom[:, 0] <= 7.0]
    slope = tilt[0, 2] / tilt[0, 0]
    cuts = [[7.0, y, inside[0, 2] + slope * (7.0 - inside[0, 0])] for y in (5.7, 6.7)]
    due = np.concatenate([inside, cuts])
    order, wanted = np.lexsort(np.round(points, 9).T), np.lexsort(np.round(due, 9).T)
    assert points[order] == pytest.approx(due[wanted])
    assert height == pytest.approx(points[:, 2] - 0.75)
    assert area == pytest.approx(1.0 * (7.0 - inside[0, 0]))
    corners = lower.faces[TOP]
    east = next(
        c for c in range(4)
        if lower.vertices[[corners[c], corners[(c + 1) % 4]], 0] == pytest.approx([7.0, 7.0])
    )  # fmt: skip
    begin = sum(len(face) for face in lower.faces[:TOP])
    new = 16 + 2 * (begin + east)
    by_height = sorted(zip(height, labels, strict=True))
    assert {label for _, label in by_height[:2]} == {8 + 0, 8 + 2}
    assert {label for _, label in by_height[2:]} == {new, new + 1}


@pytest.mark.parametrize("offset", [[0.9, -0.7, 0.8], [-0.9, 0.7, -0.8]])
@pytest.mark.parametrize("face", range(6))
def test_each_face_of_a_box_shares_a_rectangle_with_what_lies_on_it(
    face: int, offset: list[float]
) -> None:
    """A box of half sides 1.0, 1.2 and 1.4 m, 0.1 m from another of which it covers a corner."""
    lower = box("lower", [5.0, 6.0, 7.0], [1.1, 0.9, 1.3])
    normal = lower.normals[face]
    axis = int(np.argmax(abs(normal)))
    halves = np.array([[1.1, 0.9, 1.3], [1.0, 1.2, 1.4]])
    centre = np.array(offset)
    centre[axis] = normal[axis] * (halves[:, axis].sum() + 0.1)
    upper = box("upper", centre + lower.centroid(), halves[1])
    points, height, labels, area = above(lower, upper, 1.0, face)
    low, high = (
        np.maximum(-halves[0], centre - halves[1]),
        np.minimum(halves[0], centre + halves[1]),
    )
    across = np.arange(3) != axis
    assert area == pytest.approx(np.prod((high - low)[across]))
    assert height == pytest.approx(np.full(4, 0.1))
    found = {tuple(np.round(p, 9)) for p in (points - [5, 6, 7])[:, across]}
    assert found == {
        (round(x, 9), round(y, 9)) for x in (low[across][0], high[across][0])
        for y in (low[across][1], high[across][1])
    }  # fmt: skip
    assert len(set(labels)) == 4


def test_all_corners_that_a_face_cuts_have_labels_of_their_own() -> None:
    """A square over a smaller one that is turned by an eighth: each side cuts two."""
    s = np.sqrt(0.5)
    eighth = np.array([[s, s, 0.0], [-s, s, 0.0], [0.0, 0.0, 1.0]])
    lower, upper = box("lower", [0, 0, 0], [1, 1, 1]), box("upper", [0, 0, 2], [1, 1, 1], eighth)
    labels = above(lower, upper, 2.0)[2]
    assert sorted(labels) == [16 + 2 * 4 + k for k in range(8)]


@pytest.mark.parametrize(("far", "label"), [(0.95, "its own"), (1.05, "new")])
@pytest.mark.parametrize("half", [0.2, 3.0])
def test_a_corner_that_protrudes_by_rounding_stays_what_it_is(
    far: float, label: str, half: float
) -> None:
    """By ON times a size that is not the length of a side; then it is one of the corners."""
    size = 0.7
    lower = box("lower", [0, 0, 0], [half, half, half])
    upper = box("upper", [half - 0.1 + far * ON * size, 0, 2 * half], [0.1, 0.05, half])
    labels = above(lower, upper, size)[2]
    assert (max(labels) < 16) == (label == "its own")
    assert len(labels) == 4


@pytest.mark.parametrize(("part", "found"), [(0.95, 0), (1.05, 4)])
def test_faces_that_share_a_sliver_do_not_touch(part: float, found: int) -> None:
    """A strip of SLIVER times the square of a size, 0.3 m long."""
    size, half = 0.7, 0.15
    width = part * SLIVER * size**2 / 0.3
    lower = box("lower", [0, 0, 0], [half, half, half])
    upper = box("upper", [2 * half - width, 0, 2 * half], [half, half, half])
    points, height, labels, area = above(lower, upper, size)
    assert area == pytest.approx(0.3 * width, rel=1e-5)
    assert len(points) == len(height) == len(labels) == found


PLACES = (-0.4, 0.0, 0.3, 0.8, 1.0, 1.4)


@pytest.mark.parametrize("s", PLACES)
@pytest.mark.parametrize("t", PLACES)
def test_edges_cross_midway_between_their_nearest_points(s: float, t: float) -> None:
    """Of skew edges whose lines are nearest at parts s and t; no point lies beyond an end."""
    random = np.random.default_rng(int(100 * s + 10 * t) % 97)
    u, v, p = random.normal(size=(3, 3))
    v += 0.6 * u  # far from a right angle
    gap = 0.1 * np.cross(u, v)
    q = p + s * u + gap - t * v
    form = shapes((box("one", [0, 0, 0], [1, 1, 1]),))
    vertex = np.array([p, p + u, q, q + v])
    form = form._replace(edge=np.array([[0, 1, 0, 0], [2, 3, 0, 0]]))
    on_one, on_other = p + min(max(s, 0.0), 1.0) * u, q + min(max(t, 0.0), 1.0) * v
    assert crossing(0, 1, form, vertex) == pytest.approx(0.5 * (on_one + on_other))

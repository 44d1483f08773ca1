"""Claims about polygons that are clipped to half-spaces, with results by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.engines.blocks.test_any_blocks import turned
from vv.engines.blocks.clip import area_of, cut
from vv.scene import Vector

pytestmark = pytest.mark.usefixtures("in_python")
SLACK = 1e-3  # m
FRESH = 50  # label of the point where the boundary leaves
RANDOM = st.integers(0, 10**6).map(np.random.default_rng)


def clipped(polygon: Any, p: Any, inward: Any, slack: float = SLACK) -> tuple[Vector, list[int]]:
    """A polygon whose points have the labels 0, 1, ..., clipped to a half-space."""
    old = np.array(polygon, float)
    new, labels = np.full((2 * len(old) + 2, 3), np.nan), np.full(2 * len(old) + 2, -1)
    count = cut(
        new, labels, old, np.arange(len(old)), len(old),
        tuple(np.array(p, float)), tuple(np.array(inward, float)), slack, FRESH,
    )  # fmt: skip
    assert (labels[count:] == -1).all()
    return new[:count], labels[:count].tolist()


def test_a_clipped_polygon_is_labelled_where_its_boundary_leaves_and_where_it_enters() -> None:
    """A triangle in the plane z = 7, clipped to x >= 1."""
    points, labels = clipped([[0, 0, 7], [4, 0, 7], [0, 8, 7]], [1, 5, 9], [1, 0, 0])
    assert points == pytest.approx(np.array([[1, 0, 7], [4, 0, 7], [1, 6, 7]]))
    assert labels == [FRESH + 1, 1, FRESH]
    points, labels = clipped([[0, 0, 7], [4, 0, 7], [0, 8, 7]], [1, 5, 9], [-1, 0, 0])
    assert points == pytest.approx(np.array([[0, 0, 7], [1, 0, 7], [1, 6, 7], [0, 8, 7]]))
    assert labels == [0, FRESH, FRESH + 1, 2]


@pytest.mark.parametrize("x", [-0.9 * SLACK, 0.0, 0.9 * SLACK])
def test_a_point_within_the_slack_of_the_boundary_is_inside(x: float) -> None:
    """A triangle with one corner on the boundary, one inside and one outside, listed both ways."""
    triangle = [[x, 0, 0], [2, 2, 0], [-2, 2, 0]]
    points, labels = clipped(triangle, [0, 0, 0], [1, 0, 0])
    assert labels == [0, 1, FRESH, FRESH + 1]
    assert points[:2] == pytest.approx(np.array(triangle[:2]))
    assert points[2] == pytest.approx([0, 2, 0])
    assert points[3, 0] == pytest.approx(0.0, abs=1e-12)
    assert clipped(triangle[::-1], [0, 0, 0], [1, 0, 0])[1] == [FRESH + 1, 1, 2, FRESH]


def test_a_point_beyond_the_slack_is_outside() -> None:
    triangle = [[-1.1 * SLACK, 0, 0], [2, 2, 0], [2, 3, 0]]
    assert clipped(triangle, [0, 0, 0], [1, 0, 0])[1] == [FRESH + 1, 1, 2, FRESH]


@settings(max_examples=40)
@given(RANDOM, st.integers(3, 7))
def test_both_parts_of_a_polygon_have_its_area_and_lie_on_their_sides(random: Any, n: int) -> None:
    """A convex polygon in any plane, seen at any angle and cut anywhere across its middle."""
    frame, far, normal = turned(random), random.uniform(-9, 9, 3), random.normal(size=3)
    angles = np.sort(random.uniform(0, 2 * np.pi, n))
    flat = np.column_stack([3 * np.cos(angles), 2 * np.sin(angles), np.zeros(n)])
    polygon = flat @ frame + far
    direction = random.normal(size=3)
    doubled = np.cross(polygon, np.roll(polygon, -1, axis=0)).sum(0)
    p = polygon.mean(0)
    total = 0.0
    for inward in (normal, -normal):
        points, labels = clipped(polygon, p, inward, 0.0)
        assert ((points - p) @ inward >= -1e-9).all()
        total += area_of(points, len(points), tuple(direction))
        kept = [k for k in labels if k < n]
        assert kept == [k for k in range(n) if (polygon[k] - p) @ inward >= 0]
        assert points[[k < n for k in labels]] == pytest.approx(polygon[kept])
    assert total == pytest.approx(abs(0.5 * doubled @ direction), rel=1e-9, abs=1e-9)

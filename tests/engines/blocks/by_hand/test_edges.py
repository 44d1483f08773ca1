"""Claims about the pairs of edges along whose common normal two blocks are farthest apart."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.engines.blocks.test_any_blocks import turned
from tests.engines.blocks.test_contacts import ROLLED, tetrahedron
from tests.scenes.blocks.block_scenes import box
from vv.engines.blocks.geometry import Shapes, shapes
from vv.engines.blocks.overlap import PARALLEL, edges_apart, middle, support
from vv.scene import Block, Vector

pytestmark = pytest.mark.usefixtures("in_python")
FAR = 1e9  # m, a distance at which no search stops
S = np.sqrt(0.5)


def placed(*blocks: Block) -> tuple[Shapes, Vector, Vector]:
    """The shapes of blocks in the order given, their vertices and normals."""
    form = shapes(blocks)
    return form, np.concatenate([block.vertices for block in blocks]), form.normal


def pair(seed: int) -> tuple[Block, Block]:
    """A box and a tetrahedron in any position, in either order, with their centres apart."""
    random = np.random.default_rng(seed)
    half = random.uniform(0.2, 1.0, 3)
    one = box("box", random.uniform(-5, 5, 3), half, turned(random))
    two = tetrahedron(one.vertices.mean(0) + random.uniform(0.3, 1.0, 3) * half)
    return (one, two) if seed % 2 else (two, one)


def supporting(one: Block, other: Block, form: Shapes) -> dict[tuple[int, int], tuple[Any, Any]]:
    """Pairs of edges in a plane that has one block below and the other above: normal, distance."""
    found = {}
    shift = len(one.vertices)
    for k in range(*form.edge_start[:2]):
        for m in range(*form.edge_start[1:]):
            p, q = one.vertices[form.edge[k, :2]], other.vertices[form.edge[m, :2] - shift]
            n = np.cross(p[1] - p[0], q[1] - q[0])
            for out in (n, -n):
                below = (one.vertices @ out).max() <= (p @ out).min() + 1e-12
                if below and (other.vertices @ out).min() >= (q @ out).max() - 1e-12:
                    unit = out / np.linalg.norm(out)
                    found[k, m] = unit, float((q[0] - p[0]) @ unit)
    return found


@pytest.mark.parametrize("seed", range(8))
def test_edges_support_each_other_where_a_plane_through_both_parts_the_blocks(seed: int) -> None:
    one, other = pair(seed)
    form, _, normal = placed(one, other)
    told = {
        (k, m)
        for k in range(*form.edge_start[:2])
        for m in range(*form.edge_start[1:])
        if support(normal, form.edge, k, m)
    }
    assert told == supporting(one, other, form).keys()
    assert told


@pytest.mark.parametrize("seed", range(8))
def test_of_all_edges_those_are_told_that_are_farthest_apart(seed: int) -> None:
    one, other = pair(seed)
    form, vertex, normal = placed(one, other)
    due = supporting(one, other, form)
    k, m, far, axis = edges_apart(0, 1, form, vertex, normal, middle(form, vertex, 0), FAR)
    assert far == pytest.approx(max(far for _, far in due.values()), abs=1e-12)
    assert far == pytest.approx(due[k, m][1])
    assert axis == pytest.approx(due[k, m][0])


@pytest.mark.parametrize("seed", range(4))
def test_the_search_of_edges_ends_at_the_first_that_is_far_enough(seed: int) -> None:
    one, other = pair(seed)
    form, vertex, normal = placed(one, other)
    due = supporting(one, other, form)
    distances = [due[key][1] for key in sorted(due)]
    enough = sorted(distances)[len(distances) // 2 - 1]
    first = next(key for key in sorted(due) if due[key][1] > enough + 1e-9)
    found = edges_apart(0, 1, form, vertex, normal, middle(form, vertex, 0), enough + 1e-9)
    assert found[:2] == first
    assert found[2] == pytest.approx(due[first][1])


def test_edges_that_support_no_others_are_not_told() -> None:
    """Of two boxes with the same axes, whose edges are parallel or meet faces."""
    form, vertex, normal = placed(box("a", [0, 0, 0], [1, 2, 3]), box("b", [1, 1, 7], [3, 2, 1]))
    k, m, far, _ = edges_apart(0, 1, form, vertex, normal, (0.0, 0.0, 0.0), FAR)
    assert (k, m, far) == (-1, -1, -np.inf)


@pytest.mark.parametrize("first", ["ridge", "floor"])
def test_a_ridge_along_a_face_supports_none_of_the_edges_of_that_face(first: str) -> None:
    """Arcs of normals that end on one another do not cross."""
    ridge, floor = box("ridge", [0, 0, 5], [1, 1, 1], ROLLED), box("floor", [0, 0, 0], [1, 1, 1])
    form, _, normal = placed(*((ridge, floor) if first == "ridge" else (floor, ridge)))
    assert not any(support(normal, form.edge, k, 12 + m) for k in range(12) for m in range(12))


@pytest.mark.parametrize(("sine", "told"), [(0.95, False), (1.05, True)])
def test_edges_that_are_nearly_parallel_are_left_out(sine: float, told: bool) -> None:
    """Of two small boxes, edge over edge, one turned about the vertical by about 1e-6."""
    c, s = 1.0, sine * np.sqrt(PARALLEL)
    yaw = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    yaw /= np.linalg.norm(yaw, axis=1, keepdims=True)
    half = 0.1
    lower = box("lower", [0, 0, -half * S], [half / 2, half, half / 2], ROLLED)
    upper = box("upper", [0, 0, half * S + 0.01], [half / 2, 3 * half, half / 2], ROLLED @ yaw)
    form, vertex, normal = placed(lower, upper)
    _, _, far, _ = edges_apart(0, 1, form, vertex, normal, (0.0, 0.0, -half), FAR)
    assert (far == pytest.approx(0.01)) == told


def test_the_middle_of_a_block_is_the_mean_of_its_vertices() -> None:
    one, other = box("one", [0, 0, 0], [1, 1, 1]), tetrahedron(np.array([3.0, 5.0, 7.0]))
    form, vertex, _ = placed(one, other)
    assert middle(form, vertex, 1) == pytest.approx([3.0, 5.0, 7.75])
    assert middle(form, vertex, 0) == pytest.approx([0.0, 0.0, 0.0])

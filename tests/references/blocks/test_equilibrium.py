"""Claims about stones in equilibrium under a thrust: towers in closed form, walls by two routes."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
import scipy.optimize

from reference_solutions.blocks import facade
from reference_solutions.blocks.equilibrium import Stone, contacts, stands
from reference_solutions.checks.blocks import facade as check


def tower(n: int, wide: float, high: float) -> list[Stone]:
    return [Stone(0.1, 0.1 + wide, k * high, (k + 1) * high) for k in range(n)]


@pytest.mark.parametrize("n", [1, 2, 5])
@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_tower_tips_about_its_toe_where_its_thrust_leaves_the_foot(n: int, way: float) -> None:
    """Its centre is n h/2 above a foot of half width b/2: it tips at a thrust of b/(n h)."""
    tips = 0.3 / (n * 0.2)
    for part, held in ((0.999, True), (1.001, False)):
        assert stands(tower(n, 0.3, 0.2), 10.0, way * part * tips) is held


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_tower_slides_where_its_thrust_exceeds_friction(way: float) -> None:
    for thrust, held in ((0.2999, True), (0.3001, False)):
        assert stands(tower(3, 2.0, 0.2), 0.3, way * thrust) is held


def test_a_slender_stone_stands_only_by_the_upright_joint_of_a_wide_one_beside_it() -> None:
    """Alone it tips at b/h = 0.25; its neighbour, on the side to which it leans, holds it."""
    pair = [Stone(0.0, 2.0, 0.0, 0.4), Stone(2.0, 2.1, 0.0, 0.4)]
    assert stands(pair, 0.5, -0.3)
    assert not stands(pair, 0.5, -0.3, upright=False)
    assert stands(pair, 0.5, -0.2, upright=False)


def test_a_stone_is_held_at_the_ends_of_the_parts_of_its_sides_that_touch() -> None:
    stones = [Stone(0.0, 1.0, 0.0, 0.5), Stone(1.0, 2.0, 0.0, 0.5), Stone(0.25, 1.5, 0.5, 1.0)]
    found = {(one.before, one.behind, one.x, one.z, one.level) for one in contacts(stones)}
    assert found == {
        (-1, 0, 0.0, 0.0, True), (-1, 0, 1.0, 0.0, True),
        (-1, 1, 1.0, 0.0, True), (-1, 1, 2.0, 0.0, True),
        (0, 1, 1.0, 0.0, False), (0, 1, 1.0, 0.5, False),
        (0, 2, 0.25, 0.5, True), (0, 2, 1.0, 0.5, True),
        (1, 2, 1.0, 0.5, True), (1, 2, 1.5, 0.5, True),
    }  # fmt: skip


@pytest.mark.parametrize(
    ("columns", "courses", "ends"),
    [(6, 5, 0.6), (6, 8, 0.5344), (6, 12, 0.2522), (8, 9, 0.5144), (10, 6, 0.5788)],
)
def test_walls_end_to_slide_as_one_block_where_a_second_route_says(
    columns: int, courses: int, ends: float
) -> None:
    """The second route finds contacts of polygons; a wall that slides has a thrust of mu."""
    laid = list(facade.courses(columns, courses, 0.4))
    stones = [Stone(a, b, n * 0.2, (n + 1) * 0.2) for n, a, b in laid]
    polygons = [np.array([[s[0], s[2]], [s[1], s[2]], [s[1], s[3]], [s[0], s[3]]]) for s in stones]
    half = columns * 0.2
    bed = np.array([[-half, -0.2], [half, -0.2], [half, 0.0], [-half, 0.0]])
    for mu, held in ((0.998 * ends, True), (1.002 * ends, False)):
        assert stands(stones, mu, mu) is held
        assert (check.bed_load(polygons, bed, mu, mu) is not None) is held
    assert stands(stones, ends, min(ends, 0.2))


def test_a_program_that_ends_without_an_answer_is_not_taken_for_stones_that_fall(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ended = SimpleNamespace(status=4, success=False, message="numerical difficulties")
    monkeypatch.setattr(scipy.optimize, "linprog", lambda *_, **__: ended)
    with pytest.raises(RuntimeError, match="is not known: numerical difficulties"):
        stands(tower(1, 0.3, 0.2), 0.5, 0.1)

"""Claims about the facade: the weights of its blocks, and that it stands, by a second route."""

from __future__ import annotations

import numpy as np
import pytest

from reference_solutions.blocks import facade
from reference_solutions.checks.blocks import facade as check
from vv.scene import Vector

LENGTH, HEIGHT = 0.4, 0.2
SIZES = [(6, 5), (8, 7), (16, 14), (20, 16)]


def blocks(columns: int, courses: int, arched: bool = True) -> list[Vector]:
    laid = [
        np.array([[a, low], [b, low], [b, low + HEIGHT], [a, low + HEIGHT]])
        for course, a, b in facade.courses(columns, courses, LENGTH)
        for low in [course * HEIGHT]
    ]
    top = np.array([0.0, courses * HEIGHT])
    return laid + [corners + top for corners in facade.arch(columns, LENGTH) if arched]


def bed(columns: int) -> Vector:
    half = columns * LENGTH / 2
    return np.array([[-half, -HEIGHT], [half, -HEIGHT], [half, 0.0], [-half, 0.0]])


@pytest.mark.parametrize("size", SIZES)
def test_its_areas_are_those_of_its_blocks(size: tuple[int, int]) -> None:
    laid = sum(map(check.area, blocks(*size, arched=False)))
    arched = sum(map(check.area, blocks(*size))) - laid
    assert facade.areas(*size, LENGTH, HEIGHT) == pytest.approx((laid, arched), rel=1e-13)


@pytest.mark.parametrize(
    ("size", "gaps"),
    [((8, 11), [(2.0, 0, 3)]), ((8, 12), [(3.0, 0, 7), (2.0, 9, 12)])],
)
def test_from_twelve_courses_on_a_door_is_higher_and_wider_and_has_a_window_above(
    size: tuple[int, int], gaps: list[tuple[float, int, int]]
) -> None:
    for course in range(size[1]):
        row = [(a, b) for c, a, b in facade.courses(*size, 1.0) if c == course]
        open_ = 2 * min(max(a, 0.0) for a, b in row if b > 0.0)  # blocks, about the middle
        assert open_ == sum(width for width, low, top in gaps if low <= course < top), course


@pytest.mark.parametrize("size", SIZES)
def test_it_is_symmetric(size: tuple[int, int]) -> None:
    middles = {tuple(np.round(check.centroid(one), 9) + 0.0) for one in blocks(*size)}
    assert {(-x + 0.0, z) for x, z in middles} == middles


@pytest.mark.parametrize("size", SIZES[:2])
def test_it_can_stand_and_its_bed_bears_its_weight(size: tuple[int, int]) -> None:
    borne = check.bed_load(blocks(*size), bed(size[0]), mu=0.6)
    assert borne == pytest.approx(sum(facade.areas(*size, LENGTH, HEIGHT)), rel=1e-9)


def test_without_friction_its_arch_cannot_stand() -> None:
    assert check.bed_load(blocks(6, 5), bed(6), mu=0.0) is None


@pytest.mark.parametrize(("columns", "mean"), [(6, 2.0), (8, 2.5), (12, 2.5)])
def test_an_arch_is_as_large_as_its_blocks_are_long(columns: int, mean: float) -> None:
    for length in (0.3, 0.7):
        rings = [length * mean * (1.0 + way * 0.15) for way in (-1.0, 1.0)]
        assert facade.rings(columns, length) == pytest.approx(rings, rel=1e-14)
        corners = np.linalg.norm(np.concatenate(facade.arch(columns, length)), axis=1)
        assert sorted({*corners.round(12).tolist()}) == pytest.approx(rings, rel=1e-11)


def test_no_room_for_a_door_is_named() -> None:
    with pytest.raises(ValueError, match="columns = 4; the number must be even"):
        facade.areas(4, 5, LENGTH, HEIGHT)

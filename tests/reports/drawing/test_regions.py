"""Claims about maps of regions: positions of panels, borders and signs, by hand."""

from __future__ import annotations

import pytest

from reports.drawing.regions import Found, draw_regions, key, modes_found
from reports.marks import Mark
from tests.support.drawn import near, numbers, paths, placed, read, texts
from tests.support.read_back import Node
from vv.case.region_map import RegionMap

POINTS = {"p": (10.0, 20.0), "q": (20.0, 50.0)}
CHART = RegionMap(
    "psi", "delta", ("stays", "slides", "topples"), (((0.0, 0.0), (30.0, 60.0)),), POINTS
)
SQUARE, DASH, PLUS = [-2.2, -2.2, 4.4, 4.4, -4.4], [-3.4, 0, 6.8], [-2.2, 0, 4.4, -2.2, -2.2, 4.4]
NAMES = ("a/a", "b/b", "c/c", "d/d")
WIDE = 406 / 3
CORNERS = [(40, 16), (40 + WIDE + 12, 16), (40 + 2 * WIDE + 24, 16), (40, 150)]  # of panels


def x(panel: int, value: float) -> float:
    return CORNERS[panel][0] + WIDE * (value + 1.2) / 32.4  # 0 to 30 and 4 % either way


def y(panel: int, value: float) -> float:
    return CORNERS[panel][1] + 118 - 118 * (value + 2.4) / 64.8  # 0 to 60


@pytest.fixture
def four() -> Node:
    """Four panels with one, two, three and three points."""
    points = [((10.0, 20.0), 0, True), ((20.0, 50.0), 1, False), ((30.0, 0.0), 4, True)]
    found = [Found(Mark(name, 0, (), ""), points[: k + 1]) for k, name in enumerate(NAMES)]
    return read(draw_regions(CHART, found))


def test_panels_stand_three_in_a_row_with_signs_where_the_points_are(four: Node) -> None:
    assert next(four.every("svg")).named["viewbox"] == "0 0 470 302"
    assert paths(four, "grid") == [near(left, top, WIDE, 118, -WIDE) for left, top in CORNERS]
    for k, border in enumerate(four.every("path", class_="border")):
        (a, b, across, up), ends = numbers(border.named["d"]), [x(k, 30), y(k, 60)]
        assert [a, b, a + across, b + up] == near(x(k, 0), y(k, 0), *ends)
    right = [
        near(x(0, 10), y(0, 20), *SQUARE), near(x(1, 10), y(1, 20), *SQUARE),
        near(x(2, 10), y(2, 20), *SQUARE), near(x(2, 30), y(2, 0), *PLUS),
        near(x(3, 10), y(3, 20), *SQUARE), near(x(3, 30), y(3, 0), *PLUS),
    ]  # fmt: skip
    assert paths(four, "mode") == right
    assert paths(four, "mode wrong") == [
        near(x(k, 20), y(k, 50), *DASH) for k in (1, 2, 3)
    ]  # fmt: skip


def test_panels_have_shares_above_and_ticks_where_no_panel_is_in_the_way(four: Node) -> None:
    shares = ("1 of 1", "1 of 2", "2 of 3", "2 of 3")
    assert texts(four, "mid") == placed(
        *((f"{name}: {share}", left + WIDE / 2, top - 4)
          for name, share, (left, top) in zip(NAMES, shares, CORNERS, strict=True)),
        ("psi", 255, 296), ("delta", 0, 0),
    )  # fmt: skip
    assert texts(four, "end tick") == placed(  # beside the first of each row
        *((f"{v}", 36, y(panel, v) + 3) for panel in (0, 3) for v in (0, 20, 40, 60))
    )
    assert texts(four, "mid tick") == placed(  # below what has none below it
        *((f"{v}", x(panel, v), CORNERS[panel][1] + 129)
          for panel in (1, 2, 3) for v in (0, 10, 20, 30))
    )  # fmt: skip
    turned = [one.named["transform"] for one in four.every("g")]
    assert [numbers(one) for one in turned] == [near(9, 142, -90)]


def test_a_point_that_is_found_twice_counts_twice_and_each_mode_has_its_sign() -> None:
    points = [((10.0, 20.0), mode, True) for mode in (0, 0, 2, 3, 4)]
    drawn = read(draw_regions(CHART, [Found(Mark("a/a", 0, (), ""), points)]))
    assert "a/a: 5 of 5" in [said for said, _, _ in texts(drawn, "mid")]
    signs = [one[2:] for one in paths(drawn, "mode")]
    triangle, diamond = [0, -3, 3, 5.2, -6], [0, -3.2, 3.2, 3.2, -3.2, 3.2, -3.2, -3.2]
    assert [len(one) for one in signs] == [12, 5, 8, 6]
    assert signs[1:] == [near(*triangle), near(*diamond), near(*PLUS)]


def test_a_scheme_alone_has_the_whole_width() -> None:
    drawn = read(draw_regions(CHART, [Found(Mark("a/a", 0, (), ""), [])]))
    assert paths(drawn, "grid") == [near(40, 16, 430, 118, -430)]
    assert next(drawn.every("svg")).named["viewbox"] == "0 0 470 168"
    assert paths(drawn, "mode") == paths(drawn, "mode wrong") == []


def test_the_key_has_a_sign_and_a_word_for_each_mode() -> None:
    drawn = read(key(CHART))
    each = 470 / 3
    assert texts(drawn) == placed(
        *((word, 20 + k * each, 11) for k, word in enumerate(CHART.modes))
    )
    assert [one[:2] for one in paths(drawn, "mode")] == [near(12 + k * each, 8) for k in range(3)]
    assert next(drawn.every("svg")).named["viewbox"] == "0 0 470 16"


def test_a_mode_is_found_right_if_it_is_the_exact_one() -> None:
    values: dict[str, tuple[float | None, float | None]] = {
        "q": (2.0, 1.0), "other": (0.0, 0.0), "p": (1.0, 1.0)
    }  # fmt: skip
    assert modes_found(POINTS, values) == [((20.0, 50.0), 2, False), ((10.0, 20.0), 1, True)]
    assert modes_found(POINTS, {"p": (None, 1.0)}) == []

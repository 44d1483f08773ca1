"""Claims about the drawing of a map of errors: positions, colours and signs of cells, by hand."""

from __future__ import annotations

import numpy as np
import pytest

from reports.drawing.maps import HeatMap, Panel
from reports.drawing.panels import SCALE, draw_map
from reports.marks import Mark
from tests.support.drawn import near, numbers, placed, read, texts
from tests.support.read_back import Node

NAN = float("nan")
DT, KN = np.array([1e-4, 1e-3]), np.array([1e5, 2e6, 1e8])
NAMES = ("a/a", "b/b", "c/c", "d/d", "e/e", "f/f", "g/g")


def panel(name: str, errors: list[list[float]]) -> Panel:
    none = np.zeros((3, 2), bool)
    return Panel(Mark(name, 0, (), ""), DT, KN, np.array(errors), none, none)


def sides(one: Node) -> list[float]:
    return [float(one.named[name]) for name in ("x", "y", "width", "height")]


ERRORS = [[3e-4, 0.02], [NAN, 5.0], [0.0, NAN]]


def whole() -> Node:
    """A map of four panels; the first has all kinds of errors, a refused cell and a long one."""
    first = panel("a/a", ERRORS)
    refused, long = np.zeros((3, 2), bool), np.zeros((3, 2), bool)
    refused[2, 1] = long[2, 1] = refused[1, 0] = True
    first = Panel(first.mark, DT, KN, first.error, refused, long)
    others = [panel(name, [[1e-2] * 2] * 3) for name in NAMES[1:4]]
    return read(draw_map(HeatMap((first, *others), False)))


def test_cells_stand_by_step_and_stiffness_the_stiffest_on_top() -> None:
    drawn = whole()
    corners = [(46, 16), (176, 16), (306, 16), (46, 107)]  # panels of 120 by 75, heads of 16
    cells = [sides(one) for one in drawn.every("rect")][: 4 * 6]
    assert cells == [
        near(left + 60 * j, top + 75 - 25 * (i + 1), 60, 25)
        for left, top in corners
        for i in range(3)
        for j in range(2)
    ]
    assert texts(drawn, "end tick") == placed(
        *((said, 42, 16 + 75 - 25 * i - 12.5 + 3) for i, said in enumerate(("1e5", "2e6", "1e8"))),
        ("1e-4", 0, 5), ("1e-3", 0, 5), ("1e-4", 0, 5), ("1e-3", 0, 5),
        *((said, 42, 107 + 75 - 25 * i - 12.5 + 3) for i, said in enumerate(("1e5", "2e6", "1e8"))),
        ("1e-4", 0, 5), ("1e-3", 0, 5),
    )  # fmt: skip
    turned = [
        numbers(one.named["transform"]) for one in drawn.every("g") if "transform" in one.named
    ]
    assert turned == [
        *(near(left + 60 * (j + 0.5) + 3, top + 80, -45)
          for left, top in corners[1:] for j in range(2)),
        near(9, 99, -90),
    ]  # fmt: skip
    assert texts(drawn, "mid") == placed(
        *((name, left + 60, top - 4) for name, (left, top) in zip(NAMES[:4], corners, strict=True)),
        ("dt [s]", 236, 224), ("kn [N/m]", 0, 0),
    )  # fmt: skip
    assert next(drawn.every("svg")).named["viewbox"] == "0 0 470 228"


def test_a_cell_says_and_shows_what_came_of_it() -> None:
    drawn = whole()
    groups = [one for one in drawn.every("g") if [*one.every("title")]][:6]
    assert [next(one.every("title")).text for one in groups] == [
        "kn 1e5, dt 1e-4: error 3.00e-4", "kn 1e5, dt 1e-3: error 2.00e-2",
        "kn 2e6, dt 1e-4: not supported", "kn 2e6, dt 1e-3: error 5.00e0",
        "kn 1e8, dt 1e-4: error 0", "kn 1e8, dt 1e-3: not run, since it would need too many steps",
    ]  # fmt: skip
    signs = [
        [(path.named["class"], numbers(path.named["d"])) for path in one.every("path")]
        for one in groups
    ]
    cross = ("lost", near(136 - 3, 53.5 - 3, 6, 6, -6, 0, 6, -6))
    assert signs == [
        [], [], [("idle", near(76 - 3, 53.5, 6))], [cross], [],
        [("idle", near(136, 28.5, 0.1))],
    ]  # fmt: skip
    # 1e-4 to 1 in ten steps of 0.4 decades: 3e-4 is 0.477 of a decade up, 0.02 is 2.301
    look = [next(one.every("rect")).named for one in groups]
    assert [one.get("fill") for one in look] == [
        SCALE[1], SCALE[6], None, SCALE[10], None, None
    ]  # fmt: skip
    assert [one.get("class") for one in look] == [None, None, "none", None, "none", "none"]


def test_the_scale_of_colours_has_its_powers_of_ten() -> None:
    drawn = whole()
    bars = [*drawn.every("rect")][4 * 6 :]
    each = 166 / 11  # from 16 to 182
    assert [sides(one) for one in bars] == [
        near(436, 182 - each * (k + 1), 8, each + 0.3) for k in range(11)
    ]
    assert [one.named["fill"] for one in bars] == list(SCALE)
    assert texts(drawn, "tick") == placed(
        *(
            (said, 447, 182 - 41.5 * k + 3)
            for k, said in enumerate(("10⁻⁴", "10⁻³", "10⁻²", "10⁻¹", "10⁰"))
        )
    )


@pytest.mark.parametrize(
    ("errors", "ticks", "fills"),
    [
        ((1e-2, 1e-2), ("10⁻²", "10⁻¹"), (0, 0)),  # a decade at least
        ((1e-12, 1.0), ("10⁻¹²", "10⁻¹⁰", "10⁻⁸", "10⁻⁶", "10⁻⁴", "10⁻²", "10⁰"), (0, 10)),
        ((2e-3, 0.5), ("10⁻³", "10⁻²", "10⁻¹", "10⁰"), (1, 9)),
    ],
)
def test_colours_span_the_decades_of_all_errors(
    errors: tuple[float, float], ticks: tuple[str, ...], fills: tuple[int, int]
) -> None:
    one = panel("a/a", [[*errors]] * 3)
    drawn = read(draw_map(HeatMap((one,), True)))
    assert [said for said, _, _ in texts(drawn, "tick")] == list(ticks)
    cells = [*drawn.every("rect")][:2]
    assert [cell.named["fill"] for cell in cells] == [SCALE[k] for k in fills]
    assert sides(cells[0]) == near(46, 116, 190, 50)  # one panel alone is 380 by 150
    assert texts(drawn, "mid")[1:2] == placed(("dt / critical step", 236, 208))


def test_panels_of_many_codes_are_not_lower_than_66_pixels() -> None:
    drawn = read(draw_map(HeatMap(tuple(panel(n, [[1e-2] * 2] * 3) for n in NAMES), False)))
    assert next(drawn.every("svg")).named["viewbox"] == "0 0 470 292"
    assert sides(next(drawn.every("rect"))) == near(46, 60, 60, 22)

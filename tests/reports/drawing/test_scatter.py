"""Claims about the figure of computed over measured values: its positions, by hand."""

from __future__ import annotations

from reports.drawing.scatter import draw_scatter
from reports.marks import Mark
from tests.support.drawn import dots, near, numbers, paths, placed, read, texts
from vv.insight.against_measurements import Compared

A, B = Mark("a/a", 3, (), ""), Mark("b/b", 5, (), "")


def test_places_ends_and_numbers_of_the_square() -> None:
    # values from 2 to 12, and 0.8 beyond them: 1.2 to 12.8 on 252 px from 44, both ways
    points = {
        A: [Compared("p", "m", 2.0, 7.0, 0.5, 1.0, True)],
        B: [Compared("q", "m", 12.0, 10.0, 2.0, None, False)],
    }
    drawn = read(draw_scatter(points, "s"))

    def at(value: float) -> float:
        return 44 + 252 * (value - 1.2) / 11.6

    assert texts(drawn) == placed(
        ("measured s", 170, 332), ("computed s", 0, 0), ("5", at(5), 312), ("5", 38, 344 - at(5)),
        ("10", at(10), 312), ("10", 38, 344 - at(10)),
    )  # fmt: skip
    assert dots(drawn) == placed(("full", at(7), 340 - at(2)), ("open", at(10), 340 - at(12)))
    assert paths(drawn, "line") == [  # two uncertainties, no further than the frame
        near(at(6), 340 - at(2), at(8)), near(at(6), 340 - at(12), 296)
    ]  # fmt: skip
    assert paths(drawn, "frame") == [near(44, 44, 296, 296, 44, 44, 296, 296, 44)]
    turned = [one.named["transform"] for one in drawn.every("g") if "transform" in one.named]
    assert [numbers(one) for one in turned] == [near(10, 170, -90)]
    assert [one.named["class"] for one in drawn.every("g") if "data-k" in one.named] == ["c3", "c5"]
    assert next(drawn.every("svg")).named["viewbox"] == "0 0 340 340"
    assert [one.text for one in drawn.every("title")] == [
        "a/a, p: computed 2, measured 7 ± 0.5", "b/b, q: computed 12, measured 10 ± 2"
    ]  # fmt: skip


def test_a_picture_of_like_values_is_as_wide_as_what_they_are_sure_to() -> None:
    # 0.08 of 2 times 1.25 either way: 9.8 to 10.2
    like = [Compared("p", "m", 10.0, 10.0, sure, 1.0, True) for sure in (1.25, 0.05)]
    drawn = read(draw_scatter({A: like}, "s"))
    assert dots(drawn) == placed(("full", 170, 170), ("full", 170, 170))
    assert texts(drawn)[2:4] == placed(("9.8", 44, 312), ("9.8", 38, 300))
    assert paths(drawn, "line") == [near(44, 170, 296), near(107, 170, 233)]

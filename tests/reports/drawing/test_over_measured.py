"""Claims about figures of computed over measured values, and of both over a condition, by hand."""

from __future__ import annotations

from reports.drawing.scatter import draw_scatter
from reports.drawing.sweeps import draw_sweep
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


def point(at: float, computed: float, measured: float, sure: float) -> Compared:
    return Compared(f"q{at:g}", "", computed, measured, sure, None, False, "angle", at)


def across(at: float) -> float:
    """The position of a condition: 10 to 30, and 6 % of that on both sides, from 58 to 530 px."""
    return 58 + 472 * (at - 8.8) / 22.4


def up(value: float) -> float:
    """The position of a value: 2 to 9, and 6 % of that on both sides, from 296 px up to 14."""
    return 296 - 282 * (value - 1.58) / 7.84


def test_places_of_lines_bars_and_numbers() -> None:
    soft = [point(30.0, 4.0, 5.0, 0.5), point(10.0, 2.0, 3.0, 0.25)]
    curves = [("soft", A, soft), ("stiff", B, [point(20.0, 9.0, 5.0, 1.0)]), ("soft", B, soft[:1])]
    drawn = read(draw_sweep(curves, "e", "angle"))
    assert next(drawn.every("svg")).named["viewbox"] == "0 0 640 340"
    assert paths(drawn, "frame") == [near(58, 14, 296, 530)]
    assert paths(drawn, "line") == [
        near(across(10), up(2), across(30), up(4)), near(across(20), up(9), 0),
        near(across(30), up(4), 0),
    ]  # fmt: skip
    assert paths(drawn, "seen") == [
        near(across(30), up(4), up(6)), near(across(10), up(2.5), up(3.5)),
        near(across(20), up(3), up(7)),
    ]  # fmt: skip
    assert dots(drawn) == placed(
        ("seen", across(30), up(5)), ("seen", across(10), up(3)), ("seen", across(20), up(5))
    )
    below, beside = ("11", "15.5", "20", "24.5", "29"), ("2.36", "3.93", "5.5", "7.07", "8.64")
    assert texts(drawn, "mid") == placed(
        *((said, 58 + 94.4 * (k + 0.5), 312) for k, said in enumerate(below)), ("angle", 294, 332)
    )
    assert texts(drawn, "end") == placed(
        *((said, 52, 300 - 56.4 * (k + 0.5)) for k, said in enumerate(beside))
    )
    bare = [one for one in texts(drawn) if one[0] in ("e", "soft", "stiff")]
    assert bare == placed(
        ("e", 64, 24), ("soft", across(10) + 4, up(2) - 5), ("stiff", across(20) + 4, up(9) - 5)
    )
    assert [one.named["class"] for one in drawn.every("g")] == ["c3", "c5", "c5"]
    assert [one.text for one in drawn.every("title")][-1] == "q20: measured 5 ± 1"


def test_one_point_alone_has_a_twentieth_of_a_unit_about_it() -> None:
    drawn = read(draw_sweep([("soft", A, [point(2.0, 1.0, 1.0, 0.0)])], "e", "angle"))
    assert dots(drawn) == placed(("seen", 294, 155))
    assert [said for said, _, _ in texts(drawn, "mid")] == [
        "1.95",
        "1.98",
        "2",
        "2.02",
        "2.05",
        "angle",
    ]

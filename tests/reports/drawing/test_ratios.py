"""Claims about the figures of all measurements: every position in them, by hand."""

from __future__ import annotations

import math

import pytest

from reports.drawing.ratios import Kind, draw_biases, draw_ratios
from reports.marks import Mark
from tests.support.drawn import dots, near, numbers, paths, placed, read, texts
from vv.insight.against_measurements import Compared, Factor

A, B = Mark("a/a", 3, (), ""), Mark("b/b", 5, (), "")


def compared(name: str, computed: float, measured: float, sure: float, held: bool) -> Compared:
    """A comparison; sure: the standard uncertainty over the measured value."""
    return Compared(name, "m", computed, measured, sure * measured, 1.0 if held else None, held)


KINDS = [
    Kind("case: one", "s", {A: [compared("p", 3.0, 2.0, 0.05, True)],
                            B: [compared("p", 1.0, 2.0, 0.05, True)]}),
    Kind("case: two", "t", {A: [compared("q", 4.0, 5.0, 0.1, False),
                                compared("r", 1.2, 1.0, 0.02, True)]}),
]  # fmt: skip


def height(ratio: float, low: float, high: float) -> float:
    """The position on a logarithmic axis of 240 px with its foot at 252."""
    return 252 - 240 * math.log(ratio / low) / math.log(high / low)


def test_ratios_stand_in_slots_of_nine_pixels_over_bars_of_two_uncertainties() -> None:
    # ratios 1.5, 0.5, 0.8 and 1.2 on an axis from 0.95 0.5 to 1.05 1.5
    drawn = read(draw_ratios(KINDS))

    def up(ratio: float) -> float:
        return height(ratio, 0.475, 1.575)

    assert next(drawn.every("svg")).named["viewbox"] == "0 0 204 362"
    # kinds begin at 120 and at 120 + 9 (1 + 2.5); the smallest measured value comes first
    assert dots(drawn) == placed(
        ("full", 124.5, up(1.5)), ("open", 165, up(0.8)), ("full", 156, up(1.2)),
        ("full", 124.5, up(0.5)),
    )  # fmt: skip
    assert paths(drawn, "sure") == [
        near(124.5, up(0.9), up(1.1)), near(156, up(0.96), up(1.04)), near(165, up(0.8), up(1.2))
    ]  # fmt: skip
    ticks = (0.5, 0.7, 0.8, 0.9, 1.0, 1.1, 1.25, 1.5)
    assert texts(drawn, "end")[: len(ticks)] == placed(
        *((f"{tick:g}", 114, up(tick) + 4) for tick in ticks)
    )
    assert paths(drawn, "grid") == [near(120, up(t), 192) for t in ticks if t != 1]
    assert paths(drawn, "frame") == [near(120, 12, 252, 192), near(120, up(1.0), 192)]
    turned = [one for one in drawn.every("g") if "transform" in one.named]
    assert [(numbers(one.named["transform"]), one.text) for one in turned] == [
        (near(128.5, 266, -32), "s, case: one"), (near(164.5, 266, -32), "t, case: two")
    ]  # fmt: skip
    groups = [one for one in drawn.every("g") if "data-k" in one.named]
    assert [(one.named["class"], one.named["data-k"]) for one in groups] == [
        ("c3", "a/a"), ("c5", "b/b")
    ]  # fmt: skip
    said = [one.text for one in drawn.every("title")]
    assert said[0] == "a/a, case: one, p: computed 3, measured 2 ± 0.1, ratio 1.500"


@pytest.mark.parametrize(
    ("computed", "sure", "low", "high", "dot"),
    [
        (1.0, 0.0, 0.95 / 1.1, 1.155, 1.0),  # at least a tenth on both sides
        (10.0, 0.0, 0.95 / 1.1, 4.2, 4.2),  # values beyond the axis are drawn at its end
        (0.0, 0.6, 0.2375, 1.05 * 2.2, 0.2375),
        (1.0, 0.3, 0.38, 1.68, 1.0),  # the axis includes the whole bar
    ],
)
def test_the_axis_of_ratios_ends_at_a_quarter_and_at_four(
    computed: float, sure: float, low: float, high: float, dot: float
) -> None:
    one = Kind("k", "s", {A: [compared("p", computed, 1.0, sure, True)]})
    drawn = read(draw_ratios([one]))
    assert dots(drawn) == placed(("full", 124.5, height(dot, low, high)))
    bar = max(1 - 2 * sure, low), 1 + 2 * sure
    assert paths(drawn, "sure") == [near(124.5, *(height(end, low, high) for end in bar))]
    level = texts(drawn, "end")
    every = (0.25, 0.5, 0.7, 0.8, 0.9, 1, 1.1, 1.25, 1.5, 2, 4)
    assert level[:-1] == placed(
        *((f"{t:g}", 114, height(t, low, high) + 4) for t in every if low < t < high)
    )


def across(value: float, most: float) -> float:
    """The position on a logarithmic axis of 418 px from 1/most to most, with 1 at 399."""
    return 399 + 209 * math.log(value) / math.log(most)


def test_biases_stand_in_rows_with_two_scatters_over_what_is_sure() -> None:
    rows = [
        (A, "held", Factor(1.2, 0.1, 0.05)),
        (B, "none", Factor(None, None, None)),
        (B, "half", Factor(1.1, None, None)),
        (B, "all", Factor(0.8, 0.05, None)),
    ]
    drawn = read(draw_biases(rows))
    most = 1.05 * 1.2 * 1.2  # the first, two scatters above

    def at(value: float) -> float:
        return across(value, most)

    assert next(drawn.every("svg")).named["viewbox"] == "0 0 620 80"
    assert paths(drawn, "frame") == [near(399, 12, 56)]
    ticks = (1.0, 0.7, 0.8, 0.9, 1.1, 1.25, 1.5)  # 30 px apart, and none beyond the ends
    assert texts(drawn, "mid") == placed(*((f"{t:g}", at(t), 72) for t in ticks))
    assert texts(drawn)[-2:] == placed(("a/a, held", 0, 27), ("b/b, all", 0, 49))
    assert dots(drawn) == placed(("full", at(1.2), 23), ("full", at(0.8), 45))
    assert paths(drawn, "line") == [
        near(at(0.96), 23, at(1.44)), near(at(0.72), 45, at(0.88))
    ]  # fmt: skip
    grey = [[float(one.named[k]) for k in ("x", "y", "width")] for one in drawn.every("rect")]
    assert grey == [near(at(1 / 1.1), 16, at(1.1) - at(1 / 1.1)), near(399, 38, 0)]
    said = [one.text for one in drawn.every("title")]
    assert said == [
        "a/a, held: bias 1.2000, scatter 10.00 %", "b/b, all: bias 0.8000, scatter 5.00 %"
    ]  # fmt: skip
    groups = [one.named["class"] for one in drawn.every("g")]
    assert groups == ["c3", "c5"]


@pytest.mark.parametrize(
    ("factor", "most", "ticks"),  # these no nearer than 30 px to each other
    [
        (Factor(1.0, 0.0, 0.0), 1.071, "1 0.95 1.05 0.98 1.02"),
        (Factor(1.0, 0.0, 0.3), 1.68, "1 0.7 0.8 0.9 1.1 1.25 1.5"),
        (Factor(0.5, 0.45, None), 10.5, "1 0.25 0.5 1.5 4"),  # no lower than a fifth of it
        (Factor(0.8, 0.05, None), 1.05 / 0.72, "1 0.7 0.8 0.9 1.1 1.25"),
    ],
)
def test_the_axis_of_biases_reaches_as_far_as_any_bar(
    factor: Factor, most: float, ticks: str
) -> None:
    drawn = read(draw_biases([(A, "all", factor)]))
    assert texts(drawn, "mid") == placed(
        *((said, across(float(said), most), 50) for said in ticks.split())
    )
    bias, either = factor.bias or 0.0, 2 * (factor.scatter or 0.0)
    ends = bias * max(1 - either, 0.2), bias * (1 + either)
    assert paths(drawn, "line") == [near(across(ends[0], most), 23, across(ends[1], most))]


def test_slots_stand_by_what_was_measured_and_not_by_what_was_computed() -> None:
    kind = Kind("case: one", "s", {A: [compared("p", 1.0, 5.0, 0.1, True),
                                       compared("q", 9.0, 2.0, 0.1, True)]})  # fmt: skip
    assert [*kind.slots] == ["q", "p"]

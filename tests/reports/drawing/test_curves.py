"""Claims about a chart: positions of curves, markers, rims, names and guides, by hand."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from reports.drawing.charts import Chart, Curve, Rim
from reports.drawing.curves import HIGH, draw
from reports.marks import UNNUMBERED, Mark
from tests.support.drawn import near, numbers, paths, placed, read, texts

A, B = Mark("a/a", 3, (), "", 7), Mark("b/b", 5, (), "", 8)


def curve(mark: Mark, x: list[float], y: list[float]) -> Curve:
    none = np.zeros(len(x), bool)
    return Curve(mark, np.array(x), np.array(y), ~none, none, none, ~none)


LINEAR = Chart("t [s]", "y", False, False, (curve(A, [0.0, 1.0, 4.0], [0.0, 10.0, 5.0]),))


def x_of(t: float) -> float:
    return 52 + 76 * t  # 0 to 4 on 304 px, without room


def y_of(value: float) -> float:
    return 248 - 238 * (value + 0.4) / 10.8  # 0 to 10 and 4 % either way on 238 px


def test_frame_and_numbers_of_a_linear_chart() -> None:
    drawn = read(draw(LINEAR))
    assert next(drawn.every("svg")).named["viewbox"] == "0 0 470 290"
    svg = next(drawn.every("svg"))
    assert (svg.named["data-x"], svg.named["data-y"]) == ("0 4", "-0.4 10.4")
    across, up = drawn.every("g", class_="mid"), drawn.every("g", class_="end")
    (below,), (beside,) = across, up
    assert numbers(below.named["transform"]) == [0, 261]
    assert numbers(beside.named["transform"]) == [47, 3]
    said = [(one.text, float(one.named["x"])) for one in below.every("text")]
    assert said == placed(*((f"{t}", x_of(t)) for t in range(5)))
    said = [(one.text, float(one.named["y"])) for one in beside.every("text")]
    assert said == placed(*((f"{v}", y_of(v)) for v in (0, 5, 10)))
    grid = paths(drawn, "grid")[0]
    ways = [n for t in range(5) for n in (x_of(t), 10, 248)]
    ways += [n for v in (0, 5, 10) for n in (52, y_of(v), 356)]
    assert grid == near(*ways)
    assert texts(drawn, "mid") == placed(("t [s]", 204, 280))


def test_a_curve_is_a_line_with_markers_and_a_name_led_to() -> None:
    drawn = read(draw(LINEAR))
    (line,), (dots,) = paths(drawn, "line"), paths(drawn, "dots")
    spots = [(x_of(0), y_of(0)), (x_of(1), y_of(10)), (x_of(4), y_of(5))]
    assert dots == near(*(n for spot in spots for n in spot))
    assert np.array(line).reshape(-1, 2).cumsum(axis=0).ravel().tolist() == pytest.approx(
        dots, abs=0.15
    )
    (group,) = drawn.every("g", class_="k7")
    (name,) = group.every("text")
    assert [(name.text, float(name.named["y"]))] == placed(("a/a", y_of(5) + 3))
    assert len([*group.every("path")]) == 2  # the name stands right beside its end


@pytest.mark.parametrize(("end", "leads"), [(3.96, False), (3.9, True)])
def test_a_name_is_led_to_from_an_end_farther_than_four_pixels(end: float, leads: bool) -> None:
    other = curve(B, [0.0, 4.0], [9.0, 9.0])
    chart = dataclasses.replace(LINEAR, curves=(curve(A, [0.0, end], [0.0, 1.0]), other))
    (group,) = read(draw(chart)).every("g", class_="k7")
    lines = [one.named["d"] for one in group.every("path") if "class" not in one.named]
    assert bool(lines) is leads
    y = 248 - 238 * (1 + 0.36) / 9.72  # 0 to 9
    if leads:
        assert numbers(lines[0]) == near(x_of(end) + 4, y, 361, y)


@pytest.mark.parametrize(("letters", "narrow"), [(19, False), (20, True)])
def test_a_name_of_more_than_nineteen_letters_is_set_narrower(letters: int, narrow: bool) -> None:
    label = "x" * letters
    named = curve(Mark(label, 0, (), ""), [0.0, 4.0], [0.0, 5.0])
    every = read(draw(dataclasses.replace(LINEAR, curves=(named,)))).every("text")
    (name,) = (one for one in every if one.text == label and "x" not in one.named)
    assert name.named.get("textlength") == ("104" if narrow else None)


def test_names_of_ends_that_meet_stand_apart_in_the_order_of_the_ends() -> None:
    ends = {"p": 5.0, "q": 5.0, "r": 4.9, "s": 5.2}
    more = (curve(Mark(name, 0, (), ""), [0.0, 4.0], [0.0, end]) for name, end in ends.items())
    chart = dataclasses.replace(LINEAR, curves=(*LINEAR.curves, *more))
    drawn = read(draw(chart))
    at = {}
    for group in drawn.every("g"):
        for one in group.every("text"):
            if one.text in {*"pqrs", "a/a"} and "x" not in one.named:
                at[one.text] = float(one.named["y"]) - 3
    first = y_of(5.2)
    wanted = dict(
        zip(("s", "a/a", "p", "q", "r"), (first + 10.5 * k for k in range(5)), strict=True)
    )
    assert at == pytest.approx(wanted, abs=0.06)


def test_names_keep_within_the_drawing() -> None:
    marks = [Mark(f"m{n:02}", 0, (), "", n) for n in range(4)]
    low = tuple(curve(m, [0.0, 4.0], [10.0 if m.number else 0.0, 0.0]) for m in marks)
    drawn = read(draw(dataclasses.replace(LINEAR, curves=low)))
    rows = [float(t.named["y"]) - 3 for g in drawn.every("g") for t in g.every("text")
            if t.text.startswith("m")]  # fmt: skip
    foot = 248 - 238 * 0.4 / 10.8
    assert rows == pytest.approx([foot + 10.5 * k for k in range(4)], abs=0.06)
    many = tuple(curve(Mark(f"m{n:02}", 0, (), "", n), [0.0, 4.0], [10.0, 0.0]) for n in range(33))
    drawn = read(draw(dataclasses.replace(LINEAR, curves=many)))
    rows = [float(t.named["y"]) - 3 for g in drawn.every("g") for t in g.every("text")
            if t.text.startswith("m")]  # fmt: skip
    step = 268 / 33  # all lines that there are between 10 and 278
    assert rows == pytest.approx([278 - step * (32 - k) for k in range(33)], abs=0.06)


LOG = Chart(
    "dt [s]", "e", True, True,
    (curve(A, [1e-3, 1e-2, 1e-1], [1e-4, 1e-3, 1e-2]), curve(B, [1e-2, 3e-2], [1e-3, 1e-3])),
    guides=(1, -2),
)  # fmt: skip


def log_x(dt: float) -> float:
    return 52 + 304 * (math.log10(dt) + 3.12) / 2.24  # two decades, and 6 % of them either way


def log_y(error: float) -> float:
    return 248 - 238 * (math.log10(error) + 4.12) / 2.24


def test_a_logarithmic_chart_has_six_per_cent_of_room_and_markers_of_unlike_sizes() -> None:
    drawn = read(draw(LOG))
    assert next(drawn.every("svg")).named["data-x"] == "-3.12 -0.88 1"
    (group,) = drawn.every("g", class_="k7 s8")  # the first has the largest
    assert numbers(next(group.every("path", class_="dots")).named["d"]) == near(
        log_x(1e-3), log_y(1e-4), log_x(1e-2), log_y(1e-3), log_x(1e-1), log_y(1e-2)
    )
    (last,) = drawn.every("g", class_="k8")  # and the last has the smallest
    ((x, y, dx, dy),) = paths(last, "line")  # two points are joined too
    assert [x, y, x + dx, y + dy] == pytest.approx(
        [log_x(1e-2), log_y(1e-3), log_x(3e-2), log_y(1e-3)], abs=0.15
    )


def test_guides_have_their_slope_from_the_top_right_or_the_top_left() -> None:
    drawn = read(draw(LOG))
    top = 10**-1.88  # the top of the axis
    first, second = paths(drawn, "guide")
    # slope 1 through (0.1, 0.01): it leaves the axes above at 0.1 top/0.01 and below at 10^-3.12
    right = min(0.1 * top / 0.01, 10**-0.88)
    left = max(0.1 * 10**-4.12 / 0.01, 10**-3.12)
    (x0, y0, dx, dy) = first
    assert [x0, y0, x0 + dx, y0 + dy] == pytest.approx(
        [log_x(right), log_y(right * 0.1), log_x(left), log_y(left * 0.1)], abs=0.15
    )
    # slope -2 through (1e-3, 0.01)
    left = max(1e-3 * (top / 0.01) ** -0.5, 10**-3.12)
    right = min(1e-3 * (10**-4.12 / 0.01) ** -0.5, 10**-0.88)
    (x0, y0, dx, dy) = second
    assert [x0, y0, x0 + dx, y0 + dy] == pytest.approx(
        [log_x(left), log_y(0.01 * (left / 1e-3) ** -2), log_x(right),
         log_y(0.01 * (right / 1e-3) ** -2)], abs=0.15,
    )  # fmt: skip
    spots = [0.1 * (10**-3.12 / 0.1) ** 0.8, 1e-3 * (right / 1e-3) ** 0.8]
    assert texts(drawn, "guided") == placed(
        ("slope 1", log_x(spots[0]), log_y(spots[0] * 0.1)),
        ("slope -2", log_x(spots[1]), log_y(0.01 * (spots[1] / 1e-3) ** -2)),
    )
    assert not paths(read(draw(dataclasses.replace(LOG, guides=()))), "guide")


def test_names_of_guides_that_would_lie_on_each_other_stand_below_each_other() -> None:
    flat = dataclasses.replace(LOG, curves=(curve(A, [1e-2, 1.1e-2], [1e-9, 1e-1]),), guides=(1, 2))
    one, other = texts(read(draw(flat)), "guided")
    assert other[2] - one[2] >= HIGH


def test_marks_on_the_rims_stand_at_their_step_or_in_a_row_from_the_right() -> None:
    rims = (Rim(A, 1e-2, True), Rim(B, 1e-1, False), Rim(B, None, True))
    drawn = read(draw(dataclasses.replace(LOG, rims=rims)))
    assert [one.text for one in drawn.every("title")] == [
        "a/a: no result", "b/b: error below the axis", "b/b: no result"
    ]  # fmt: skip
    first, third = log_x(1e-2), 356 - 12 - 14 * 2
    assert paths(drawn, "lost") == [
        near(first - 4, 6, 8, 8, -8, 0, 8, -8), near(third - 4, 6, 8, 8, -8, 0, 8, -8)
    ]  # fmt: skip
    assert paths(drawn, "sunk") == [near(log_x(1e-1), 248, 9, -3, -4, 3, 4, 3, -4)]
    assert paths(drawn, "holes") == [
        near(first, 10, 0), near(log_x(1e-1), 248, 0), near(third, 10, 0)
    ]  # fmt: skip
    many = tuple(Rim(B, None, True) for _ in range(20))
    drawn = read(draw(dataclasses.replace(LOG, rims=many)))
    assert paths(drawn, "holes")[18:] == [near(344, 10, 0), near(330, 10, 0)]  # eighteen in a row


def test_a_rim_widens_the_axis_of_steps() -> None:
    drawn = read(draw(dataclasses.replace(LOG, rims=(Rim(A, 1e-5, True),))))
    assert next(drawn.every("svg")).named["data-x"] == "-5.24 -0.76 1"


def test_troubling_points_are_ringed_three_pixels_beyond_their_markers() -> None:
    (first, second) = LOG.curves
    ringed = dataclasses.replace(first, ringed=np.array([False, True, False]))
    drawn = read(draw(dataclasses.replace(LOG, curves=(ringed, second))))
    r = 3 + 0.2 * 8 + 3
    assert paths(drawn, "ring") == [
        near(log_x(1e-2) - r, log_y(1e-3), r, r, 0, 1, 0, 2 * r, 0, r, r, 0, 1, 0, -2 * r, 0)
    ]


def test_what_is_no_scheme_has_the_colour_of_its_curve() -> None:
    plain = curve(Mark("E_k", 4, (), "", UNNUMBERED), [0.0, 4.0], [0.0, 10.0])
    drawn = read(draw(dataclasses.replace(LINEAR, curves=(plain,))))
    assert [one.named["data-k"] for one in drawn.every("g", class_="key c4")] == ["E_k"]


def test_hollow_markers_tips_and_points_without_a_place() -> None:
    t, y = [0.0, 1.0, 2.0, 4.0], [0.0, 10.0, float("nan"), 5.0]
    hollow = np.array([True, False, False, False])
    one = dataclasses.replace(
        curve(A, t, y), hollow=hollow, joined=~hollow, tips=("p", "q", "r", "s"),
        marked=np.array([True, True, True, False]),
    )  # fmt: skip
    drawn = read(draw(dataclasses.replace(LINEAR, curves=(one,))))
    (holes,), (dots,) = drawn.every("path", class_="holes"), drawn.every("path", class_="dots")
    assert (holes.named["data-tip"], dots.named["data-tip"]) == ("p", "q")
    assert numbers(holes.named["d"])[:2] == near(x_of(0), y_of(0))
    alone = dataclasses.replace(one, joined=np.array([True, False, False, False]), tips=())
    drawn = read(draw(dataclasses.replace(LINEAR, curves=(alone,))))
    assert not paths(drawn, "line")
    assert "data-tip" not in next(drawn.every("path", class_="dots")).named


def test_the_grey_line_widens_a_linear_axis_and_a_curve_stays_four_pixels_off_it() -> None:
    exact = (np.array([0.0, 4.0]), np.array([0.0, 20.0]))
    drawn = read(draw(dataclasses.replace(LINEAR, exact=exact, grey="front")))
    svg = next(drawn.every("svg"))
    assert (svg.named["data-y"], svg.named["data-grey"]) == ("-0.8 20.8", "front")
    ((x0, y0, dx, dy),) = paths(drawn, "exact")
    ends = 248 - 238 * 0.8 / 21.6, 10 + 238 * 0.8 / 21.6
    assert [x0, y0, x0 + dx, y0 + dy] == pytest.approx([52, ends[0], 356, ends[1]], abs=0.1)


def test_dips_of_an_error_over_time_leave_the_axis_and_are_drawn_at_its_foot() -> None:
    errors = [1e-2] * 50 + [1e-9] + [1e-3] * 39 + [1e-4] * 10
    t = np.linspace(0.0, 4.0, 100).tolist()
    drawn = read(draw(Chart("t", "e", False, True, (curve(A, t, errors),))))
    assert next(drawn.every("svg")).named["data-y"] == "-4.12 -1.88 1"
    feet = numbers(next(drawn.every("path", class_="dots")).named["d"])[1::2]
    assert max(feet) == 252


def test_a_guide_ends_at_the_edge_of_the_axes() -> None:
    steep = dataclasses.replace(LOG, curves=(curve(A, [1e-3, 1e-2], [1e-6, 1e-2]),), guides=(1,))
    ((x0, y0, dx, dy),) = paths(read(draw(steep)), "guide")
    # 10^-3.12 to 10^-1.88 across, 10^-6.24 to 10^-1.76 up, on a line on which both are equal
    ends = [248 - 238 * (6.24 - exponent) / 4.48 for exponent in (1.88, 3.12)]
    assert [x0, y0, x0 + dx, y0 + dy] == pytest.approx([356, ends[0], 52, ends[1]], abs=0.1)


def test_an_infinite_value_is_marked_above_the_axes() -> None:
    one = curve(A, [0.0, 1.0, 4.0], [0.0, math.inf, 10.0])
    (dots,) = paths(read(draw(dataclasses.replace(LINEAR, curves=(one,)))), "dots")
    assert dots[3] == 6


@pytest.mark.parametrize(
    ("x_log", "y_log", "most"), [(False, True, 38), (False, False, 98), (True, True, 98)]
)
def test_noise_of_an_error_over_time_is_drawn_with_fewer_points(
    x_log: bool, y_log: bool, most: int
) -> None:
    wave = [10.0 ** ((7 * k) % 11 - 11) for k in range(1, 401)]
    one = curve(A, [float(k) for k in range(1, 401)], wave)
    (line,) = paths(read(draw(Chart("x", "y", x_log, y_log, (one,)))), "line")
    assert 0.7 * most < len(line) / 2 <= most


def test_a_curve_that_turns_back_has_no_zoom() -> None:
    back = curve(A, [0.0, 2.0, 1.0], [0.0, 1.0, 2.0])
    both = dataclasses.replace(LINEAR, curves=(*LINEAR.curves, back))
    for chart, zooms in ((both, False), (LINEAR, True)):
        assert ("data-x" in next(read(draw(chart)).every("svg")).named) is zooms
    jump = dataclasses.replace(LINEAR, curves=(curve(A, [0.0, 1.0, 1.0], [0.0, 1.0, 2.0]),))
    assert "data-x" in next(read(draw(jump)).every("svg")).named
    log = dataclasses.replace(LOG, curves=(curve(A, [1e-1, 1e-2], [1e-1, 1e-2]),))
    assert "data-x" in next(read(draw(log)).every("svg")).named


@pytest.mark.parametrize("slope", [-1, -2, 1, 2])
def test_a_guide_is_drawn_though_the_least_is_next_to_nothing(slope: int) -> None:
    """Once, 0 to a negative power ended the report."""
    curves = (curve(A, [1e-6, 1e-3], [1e-2, 5e-324]),)
    drawn = read(draw(Chart("CPU [s]", "error", True, True, curves, guides=(slope,))))
    assert len(list(drawn.every("path", class_="guide"))) == 1

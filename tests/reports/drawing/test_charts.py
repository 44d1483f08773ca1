"""Claims about charts as data: what is drawn, clipped to the rim, or joined, checked by hand."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from reports.drawing import charts
from reports.drawing.collect import History, Ladder, Point
from reports.drawing.gallery import cost_figures, figures
from reports.marks import Mark
from tests.support.fabricated import case
from vv.case import Norm

T = np.linspace(0.0, 1.0, 13)
WAVE = 2.0 + np.sin(3 * T)
NAMES = ("a/a", "b/b", "c/c", "d/d", "e/e")
A, B, C, D, E = (Mark(name, 0, (), "") for name in NAMES)
(QUANTITY,) = case().variants["T1"].quantities


def history(one: Mark, dt: float | None, error: float) -> History:
    return History(one, dt, T, WAVE * (1 + error * T), WAVE)


def test_relative_errors_far_below_those_of_steps_are_told_and_not_drawn() -> None:
    chart, sunk = charts.relative_errors([
        history(A, 0.1, -0.1), history(B, 0.2, 0.4), history(C, None, 5e-5),
        history(D, None, 2e-4), history(E, None, 0.0),
    ])  # fmt: skip
    assert chart is not None
    assert [curve.mark for curve in chart.curves] == [A, B, D]
    assert sunk == {"c/c": pytest.approx(5e-5), "e/e": 0.0}
    assert chart.curves[0].y == pytest.approx(0.1 * T)
    alone, none = charts.relative_errors([history(C, None, 5e-5)])
    assert alone is not None
    assert len(alone.curves) == 1
    assert none == {}
    assert charts.relative_errors([history(E, 1e-3, 0.0)]) == (None, {})
    nothing = dataclasses.replace(history(A, 0.1, 0.1), reference=0 * T)
    assert charts.relative_errors([nothing]) == (None, {})


def test_markers_over_time_lie_between_each_other() -> None:
    chart = charts.trajectory([history(one, 0.1, 0.1) for one in (A, B)], "y")
    assert chart is not None
    # thirteen outputs: every second is marked, the second scheme one later
    assert [np.flatnonzero(curve.marked).tolist() for curve in chart.curves] == [
        [0, 2, 4, 6, 8, 10, 12], [1, 3, 5, 7, 9, 11]
    ]  # fmt: skip
    assert not chart.curves[0].joined.any()  # markers on the reference, no line
    bare = [dataclasses.replace(history(A, 0.1, 0.1), reference=None)]
    chart = charts.trajectory(bare, "y")
    assert chart is not None
    assert chart.curves[0].joined.all()
    assert chart.exact is None


def test_the_grey_line_is_the_reference_of_the_first_scheme_that_has_one() -> None:
    bare = dataclasses.replace(history(A, 0.1, 0.1), reference=None)
    chart = charts.trajectory([bare, history(B, 0.1, 0.1)], "y")
    assert chart is not None
    assert chart.exact is not None
    assert [part.tolist() for part in chart.exact] == [T.tolist(), WAVE.tolist()]
    assert [bool(curve.joined.any()) for curve in chart.curves] == [True, False]


def test_what_is_told_of_an_error_that_is_not_drawn_is_its_largest_over_time() -> None:
    bump = History(B, None, T, WAVE * (1 + 8e-5 * (np.arange(13) == 4)), WAVE)
    _, sunk = charts.relative_errors([history(A, 0.1, 0.1), bump])
    assert sunk == {"b/b": pytest.approx(8e-5)}


def point(dt: float | None, error: float | None, cpu: float = 1.0, timed: bool = True) -> Point:
    return Point(dt, error, cpu, timed, error is None)


def test_slopes_beside_errors_rise_with_the_step_and_fall_with_the_cost() -> None:
    steps, cost = charts.error_against_step(LADDERS, "e"), charts.error_against_cost(LADDERS, "e")
    assert steps is not None
    assert (steps.guides, cost.guides) == ((1, 2), (-1, -2))


def test_rings_are_around_what_is_out_of_bounds_and_what_was_not_taken_on_is_nowhere() -> None:
    bad = Point(0.1, 0.04, 1.0, True, troubling=True)
    fine = Point(0.2, 0.01, 1.0, True, troubling=False)
    refused = Point(0.05, None, 0.0, False, troubling=False, refused=True)
    ladder = Ladder(A, None, (fine, bad, refused))
    for chart in (
        charts.error_against_step([ladder], "e"),
        charts.error_against_cost([ladder], "e"),
    ):
        assert chart is not None
        assert chart.curves[0].ringed.tolist() == [False, True]
        assert chart.rims == ()


LADDERS = [
    Ladder(A, None, (point(0.2, 0.04, 1.0), point(0.1, 0.01, 2.0, False), point(0.05, None, 4.0))),
    Ladder(B, None, (point(None, 2e-5, 8.0),)),
    Ladder(C, None, (point(None, 5e-6, 9.0),)),
    Ladder(D, None, (point(0.1, 0.0, 3.0), point(0.025, 0.02, 0.0))),
]


def test_errors_over_steps_have_level_lines_and_rims() -> None:
    chart = charts.error_against_step(LADDERS, "e")
    assert chart is not None
    assert [(c.mark.label, c.x.tolist(), c.y.tolist()) for c in chart.curves] == [
        ("a/a", [0.2, 0.1], [0.04, 0.01]),
        ("b/b", [0.025, 0.2], [2e-5, 2e-5]),  # above a thousandth of the least with a step
        ("d/d", [0.025], [0.02]),
    ]
    assert [(r.mark.label, r.x, r.above) for r in chart.rims] == [
        ("a/a", 0.05, True), ("c/c", None, False), ("d/d", 0.1, False)
    ]  # fmt: skip
    assert chart.curves[0].tips == ("0.2;4.00e-2", "0.1;1.00e-2")
    assert charts.error_against_step([LADDERS[1]], "e") is None


def test_errors_over_cost_have_hollow_points_a_front_and_rims() -> None:
    chart = charts.error_against_cost(LADDERS, "e")
    a, b = chart.curves
    assert (a.x.tolist(), a.hollow.tolist()) == ([1.0, 2.0], [False, True])
    assert a.joined.all()  # one alone is timed
    assert (b.mark, b.x.tolist()) == (B, [8.0])
    assert chart.exact is not None
    assert [part.tolist() for part in chart.exact] == [[1.0, 8.0, 8.0], [0.04, 0.04, 2e-5]]
    assert [(r.mark.label, r.x, r.above) for r in chart.rims] == [
        ("a/a", 4.0, True), ("c/c", 9.0, False), ("d/d", 3.0, False)
    ]  # fmt: skip
    assert a.tips[1] == "0.1;1.00e-2;2 s ○"
    third = dataclasses.replace(
        LADDERS[0], points=(*LADDERS[0].points[:2], point(0.05, 0.005, 4.0))
    )
    (curve,) = charts.error_against_cost([third], "e").curves
    assert curve.joined.tolist() == [True, False, True]
    hollow = Ladder(A, None, (point(0.2, 0.04, 1.0, False),))
    assert charts.error_against_cost([hollow], "e").exact is None


def test_shares_are_stairs_that_end_at_twice_the_largest() -> None:
    chart = charts.shares([(A, [4.0, 1.0, math.inf, 2.0]), (B, [math.inf] * 4)], "share")
    assert chart is not None
    (curve,) = chart.curves
    assert curve.x.tolist() == [1.0, 2.0, 2.0, 4.0, 4.0, 8.0]
    assert curve.y.tolist() == [0.25, 0.25, 0.5, 0.5, 0.75, 0.75]
    assert curve.marked.tolist() == [True, False] * 3
    assert charts.shares([(B, [math.inf])], "share") is None


@pytest.mark.parametrize(
    ("errors", "drawn"),
    [((None, 0.0), True), ((0.0, None), True), ((None, None), True), ((0.0, 0.0), False),
     ((0.0, 0.01), True), ((0.01, 0.01), True)],
)  # fmt: skip
def test_a_figure_of_errors_is_left_out_only_where_all_are_nil(
    errors: tuple[float | None, float | None], drawn: bool
) -> None:
    ladders = [
        Ladder(mark, None, (point(dt, error),))
        for mark, dt, error in zip((A, D), (0.1, 0.2), errors, strict=True)
    ]
    assert bool(figures([], ladders, QUANTITY, Norm.MAX)) is drawn
    assert bool(cost_figures(ladders, QUANTITY, Norm.MAX)) is drawn

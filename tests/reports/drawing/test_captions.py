"""Claims about captions and alternative texts of figures: each number that they tell, by hand."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from reports.drawing.collect import History, Ladder, Point
from reports.drawing.gallery import cost_figures, figures
from tests.reports.drawing.test_charts import (
    LADDERS,
    QUANTITY,
    WAVE,
    A,
    B,
    C,
    D,
    T,
    history,
    point,
)
from vv.case import Norm


def test_captions_name_what_is_on_the_rims_and_what_has_no_cost() -> None:
    (steps,) = figures([], LADDERS, QUANTITY, Norm.MAX)
    assert steps.caption == (
        "Dashed: slopes for comparison. Crossed on the upper edge, without a result: a/a. "
        "On the lower edge, below the axis: c/c and d/d."
    )
    assert steps.alt.endswith("of 4 schemes, least c/c 5.00e-6, most d/d 0 to 2.00e-2")
    (cost,) = cost_figures(LADDERS, QUANTITY, Norm.MAX)
    assert cost.caption == (
        "Filled, joined: timed alone on one core; grey: the Pareto front. Hollow: indicative. One "
        "solve, without start-up. Crossed on the upper edge, without a result: a/a. On the "
        "lower edge, below the axis: c/c and d/d. Not drawn, no cost measured at some setting: d/d."
    )
    assert "least c/c 5.00e-6 for 9.00e0 s, most d/d 2.00e-2 for 0 s" in cost.alt
    (cost,) = cost_figures(LADDERS[1:3], QUANTITY, Norm.MAX)
    assert cost.caption.startswith("Timed alone on one core; grey: the Pareto front.")
    part = [Ladder(B, None, (point(0.1, 0.1), point(0.2, 0.2))),
            Ladder(C, None, (point(0.1, 0.1, 1.0, False),))]  # fmt: skip
    (cost,) = cost_figures(part, QUANTITY, Norm.MAX)
    assert cost.caption.startswith("Filled, joined: timed alone on one core;")
    lost = [Ladder(A, None, (point(0.1, None),)), Ladder(B, None, (point(0.2, 0.0),))]
    assert len(figures([], lost, QUANTITY, Norm.MAX)) == 1  # a cross is something to draw
    assert figures([], lost[1:], QUANTITY, Norm.MAX) == []
    assert cost_figures(lost[1:], QUANTITY, Norm.MAX) == []


def test_captions_over_time_name_the_steps_that_are_not_the_usual_one() -> None:
    over = [
        history(A, 0.1, 0.1),
        history(B, 0.1, 0.2),
        history(C, 0.05, 0.4),
        history(D, None, 1e-5),
    ]
    value, relative = figures(over, [], QUANTITY, Norm.MAX)
    assert value.caption == (
        "Finest setting of each, dt = 0.1 s, but c/c 0.05 s; the grey line is the reference."
    )
    assert relative.caption.endswith("of its maximum. Not drawn, far below: d/d (at most 1.0e-5).")
    assert relative.alt.endswith("a/a 1.00e-1, b/b 2.00e-1, c/c 4.00e-1, d/d (at most 1.0e-5)")
    alike, _ = figures(over[:2], [], QUANTITY, Norm.MAX)
    assert alike.caption == "Finest setting, dt = 0.1 s; the grey line is the reference."
    exact, _ = figures(over[3:], [], QUANTITY, Norm.MAX)
    assert exact.caption.startswith("No code here has a time step")


@pytest.mark.parametrize(
    ("norm", "name"),
    [(Norm.MAX, "max"), (Norm.FINAL, "final"), (Norm.POINTWISE, "pointwise"), (Norm.L2, "L2")],
)
def test_a_figure_of_errors_says_in_which_norm_they_are(norm: Norm, name: str) -> None:
    (steps,), (cost,) = figures([], LADDERS, QUANTITY, norm), cost_figures(LADDERS, QUANTITY, norm)
    for one in (steps, cost):
        assert one.alt.startswith(f"error of y, norm {name} ") or one.alt.startswith(
            f"error of y, norm {name}:"
        )
        assert f">error of y, norm {name}<" in one.svg


def test_the_end_of_each_scheme_is_told_and_of_many_the_least_and_the_most() -> None:
    def ending(mark: object, start: float, end: float) -> History:
        values = np.linspace(start, end, len(T))
        return History(mark, 0.1, T, values, WAVE)  # type: ignore[arg-type]

    four = [ending(A, 9.0, 2.0), ending(B, 1.0, 3.0), ending(C, 0.0, 1.5), ending(D, 5.0, 2.5)]
    value, relative = figures(four, [], QUANTITY, Norm.MAX)
    assert value.title == "y [m] over time"
    assert value.alt == (
        "y [m] over time; at the final time: of 4 schemes, least c/c 1.500000e0, "
        "most b/b 3.000000e0"
    )
    assert "left out where |reference| is below 1 % of its maximum." in relative.caption
    value, _ = figures(four[:3], [], QUANTITY, Norm.MAX)
    assert value.alt.endswith("time: a/a 2.000000e0, b/b 3.000000e0, c/c 1.500000e0")


def test_a_scheme_is_ringed_if_any_point_is_and_costless_if_one_with_an_error_is() -> None:
    mixed = Ladder(
        A, None, (point(0.2, 0.01), dataclasses.replace(point(0.1, 0.5), troubling=True))
    )
    lost = Ladder(B, None, (Point(0.1, None, 0.0, False, True), point(0.2, 0.01)))
    (steps,) = figures([], [mixed, lost], QUANTITY, Norm.MAX)
    assert "Ringed, outside the bound: a/a." in steps.caption
    (cost,) = cost_figures([mixed, lost], QUANTITY, Norm.MAX)
    assert "Ringed, outside the bound: a/a." in cost.caption
    assert "no cost measured" not in cost.caption

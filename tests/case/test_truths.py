"""Claims about small decisions of cases and asks: tables of truths, by hand."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from tests.support.fabricated import some
from vv.ask import Bracket, History, Knobs, Method
from vv.case import (
    CodeToCode,
    Exact,
    Grid,
    Interval,
    Invariant,
    Judge,
    Ladder,
    Level,
    Measured,
    Measurement,
    Printed,
    Search,
    Shown,
    Tolerance,
    judge_at_other_parameters,
    judge_for_method,
    knob_grid,
    why_too_long,
)
from vv.case.published import Assessment, Statement
from vv.case.quantity import REST, at_rest

NAN = float("nan")


GENERAL = {
    Method.LEAPFROG: Method.SECOND_ORDER,
    Method.LATE_LEAPFROG: Method.FIRST_ORDER,
    Method.STRAIGHT: Method.FIRST_ORDER,
    Method.DAMPED: Method.PENALTY,
}


@pytest.mark.parametrize("method", Method)
def test_a_class_of_methods_is_judged_as_its_own_then_as_its_general_class(method: Method) -> None:
    wider = GENERAL.get(method, method)
    assert method.general is wider
    own, general = Tolerance(1e-3, "own"), Tolerance(1e-2, "general")
    assert Exact({method: own}).tolerance(method) is own
    assert Exact({wider: general}).tolerance(method) is general
    both = Exact({wider: general, method: own})
    assert both.tolerance(method).reason == "own"


ONE = Tolerance(1e-3, "why")


@pytest.mark.parametrize(
    ("judged", "shown", "reason"),
    [
        ((Method.LEAPFROG,), {}, None),
        ((Method.SECOND_ORDER,), {}, None),
        ((Method.LEAPFROG,), {Method.SECOND_ORDER: "general"}, None),
        ((Method.SECOND_ORDER,), {Method.LEAPFROG: "own"}, "own"),
        ((), {Method.SECOND_ORDER: "general"}, "general"),
        ((), {Method.LEAPFROG: "own", Method.SECOND_ORDER: "general"}, "own"),
        ((Method.PENALTY,), {}, f"no tolerance for class {Method.LEAPFROG.value}"),
    ],
)
def test_what_is_said_of_the_class_itself_counts_before_what_is_said_of_the_general_one(
    judged: tuple[Method, ...], shown: dict[Method, str], reason: str | None
) -> None:
    judge = Exact(dict.fromkeys(judged, ONE), not_judged=shown)
    found = judge_for_method(judge, Method.LEAPFROG)
    assert found is judge if reason is None else found == Shown(reason)


MEASUREMENT = Measurement(1.0, 0.3, 0.4, "in air", "a paper")


@pytest.mark.parametrize(
    ("judge", "kept"),
    [
        (Exact({Method.EXACT: ONE}), True),
        (Interval(0.0, 1.0, "why"), True),
        (Invariant(1e-9, "why"), True),
        (Measured(MEASUREMENT, 0.5, "why"), False),
        (Measured(MEASUREMENT, 0.5, "why", law=True), True),
        (CodeToCode(Printed(1.0, 0.1, "code", "report"), 0.5, "why"), False),
    ],
    ids=lambda one: type(one).__name__,
)
def test_at_other_parameters_what_is_no_law_is_only_shown(judge: Judge, kept: bool) -> None:
    found = judge_at_other_parameters(judge)
    assert (found is judge) is kept
    assert kept or isinstance(found, Shown)


def test_an_uncertainty_is_of_both_sources_and_a_band_is_not_below_it() -> None:
    assert MEASUREMENT.uncertainty == pytest.approx(0.5)
    assert Measured(MEASUREMENT, None, "why").band is None
    with pytest.raises(ValueError, match="not below the uncertainty"):
        Measured(MEASUREMENT, 0.45, "why")
    with pytest.raises(ValueError, match="not below the rounding"):
        CodeToCode(Printed(1.0, 0.1, "code", "report"), 0.09, "why")


@pytest.mark.parametrize(
    ("largest", "still", "rests"),
    [
        (0.0, None, True), (0.0, 2.0, True), (1e-300, None, False), (2.0 * REST, 2.0, True),
        (2.1 * REST, 2.0, False), (1.0, 2.0, False),
    ],
)  # fmt: skip
def test_a_reference_rests_that_is_nil_or_rounding(
    largest: float, still: float | None, rests: bool
) -> None:
    assert at_rest(largest, still) is rests


def test_a_tolerance_adds_what_is_late_and_keeps_the_step_out_of_what_has_no_order() -> None:
    late = Tolerance(1e-3, "why", dt=1e-3, order=0, late=0.5)
    assert late.at(Knobs(4e-3)) == pytest.approx(1e-3 + 0.5 * 4e-3)
    assert late.at(Knobs()) == 1e-3
    stiff = Tolerance(1e-3, "why", kn=1e8, softness=1.0)
    assert stiff.at(Knobs(1e-3, 1e7)) == pytest.approx(1e-2)


SCENE: Any = some(spheres=(0,) * 3, blocks=(0,) * 2)


def ladder(limit: float) -> Any:
    return Ladder(SCENE, History(1.0, 1.0), (), dict.fromkeys(Level, (Knobs(0.1),)),
                  cpu_limit=limit)  # fmt: skip


@pytest.mark.parametrize(
    ("limit", "dt", "pace", "runs"),
    [  # ten steps of three spheres and two blocks
        (1.0, 0.1, (0.1, 0.0), True),
        (0.99, 0.1, (0.1, 0.0), False),
        (1.0, 0.1, (0.0, 0.02), True),
        (0.99, 0.1, (0.0, 0.02), False),
        (1.99, 0.1, (0.1, 0.02), False),
        (0.01, None, (0.1, 0.02), True),
        (math.inf, 0.1, (0.1, 0.02), True),
    ],
)
def test_a_setting_runs_if_its_steps_and_bodies_fit_the_limit(
    limit: float, dt: float | None, pace: tuple[float, float], runs: bool
) -> None:
    why = why_too_long(ladder(limit), Knobs(dt), pace)
    assert (why is None) is runs
    if not runs:
        each = pace[0] + 5 * pace[1]
        assert why == (
            f"not run: 10 steps of about {each:g} s each; the limit is {limit:g} s, "
            f"{limit / each:.2g} steps"
        )


def test_a_search_is_run_however_long_it_takes() -> None:
    nothing: Any = SCENE
    search = Search(nothing, (), 0.1, 40, Bracket(8.0, 1.0))
    assert why_too_long(search, Knobs(0.1), (1e9, 1e9)) is None
    assert search.goal.duration == pytest.approx(4.0)
    assert search.goal.interval == pytest.approx(0.2)


def test_a_map_takes_each_step_in_units_of_the_critical_one_of_its_own_stiffness() -> None:
    steps = dict.fromkeys(Level, (0.5, 1.0))
    kn = dict.fromkeys(Level, (100.0, 400.0))
    other: Any = some()
    grid = Grid(SCENE, History(1.0, 1.0), (), steps, lambda kn: 1.0 / math.sqrt(kn or 1.0), kn,
                lambda kn: other)  # fmt: skip
    assert grid.rungs[Level.QUICK] == (
        Knobs(0.05, 100.0), Knobs(0.1, 100.0), Knobs(0.025, 400.0), Knobs(0.05, 400.0)
    )  # fmt: skip
    assert grid.ask(Knobs(0.05, 100.0)).scene is other
    bare = Grid(SCENE, History(1.0, 1.0), (), steps, lambda _: 1.0, kn)
    assert bare.ask(Knobs(0.05, 100.0)).scene is SCENE
    assert knob_grid((0.1, 0.2), (1.0, 2.0)) == (
        Knobs(0.1, 1.0), Knobs(0.2, 1.0), Knobs(0.1, 2.0), Knobs(0.2, 2.0)
    )  # fmt: skip
    assert [level.rank for level in Level] == [0, 1, 2]


@pytest.mark.parametrize(
    ("dt", "stride", "steps"),
    [(0.1, 3, 9), (0.3, 1, 3), (0.04, 8, 24), (0.5, 1, 2), (2.0, 1, 0), (0.17, 2, 4)],
)
def test_outputs_lie_at_whole_steps_within_the_duration(dt: float, stride: int, steps: int) -> None:
    goal = History(1.0, 0.3)
    assert (goal.stride(dt), goal.steps(dt)) == (stride, steps)
    assert goal.times(dt) == pytest.approx(dt * np.arange(0, steps + 1, stride))


def test_outputs_without_a_step_lie_at_the_interval_also_where_it_is_rounded() -> None:
    assert History(1.0, 0.3).times(None) == pytest.approx([0.0, 0.3, 0.6, 0.9])
    assert len(History(0.3, 0.1).times(None)) == 4  # 0.3/0.1 is 2.9999999999999996
    assert History(0.3, 0.1).steps(0.1) == 3
    assert History(1.0, 1.0).times(None).tolist() == [0.0, 1.0]
    with pytest.raises(ValueError, match="0 < interval <= duration"):
        History(1.0, 1.1)


@pytest.mark.parametrize(
    ("dd", "taken"), [(0.0, True), (0.5, True), (1.0, True), (1.1, False), (-0.1, False)]
)
def test_a_step_keeps_a_fraction_of_the_velocity(dd: float, taken: bool) -> None:
    if taken:
        assert Knobs(0.1, None, dd).dd == dd
        return
    with pytest.raises(ValueError, match="a fraction between 0 and 1"):
        Knobs(0.1, None, dd)


@pytest.mark.parametrize(
    ("reaches", "limits"),
    [
        ((1.0, 2.0, 3.0), (3.0, None)),
        ((1.0, 2.0, 9.0), (2.0, 3.0)),
        ((1.0, 9.0, 3.0), (1.0, 2.0)),  # above an unstable one nothing counts
        ((9.0, 2.0, 3.0), (0.0, 1.0)),
        ((1.0, 5.0, 5.1), (2.0, 3.0)),  # the bound itself is stable
        ((1.0, NAN, 3.0), (1.0, 2.0)),
        ((1.0, math.inf, 3.0), (1.0, 2.0)),
    ],
)
def test_a_limit_of_stability_lies_below_all_that_is_unstable(
    reaches: tuple[float, ...], limits: tuple[float, float | None]
) -> None:
    tried = np.column_stack([[1.0, 2.0, 3.0], reaches])
    assert Bracket(3.0, 5.0).stability_limits(tried) == limits


def test_what_is_not_reproduced_has_a_reason_and_several_misprints_are_more_than_one() -> None:
    for assessment in Assessment:
        if assessment is not Assessment.REPRODUCED:
            with pytest.raises(ValueError, match="has a reason"):
                Statement("Fig. 1", "what", "1", assessment)
    assert [Assessment.MISPRINT.counted(n) for n in (0, 1, 2)] == [
        "0 misprints", "1 misprint", "2 misprints"
    ]  # fmt: skip
    assert Assessment.WRONG.counted(2) == "2 wrong"

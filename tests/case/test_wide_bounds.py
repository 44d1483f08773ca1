"""Claims about bounds above the largest: cut at the case's parameters, and elsewhere not."""

from __future__ import annotations

import pytest

from tests.support.records.measured_runs import SCENE, SECOND, run
from vv.ask import History, Knobs, Method
from vv.case import (
    LARGEST_TOLERANCE,
    CodeToCode,
    Exact,
    Interval,
    Ladder,
    Level,
    Printed,
    Scalar,
    Shown,
    Tolerance,
    has_setting,
    shown_if_wide,
)
from vv.output.wording import scaled
from vv.records.outcomes import Verdict
from vv.records.record import measured

AT = Knobs(1e-3, 1e8)


def test_a_bound_is_cut_at_the_largest_and_tells_what_it_is() -> None:
    found = Tolerance(0.25, "why", late=10.0)
    assert found.uncut(AT) == pytest.approx(0.26)
    assert found.at(AT) == LARGEST_TOLERANCE == 0.1
    told = "0.25, plus 10 1/s times dt, cut at 0.1 at the case's own parameters and settings"
    assert scaled(found) == told


@pytest.mark.parametrize(("floor", "bound"), [(1e-5, 1e-5), (1e-7, 1e-6)])
def test_a_bound_may_have_fallen_below_its_floor(floor: float, bound: float) -> None:
    """Where the numbers of a case make the error of its step vanish, other errors remain."""
    assert Tolerance(1e-6, "why", floor=floor).at(AT) == bound


@pytest.mark.parametrize(
    ("bound", "shown"),
    [
        (Tolerance(0.1, "why"), False),
        (Tolerance(0.999, "why"), False),
        (Tolerance(1.0, "why"), True),
        (Tolerance(3.9, "why", dt=2e-3, order=2), False),  # 0.975 at 1e-3 s
        (Tolerance(4.1, "why", dt=2e-3, order=2), True),
        (Tolerance(0.09, "why", late=900.0), False),
        (Tolerance(0.09, "why", late=920.0), True),
        (Tolerance(0.05, "why", kn=5e10, softness=0.5), True),
    ],
)
def test_a_run_is_shown_where_its_bound_accepts_an_answer_of_zero(
    bound: Tolerance, shown: bool
) -> None:
    judge = Exact({SECOND: bound})
    found = shown_if_wide(judge, SECOND, AT)
    assert isinstance(found, Shown) is shown
    assert not isinstance(found, Shown) or "is allowed, so that nothing would be" in found.reason
    assert shown or found is judge
    assert shown_if_wide(judge, Method.LEAPFROG, AT) == found  # judged as its general class


def test_other_judges_stay() -> None:
    inside = Interval(1.0, 3.0, "why")
    assert shown_if_wide(inside, SECOND, AT) is inside


@pytest.mark.parametrize(
    ("modified", "value", "verdict"),
    [
        (False, 1.2, Verdict.FAIL),  # at the case's own parameters no error may be so large
        (False, 1.09, Verdict.PASS),
        (True, 1.24, Verdict.PASS),
        (True, 1.26, Verdict.FAIL),
    ],
)
def test_it_is_cut_at_the_parameters_of_the_case_alone(
    modified: bool, value: float, verdict: Verdict
) -> None:
    judge = Exact({SECOND: Tolerance(0.25, "why")})
    quantity = Scalar("e", "e", "J", "energy", lambda run: value, 1.0, 1.0, judge)
    assert measured(run(), quantity, SECOND, AT, modified)[0].verdict is verdict


@pytest.mark.parametrize(
    ("chosen", "value", "verdict"),
    [(False, 1.2, Verdict.FAIL), (True, 1.24, Verdict.PASS), (True, 1.26, Verdict.FAIL)],
)
def test_it_is_not_cut_at_a_setting_that_is_none_of_the_case(
    chosen: bool, value: float, verdict: Verdict
) -> None:
    judge = Exact({SECOND: Tolerance(0.25, "why")})
    quantity = Scalar("e", "e", "J", "energy", lambda run: value, 1.0, 1.0, judge)
    assert measured(run(), quantity, SECOND, AT, chosen=chosen)[0].verdict is verdict


def test_a_run_at_a_chosen_setting_is_shown_where_its_bound_tells_nothing() -> None:
    judge = Exact({SECOND: Tolerance(1.5, "why")})
    quantity = Scalar("e", "e", "J", "energy", lambda run: 1.2, 1.0, 1.0, judge)
    for chosen, verdict in ((False, Verdict.FAIL), (True, Verdict.NO_REFERENCE)):
        assert measured(run(), quantity, SECOND, AT, chosen=chosen)[0].verdict is verdict


def test_what_is_known_of_the_parameters_of_a_case_is_judged_at_a_chosen_setting_too() -> None:
    """The answer of another code holds at these parameters, whatever the setting."""
    printed = CodeToCode(Printed(1.0, 0.1, "code", "report"), 0.5, "why")
    quantity = Scalar("e", "e", "J", "energy", lambda run: 1.05, None, 1.0, printed)
    for modified, verdict in ((False, Verdict.PASS), (True, Verdict.NO_REFERENCE)):
        found, _ = measured(run(), quantity, SECOND, AT, modified, chosen=True)
        assert found.verdict is verdict


@pytest.mark.parametrize(
    ("knobs", "own"),
    [
        (Knobs(1e-3, 1e8), True),
        (Knobs(2e-3, 1e9), True),  # at another level
        (Knobs(1e-3, 1e9), False),
        (Knobs(1.1e-3, 1e8), False),
        (Knobs(1e-3), True),  # of a scheme without a stiffness
        (Knobs(3e-3), False),
        (Knobs(), True),  # of a scheme without settings
        (Knobs(1e-3, 1e8, 0.5), False),
    ],
)
def test_a_setting_is_of_the_case_if_it_is_so_at_any_level(knobs: Knobs, own: bool) -> None:
    levels = {Level.QUICK: (AT,), Level.DEFAULT: (AT,), Level.PAPER: (AT, Knobs(2e-3, 1e9))}
    study = Ladder(SCENE, History(1.0, 0.1), (), levels)
    assert has_setting(study, knobs) is own

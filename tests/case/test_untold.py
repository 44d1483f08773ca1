"""Claims about a class of methods that a case states no tolerance for: shown, not judged."""

from tests.conftest import Tiny
from vv.ask import Method
from vv.case import Exact, Shown, Tolerance, judge_for_method

JUDGE = Exact(
    {Method.EXACT: Tolerance(1e-12, "rounding")}, not_judged={Method.PENALTY: "it sinks in"}
)


def test_a_class_with_a_tolerance_is_judged() -> None:
    assert judge_for_method(JUDGE, Method.EXACT) is JUDGE


def test_a_class_without_one_is_shown_and_the_reason_names_the_class() -> None:
    assert judge_for_method(JUDGE, Method.PENALTY) == Shown("it sinks in")
    shown = judge_for_method(JUDGE, Method.FIRST_ORDER)
    assert shown == Shown("no tolerance for class first order in dt")


def test_a_leapfrog_is_judged_as_any_code_of_its_order_unless_a_case_says_more() -> None:
    any_code, own = Tolerance(1e-3, "its order"), Tolerance(1e-12, "the phase of a leapfrog")
    wide = Exact({Method.SECOND_ORDER: any_code}, not_judged={Method.FIRST_ORDER: "it lags"})
    assert judge_for_method(wide, Method.LEAPFROG) is wide
    assert wide.tolerance(Method.LEAPFROG) is any_code
    assert judge_for_method(wide, Method.LATE_LEAPFROG) == Shown("it lags")
    narrow = Exact({**wide.tolerances, Method.LEAPFROG: own})
    assert narrow.tolerance(Method.LEAPFROG) is own


def test_what_is_a_leapfrog_s_own_is_asked_of_no_other() -> None:
    own = Exact({Method.LEAPFROG: Tolerance(1e-12, "the phase of a leapfrog")})
    shown = judge_for_method(own, Method.SECOND_ORDER)
    assert shown == Shown("no tolerance for class second order in dt")


def test_a_code_of_such_a_class_runs_and_is_no_crash(tiny: Tiny) -> None:
    tiny.edit("cases/fall.py", "for method in Method}", "for method in (Method.EXACT,)}")
    done = tiny.vv("gate", "fall:up", "--codes", "fake/good")
    assert done.returncode == 0, done.stderr
    said = tiny.vv("explain", "fall:up").stdout
    assert "no tolerance for class second order in dt" in said

"""Claims that any value of any parameter ends in a plan, or in one sentence with value and rule."""

from __future__ import annotations

import re

import pytest

from vv.base.errors import UsageError
from vv.case import Case, Level
from vv.plan import planning
from vv.plan.planning import declare_trial
from vv.plan.project import find
from vv.plan.settings import parameters_with_settings

PROJECT = find()
HUGE = "1e300"
OTHER = (-1.0, 1e-3, 30.0)  # times the usual value
# words of Python and its libraries, which say nothing of a case
PYTHON = re.compile(
    r"math (domain|range)|out of range|too large|division|different signs|zero-size|complex|"
    r"\bfloat|\barrays?\b|\bNaN|\binfs\b|argument|NoneType|expected a|unpack|shape|\n"
)
STRICT = {
    ("chain", "kn"): "must not be negative",
    ("chain", "m"): "must be positive",
    ("column-collapse", "g"): "must be positive",
    ("failure-modes", "R"): "must be positive",
    ("kharaz", "R"): "must be positive",
    ("single-contact", "eta"): "must not be negative",
}


def variant_of(case: Case) -> str:
    """The first variant of the lowest level."""
    return next((v for v in case.variants if v.runs_at(Level.QUICK)), case.variants[0]).name


def refusal(case: Case, variant: str, setting: str) -> str:
    """Why a setting is refused; empty if it ends in a plan."""
    try:
        declare_trial(case, variant, parameters_with_settings(case, variant, [setting]))
    except UsageError as refused:
        return str(refused)
    return ""


# Python ignores, with a warning, the end of a calculation that comes while it frees an object.
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize("name", PROJECT.case_names())
def test_any_value_is_planned_or_refused_in_a_sentence(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(planning, "PATIENCE", 0.1)  # CPU s; what takes longer is refused so
    case = PROJECT.load_case(name)
    variant = variant_of(case)
    for parameter, usual in case.defaults(variant).items():
        tried = (repr(one * abs(usual or 1.0)) for one in OTHER)
        for value in ("0", *tried, HUGE, f"-{HUGE}", "nan", "inf"):
            told = refusal(case, variant, f"{parameter}={value}")
            assert told or value not in ("nan", "inf")
            if told:
                own = told.removeprefix(f"{name}:{variant}: ")
                assert re.search(rf"\b{parameter} = {re.escape(repr(float(value)))}\b", own), own
                assert re.search(r"[;:] \S+ \S+", own), own  # the rule
                assert not PYTHON.search(own), own
                assert HUGE in value or "Tolerance" not in own, own


@pytest.mark.parametrize(("case", "name"), STRICT)
def test_what_is_never_negative_is_refused_by_its_rule(case: str, name: str) -> None:
    made = PROJECT.load_case(case)
    variant = variant_of(made)
    value = -made.defaults(variant)[name]
    told = refusal(made, variant, f"{name}={value!r}")
    assert re.search(rf"\b{name} = {re.escape(repr(value))}.*; it {STRICT[case, name]}$", told)

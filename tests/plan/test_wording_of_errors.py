"""Claims about what is said of parameters, papers and modules that are wrong, and of schemes."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from vv.ask import Method
from vv.base.errors import UsageError
from vv.case import Case, Parameter, Source, Variant
from vv.case.published import Paper
from vv.output import listing
from vv.plan import imports, planning, published, rejections
from vv.plan.content import ProjectError
from vv.scene import Term

CHANGED = {"m = -1.0 kg": "m = -1.0", "mu = 2.0": "mu = 2.0"}


def raised(error: Exception) -> Exception:
    """The error as a case raises it."""
    try:
        raise error
    except type(error) as seen:
        return seen


@pytest.mark.parametrize(
    ("changed", "why", "said"),
    [
        ({}, "too slow", "too slow"),
        (CHANGED, "m = -1.0 is not positive", "m = -1.0 is not positive"),
        (CHANGED, "too slow", "with m = -1.0 kg, mu = 2.0: too slow"),
        # of another parameter whose name ends alike, and of another value than the user's
        ({"m = 2.0 kg": "m = 2.0"}, "rm = 2.0", "with m = 2.0 kg: rm = 2.0"),
        ({"m = 2.0 kg": "m = 2.0"}, "m = 2.05 kg; no", "with m = 2.0 kg: m = 2.05 kg; no"),
        ({"m = 2.0 kg": "m = 2.0"}, "m = np.float64(2.0) kg", "m = 2.0 kg"),
    ],
)
def test_parameters_that_are_rejected_are_named_unless_the_reason_has_one(
    changed: dict[str, str], why: str, said: str
) -> None:
    assert rejections._reason(changed, "m = 1.0 kg", raised(ValueError(why))) == said


@pytest.mark.parametrize(
    ("formula", "fails"),
    [
        (lambda: math.sqrt(-1.0), "has no value"),
        (lambda: 1.0 / 0.0, "divides by zero"),
        (lambda: np.array([]).max(), "has no value"),
        (lambda: [1.0][len("m")], "has no value"),
        (lambda: np.linalg.inv(np.zeros((2, 2))), "has no value"),  # raised by a library
    ],
)
def test_an_error_of_a_formula_is_told_in_no_words_of_python(
    formula: Callable[[], object], fails: str
) -> None:
    with pytest.raises(Exception) as failed:  # noqa: PT011  # any
        formula()
    assert isinstance(failed.value, Exception)
    told = rejections._reason(CHANGED, "m = 1.0 kg, mu = 0.5", failed.value)
    why = f"a formula of the case {fails}; the default is m = 1.0 kg, mu = 0.5"
    assert told == f"with m = -1.0 kg, mu = 2.0: {why}"


def test_parameters_are_changed_that_differ_from_the_variant_s_own() -> None:
    units = [SimpleNamespace(name="m", unit="kg"), SimpleNamespace(name="mu", unit="")]
    usual = {"m": 1.0, "mu": 0.5}
    case: Any = SimpleNamespace(name="fall", parameters=units, defaults=lambda variant: usual)

    def said(**parameters: float) -> str:
        return rejections.rejection(case, "T1", parameters, raised(ValueError("too slow")))

    assert said(m=1.0, mu=2.0) == "fall:T1: with mu = 2.0: too slow"
    assert said(m=-1.0, mu=0.5) == "fall:T1: with m = -1.0 kg: too slow"


def case_that(declare: Callable[[Mapping[str, float]], Any]) -> Case:
    """A case whose declaration does this with its parameters."""
    return Case(
        name="fall",
        title="A fall",
        source=Source("none", ""),
        parameters=(Parameter("m", 1.0, "kg", "mass"),),
        variants=(Variant("up", "up", "y = 0"),),
        declare=lambda variant, parameters: declare(parameters),
    )


@pytest.mark.parametrize("m", [1.0, 2.0])
def test_a_formula_that_fails_at_the_defaults_too_is_a_fault_of_the_case(m: float) -> None:
    wrong = case_that(lambda p: 1.0 + p["mass"])
    with pytest.raises(KeyError, match="mass"):
        planning.declare_trial(wrong, "up", {"m": m})


def test_a_formula_that_fails_away_from_the_defaults_is_told_with_the_value() -> None:
    study = SimpleNamespace(goal=SimpleNamespace(duration=1.0))
    far = case_that(
        lambda p: SimpleNamespace(study=study, quantities=[1.0][int(p["m"]) - 1 :][0] and ())
    )
    assert planning.declare_trial(far, "up", {"m": 1.0})
    with pytest.raises(UsageError, match=r"fall:up: with m = 2\.0 kg: .* default is m = 1\.0 kg"):
        planning.declare_trial(far, "up", {"m": 2.0})


def test_a_file_whose_paper_is_none_is_refused_by_its_name(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    paper = object.__new__(Paper)
    project: Any = SimpleNamespace(roots=())
    monkeypatch.setattr(published, "files", lambda project: [Path("a.py")])
    monkeypatch.setattr(imports, "attribute", lambda roots, file, name: paper)
    assert published.papers(project) == (paper,)
    monkeypatch.setattr(imports, "attribute", lambda roots, file, name: "a title")
    with pytest.raises(ProjectError, match=r"a\.py: PAPER is of type str; it must be Paper"):
        published.papers(project)


@pytest.mark.parametrize(
    ("file", "within"),
    [
        ("/one/cases/blocks/a.py", True),
        ("/two/adapters/b.py", True),
        ("/three/cases/a.py", False),  # only the first two folders are those of a project
        ("/one/docs/a.py", False),
    ],
)
def test_a_file_of_a_project_lies_in_a_package_of_its_first_two_folders(
    file: str, within: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "path", ["/one", "/two", "/three"])
    assert imports._in_content(Path(file)) is within


def test_a_scheme_is_listed_with_the_terms_that_lower_its_class() -> None:
    lowered = {
        Term.DRAG: Method.FIRST_ORDER,
        Term.GRAVITY: Method.PENALTY,
        Term.SHAKING: Method.FIRST_ORDER,
        Term.WALL_CONTACT: Method.FIRST_ORDER,
    }
    scheme: Any = SimpleNamespace(method=Method.SECOND_ORDER, lowered=lowered)
    few = f"{Term.DRAG.value}, {Term.SHAKING.value} or {Term.WALL_CONTACT.value}"
    assert [*listing._methods(scheme)] == [
        Method.SECOND_ORDER.value,
        f"{Method.FIRST_ORDER.value} in scenes with {few}",
        f"{Method.PENALTY.value} in scenes with {Term.GRAVITY.value}",
    ]

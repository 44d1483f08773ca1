"""Claims about what is said of parameters, papers and modules that are wrong, and of schemes."""

from __future__ import annotations

import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from vv.ask import Method
from vv.case.published import Paper
from vv.output import listing
from vv.plan import imports, planning, published
from vv.plan.content import ProjectError
from vv.scene import Term

CHANGED = {"m": "m = -1.0 kg", "mu": "mu = 2.0"}


@pytest.mark.parametrize(
    ("changed", "error", "said"),
    [
        ({}, ValueError("too slow"), "too slow"),
        (CHANGED, ValueError("m = -1.0 is not positive"), "m = -1.0 is not positive"),
        (CHANGED, ValueError("too slow"), "with m = -1.0 kg, mu = 2.0: too slow"),
        # of another parameter whose name ends alike
        ({"m": "m = 2.0 kg"}, ValueError("rm = 1"), "with m = 2.0 kg: rm = 1"),
        (
            {"m": "m = 0.0 kg"},
            ZeroDivisionError("float division"),
            "with m = 0.0 kg: a formula of the case divides by zero",
        ),
    ],
)
def test_parameters_that_are_rejected_are_named_unless_the_reason_names_one(
    changed: dict[str, str], error: Exception, said: str
) -> None:
    assert planning._with(changed, error) == said


def test_parameters_are_changed_that_differ_from_the_variant_s_own() -> None:
    units = [SimpleNamespace(name="m", unit="kg"), SimpleNamespace(name="mu", unit="")]
    case: Any = SimpleNamespace(parameters=units, defaults=lambda variant: {"m": 1.0, "mu": 0.5})
    assert planning._changed(case, "T1", {"m": 1.0, "mu": 2.0}) == {"mu": "mu = 2.0"}
    assert planning._changed(case, "T1", {"m": -1.0, "mu": 0.5}) == {"m": "m = -1.0 kg"}


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

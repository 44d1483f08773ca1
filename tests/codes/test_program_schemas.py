"""The published schemas of what programs read and write: real files obey them, others do not."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator, ValidationError

from tests import ROOT
from vv.case import Case, Level
from vv.codes.program import question, result
from vv.codes.program.declared import KINDS, words_of
from vv.plan.project import find
from vv.scene import Form, Loss, Term

FOLDER = ROOT / "vv" / "codes" / "program"
ASK, RESULT = (json.loads((FOLDER / f"{n}.schema.json").read_text()) for n in ("ask", "result"))
PROJECT = find(ROOT)
SLOW = "close-packed"  # lattices that take seconds to build, of the same parts as smaller ones
NAMES = [name for name in PROJECT.case_names() if not name.startswith(SLOW)]
CASES = [PROJECT.load_case(name) for name in NAMES]


def asked(case: Case, variant: str) -> str:
    """The question of a variant at its coarsest setting."""
    study = case.declare(variant, case.defaults(variant)).study
    return question.text(study.ask(study.rungs[Level.QUICK][0]), "default", ("dt", "kn"))


def good_question() -> dict[str, Any]:
    case = next(case for case in CASES if case.name == "single-contact")
    data: dict[str, Any] = json.loads(asked(case, "T4"))
    return data


@pytest.mark.parametrize("schema", [ASK, RESULT], ids=["ask", "result"])
def test_a_schema_is_a_schema(schema: dict[str, Any]) -> None:
    Draft202012Validator.check_schema(schema)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_what_every_case_asks_obeys_the_schema(case: Case) -> None:
    for variant in (case.variants[0], case.variants[-1]):
        Draft202012Validator(ASK).validate(json.loads(asked(case, variant.name)))


def test_the_schema_knows_every_term_observable_and_form() -> None:
    seen = ASK["properties"]
    terms = [*words_of(Term)]
    assert seen["terms"]["items"]["enum"] == RESULT["properties"]["terms"]["items"]["enum"] == terms
    assert set(seen["observables"]["items"]["properties"]["kind"]["enum"]) == set(KINDS)
    assert seen["energies"]["items"]["properties"]["form"]["enum"] == [*words_of(Form)]
    told = RESULT["properties"]["energies"]["properties"]["forms"]["description"]
    assert all(word in told for word in (*words_of(Form), *words_of(Loss)))
    assert seen["format"]["const"] == question.FORMAT


@pytest.mark.parametrize(
    ("place", "value"),
    [
        ("format", "vv ask 0"),
        ("terms", ["magic"]),
        ("times", []),
        ("steps", -1),
        ("scene", {}),
        ("colour", "red"),
    ],
)
def test_the_schema_refuses_what_is_no_question(place: str, value: object) -> None:
    with pytest.raises(ValidationError):
        Draft202012Validator(ASK).validate({**good_question(), place: value})


def test_what_the_reader_of_results_takes_is_what_the_schema_describes(tmp_path: Path) -> None:
    assert list(RESULT["properties"]) == list(result.READERS)
    balance = {"forms": {"kinetic": 1.0}, "unaccounted": 0.0, "peak": 1.0, "bound": 0.1}
    whole = {"status": "ran", "reason": "", "solve_cpu": 0.1, "steps": 3, "unknowns": 6}
    whole |= {"terms": ["sphere"], "note": "", "energies": balance}
    Draft202012Validator(RESULT).validate(whole)
    (tmp_path / "result.json").write_text(json.dumps(whole))
    assert result.read_result(tmp_path / "result.json").unknowns == 6

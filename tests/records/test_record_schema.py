"""The published schema of records: real records obey it, malformed ones do not."""

import copy
import json
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator, FormatChecker

import vv
from tests.conftest import Tiny

SCHEMA = json.loads((Path(vv.__file__).parent / "records" / "record.schema.json").read_text())
VALIDATOR = Draft202012Validator(SCHEMA, format_checker=FormatChecker())


@pytest.fixture
def document(tiny: Tiny) -> dict[str, Any]:
    """A document with records of all sorts, as the command line writes it."""
    codes = "fake/good,fake/refuses,fake/raises,fake/coarse,missing"
    tiny.vv("run", "fall:up", "--codes", codes, "--json", "out.json")
    text = (tiny.root / "out.json").read_text()
    assert "NaN" not in text
    assert "Infinity" not in text
    return dict(json.loads(text))


def test_the_schema_is_a_schema() -> None:
    Draft202012Validator.check_schema(SCHEMA)


def test_records_obey_the_schema(document: dict[str, Any]) -> None:
    VALIDATOR.validate(document)
    assert {r["status"] for r in document["records"]} == {
        "ran",
        "refused",
        "error",
        "not-installed",
    }


def test_a_record_names_the_parameters_that_were_changed(tiny: Tiny) -> None:
    words = ("--set", "speed=4", "--set", "g=9.81")
    tiny.vv("run", "fall:up", "--codes", "fake/good", *words, "--json", "out.json")
    document = json.loads((tiny.root / "out.json").read_text())
    VALIDATOR.validate(document)
    assert {tuple(r["changed"]) for r in document["records"]} == {("speed",)}


def test_series_are_written_out_with_their_reference(document: dict[str, Any]) -> None:
    series = document["records"][0]["quantities"][0]
    assert len(series["value"]["t"]) == len(series["value"]["y"]) == len(series["reference"]["y"])
    assert series["value"]["y"][1] == pytest.approx(0.5 - 9.81 * 0.01 / 2)


KINDS = {
    "scalar": 1.5,
    "count": 3,
    "series": {"t": [0.0, 1.0], "y": [0.0, None]},
    "map": {"x": [1.0], "y": [1.0, 2.0], "z": [[0.1, None]]},
}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("other", KINDS)
def test_each_kind_of_quantity_holds_its_own_form_only(
    document: dict[str, Any], kind: str, other: str
) -> None:
    changed = copy.deepcopy(document)
    entry = changed["records"][0]["quantities"][0]
    entry.update(kind=kind, value=KINDS[other], reference=None)
    fits = kind == other or (kind, other) == ("scalar", "count")
    assert VALIDATOR.is_valid(changed) is fits


@pytest.mark.parametrize("field", SCHEMA["$defs"]["record"]["required"])
def test_no_field_of_a_record_may_be_left_out(document: dict[str, Any], field: str) -> None:
    changed = copy.deepcopy(document)
    del changed["records"][0][field]
    assert not VALIDATOR.is_valid(changed)

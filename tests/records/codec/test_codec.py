"""Records are written as they always were, read again as they were, and damage is named."""

from __future__ import annotations

import dataclasses
import enum
import json
import typing
from pathlib import Path
from typing import Any

import pytest

import vv
from tests.support.fabricated import cost, entry, record
from vv.ask import Knobs, Ledger
from vv.insight.stability_summary import StabilityStatement
from vv.records import codec
from vv.records.codec import DamagedError
from vv.records.finding import Aspect, Bit, Finding
from vv.records.job_record import JobCost, ModelSummary, Record
from vv.records.manifest import Machine, Provenance
from vv.records.quantity import MeasuredQuantity
from vv.records.recorded import RecordedQuantity
from vv.store import manifest_text, record_list

KEPT = Path(__file__).with_name("manifest.json")  # of one case, by the code before the classes
SCHEMA = json.loads((Path(vv.__file__).parent / "records" / "record.schema.json").read_text())
NODES = SCHEMA["$defs"]
RECORD = NODES["record"]["properties"]
CLASSES: dict[type, dict[str, Any]] = {
    Record: NODES["record"],
    MeasuredQuantity: NODES["quantity"],
    JobCost: NODES["cost"],
    Provenance: NODES["provenance"],
    Machine: NODES["provenance"]["properties"]["machine"],
    StabilityStatement: NODES["stability"],
    Knobs: RECORD["rung"],
    ModelSummary: RECORD["model"]["anyOf"][1],
    Ledger: RECORD["ledger"]["anyOf"][1],
}
WRITTEN_OUT = {"provenance"}  # fields of a document's records that stand once in a manifest


def test_a_manifest_of_before_is_read_and_loses_nothing_when_it_is_written_again() -> None:
    """In it each record is whole; now it is written by what it has other than the one before."""
    text = KEPT.read_text(encoding="utf-8")
    found = manifest_text.whole(text, "kept")
    again = manifest_text.whole(manifest_text.render(found), "kept")
    assert codec.render(again, sort_keys=True) == codec.render(found, sort_keys=True)
    assert len(manifest_text.render(found)) < len(text)
    assert {r.cost.timed for r in found.records} == {True, False}
    assert found.findings
    assert found.baselines
    assert found.recorded


def test_a_record_in_a_list_keeps_what_it_alone_has() -> None:
    """Values that are equal and yet written otherwise are not taken for the same."""
    one = record("dem/default", "T1", 1e-3)
    breach = dataclasses.replace(one, known_breaches=("energy",), parameters={"m": 0.0})
    many = [one, breach, breach, dataclasses.replace(one, parameters={"m": -0.0}), one]
    text = record_list.render(many)
    assert [*map(repr, record_list.read(codec.parse(text), "records"))] == [*map(repr, many)]
    assert [len(each) for each in codec.parse(text)][1:] == [2, 0, 2, 1]


@pytest.mark.parametrize(
    ("data", "said"),
    [
        ({}, "records = {}; must be a list"),
        ([1], r"records\[0\] = 1; must be an object"),
        ([{"steps": 3}], r"records\[0\]; .*missing"),
        ([{"steps": "3"}], r"records\[0\].steps = '3'; must be a whole number"),
        ([{"stepz": 3}], r"records\[0\].stepz = 3; is not a field of Record"),
    ],
)
def test_what_is_no_list_of_records_is_named(data: object, said: str) -> None:
    with pytest.raises(DamagedError, match=said):
        record_list.read(data, "records")


@pytest.mark.parametrize("kind", CLASSES, ids=lambda kind: kind.__name__)
def test_the_schema_has_the_fields_of_the_classes_in_their_kinds(kind: type) -> None:
    node, hints = CLASSES[kind], typing.get_type_hints(kind)
    fields = {field.name: field for field in dataclasses.fields(kind)}
    assert set(node["properties"]) - WRITTEN_OUT == set(fields)
    always = {name for name, field in fields.items() if "omitted" not in field.metadata}
    assert set(node["required"]) - WRITTEN_OUT | {"end"} >= always
    for name, hint in hints.items():
        if isinstance(hint, enum.EnumType):
            members: list[enum.Enum] = list(hint)
            assert node["properties"][name]["enum"] == codec.to_data(members)
    plain = {str: "string", bool: "boolean", int: "integer", float: "number"}
    for name, hint in hints.items():
        if hint in plain:
            assert node["properties"][name]["type"] == plain[hint]


def test_what_is_written_is_read_again_as_it_was() -> None:
    ledger = Ledger({"kinetic": 1.0}, 1e-9, 2.0, None, {"momentum": (0.0, 1e-9)})
    spent = dataclasses.replace(cost(timed=True), relative=(1.0, 1.5), session="s")
    whole = record("dem/default", "T1", 1e-3, quantities=[entry("fail", {"max": None})])
    whole = dataclasses.replace(whole, ledger=ledger, cost=spent)
    assert codec.read(Record, codec.parse(codec.render(whole)), "record") == whole
    found = Finding(Aspect.SPEED, "slower", "text", bit=Bit.SPEED, size=2.0)
    assert codec.read(Finding, codec.to_data(found), "finding") == found
    few = RecordedQuantity({"final": 1.0}, (0.0, 1.0), (None, 2.0))
    assert codec.to_data(few) == {"final": 1.0, "t": [0.0, 1.0], "y": [None, 2.0]}
    assert codec.read(RecordedQuantity, codec.to_data(few), "few") == few


def damaged(**changes: Any) -> dict[str, Any]:
    seen = entry("pass", {"max": 1e-4})
    return {**codec.to_data(record("dem/default", "T1", 1e-3, quantities=[seen])), **changes}


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (damaged(cost={**damaged()["cost"], "solve_cpu": "x"}),
         "record.cost.solve_cpu = 'x'; must be a number"),
        (damaged(steps=1.5), "record.steps = 1.5; must be a whole number"),
        (damaged(steps=True), "record.steps = True; must be a whole number"),
        (damaged(case=None), "record.case = None; must be a text"),
        (damaged(modified=0), "record.modified = 0; must be true or false"),
        (damaged(study="maze"), "record.study = 'maze'; must be of ladder, search, grid"),
        (damaged(parameters={"m": "1"}), "record.parameters.m = '1'; must be a number"),
        (damaged(parameters=[]), "record.parameters = []; must be an object"),
        (damaged(quantities={}), "record.quantities = {}; must be a list"),
        (damaged(quantities=[{}]), "record.quantities[0].name; is missing"),
        (damaged(quantities=[{**damaged()["quantities"][0], "errors": {"max": "?"}}]),
         "record.quantities[0].errors.max = '?'; must be a number"),
        (damaged(cost={**damaged()["cost"], "relative": [1.0]}),
         "record.cost.relative = [1.0]; must be a list of 2"),
        (damaged(colour="red"), "record.colour = 'red'; is not a field of Record"),
        (damaged(rung={"dt": -1.0, "kn": None}),
         "record.rung; dt = -1.0 s; a knob must be positive and finite"),
        ("text", "record = 'text'; must be an object"),
    ],
)  # fmt: skip
def test_damage_is_named_by_field_value_and_rule(data: object, said: str) -> None:
    with pytest.raises(DamagedError) as caught:
        codec.read(Record, data, "record")
    assert str(caught.value) == said


@pytest.mark.parametrize("number", ["1e999", "-1e999"])
def test_a_number_too_large_for_any_is_not_read(number: str) -> None:
    with pytest.raises(DamagedError, match="must be finite"):
        codec.read(float, codec.parse(number), "x")


@pytest.mark.parametrize("constant", ["NaN", "Infinity", "-Infinity"])
def test_a_number_that_is_not_finite_is_neither_read_nor_written(constant: str) -> None:
    with pytest.raises(DamagedError, match=f"'{constant}'; a number must be finite"):
        codec.parse(f'{{"a": {constant}}}')
    with pytest.raises(ValueError, match="not JSON compliant"):
        codec.render({"a": float(constant)})

"""Accepted, answered and recorded results that are damaged are named, never a traceback."""

from __future__ import annotations

import dataclasses
import datetime
import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support.damaged import cut_short, of_wrong_types
from tests.support.fabricated import changed, entry, record
from vv.base.errors import UsageError
from vv.gate import (
    acceptance,
    all_checks,
    answers,
    baseline,
    disagreement,
    known_breaches,
    recorded,
    regression,
    speed,
)
from vv.gate.ledger_file import read_breaches, read_disagreements
from vv.gate.regression import Strictness
from vv.plan.project import Project
from vv.records import codec
from vv.records.accepted import Acceptance, Place
from vv.records.job_record import Record
from vv.records.recorded import RecordedFile

ACCEPTANCE = Acceptance("c", False, Place("P", "S"), "r", "2026-12-22T10:00:00+00:00", {})
TODAY = datetime.date(2027, 1, 1)


def runs() -> list[Record]:
    quantity = entry("pass", {"max": 1e-4}, scale=2.0, figures={"final": 3.0})
    made = record("dem/default", "T1", 1e-3, quantities=[quantity])
    cost = dataclasses.replace(made.cost, relative=(1.0, 2.0))
    return [dataclasses.replace(made, cost=cost)]


def refusal(ask: Callable[[], Any]) -> str:
    """What is said of a file; '' if it is good enough. Anything but a UsageError is a bug."""
    try:
        ask()
    except UsageError as error:
        return str(error)
    return ""


def damaged(text: str) -> Iterator[str]:
    yield from cut_short(text)
    yield from of_wrong_types(text)


def test_a_damaged_baseline_is_named_or_compared(tmp_path: Path) -> None:
    good = acceptance.accepted("bounce", None, runs(), ACCEPTANCE, ())
    path, said = tmp_path / "bounce.json", []

    def ask() -> None:
        found = baseline.read(tmp_path, "bounce")
        regression.compare("bounce", runs(), found, Strictness((), True, True))
        regression.removed_results("bounce", found, ["T1"], ["dem/default"], ["dem"])
        speed.compare("bounce", runs(), found, "P", True)
        acceptance.accepted("bounce", found, runs(), ACCEPTANCE, ())
        if found:
            all_checks._summary(found)

    for text in damaged(json.dumps(codec.to_data(good))):
        path.write_text(text)
        said.append(refusal(ask))
    assert len(list(filter(None, said))) > 0.6 * len(said)
    assert all(one.startswith(f"{path}: ") for one in said if one)


def test_damaged_answers_are_named_or_compared(tmp_path: Path) -> None:
    (tmp_path / "cases" / "answers").mkdir(parents=True)
    path = tmp_path / "cases" / "answers" / "bounce.json"
    project, said = Project(tmp_path), []

    def ask() -> None:
        known = answers.accepted(project, "bounce") or {}
        list(answers.compare("bounce", runs(), known, True))

    for text in damaged(json.dumps({"dem/default": {"T1": "no springs", "T2": 3}})):
        path.write_text(text)
        said.append(refusal(ask))
    assert len(list(filter(None, said))) > 0.5 * len(said)
    assert all(one.startswith(f"{path}: ") for one in said if one)


def test_damaged_recorded_results_are_named_or_shown(tmp_path: Path) -> None:
    utc = "2026-12-22T10:00:00+00:00"
    series = {"t": np.linspace(0.0, 1.0, 5), "y.value": np.linspace(0.0, 2.0, 5)}
    file = RecordedFile("dem", "", "2.0", utc, "c", False, Place("P", "S"))
    (path,) = recorded.write_recorded(tmp_path, runs(), lambda _: series, {"dem": file})
    absent, said = [changed(runs()[0], status="not-installed")], []
    assert recorded.shown(tmp_path, absent, TODAY)
    for text in damaged(path.read_text()):
        path.write_text(text)
        said.append(refusal(lambda: recorded.shown(tmp_path, absent, TODAY)))
    assert len(list(filter(None, said))) > 0.6 * len(said)
    assert all(one.startswith(f"{path}: ") for one in said if one)


DISAGREEMENT = {
    "code": '"dem"', "schemes": '"*"', "versions": '"*"', "case": '"bounce"', "variants": '["T1"]',
    "quantity": '"y"', "dt": "1e-3", "error": "[5e-3, 2e-2]", "reason": '"late"',
    "expires": "2027-06-01", "order": "[0.9, 1.1]", "rungs": '["*"]',
}  # fmt: skip
BREACH = {
    "code": '"dem"', "schemes": '"*"', "versions": '"*"', "case": '"bounce"', "variants": '["T1"]',
    "law": '"energy *"', "rungs": '["*"]', "breach": "[1.0, 2.0]", "reason": '"soft"',
    "expires": "2027-06-01",
}  # fmt: skip
OTHERS = (
    "true", "3", "-1.5", "nan", "inf", '""', '"a"', '"\\u001b[31m"', "[]", "[1]", '["a", 1]',
    "[[1.0, 2.0]]", "{}", "{a = 1}", "2027-01-01", "12:00:00", "2027-01-01T00:00:00Z",
)  # fmt: skip


@pytest.mark.parametrize(("kind", "given"), [("disagreement", DISAGREEMENT), ("breach", BREACH)])
def test_a_ledger_of_wrong_types_is_named_or_read(
    tmp_path: Path, kind: str, given: dict[str, str]
) -> None:
    path, said = tmp_path / "disagreements.toml", []

    def ask() -> None:
        known, broken = read_disagreements(path), read_breaches(path)
        disagreement.expiry_findings(disagreement.judge(runs(), known, TODAY), known, TODAY)
        known_breaches.expiry_findings(known_breaches.judge(runs(), broken, TODAY), broken, TODAY)

    for name in given:
        for other in OTHERS:
            lines = [f"{n} = {other if n == name else v}" for n, v in given.items()]
            path.write_text("\n".join([f"[[{kind}]]", *lines]))
            said.append(refusal(ask))
    assert len(list(filter(None, said))) > 0.6 * len(said)
    assert all(one.startswith(f"{path}: ") for one in said if one)

"""Claims about papers beside an invocation: what is worked out once, and which records count."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.conftest import tiny_project
from tests.support.fabricated import changed, entry, manifest, record, some
from vv.ask import Knobs
from vv.case.published import Assessment, Computed, Paper, Statement
from vv.gate import all_checks
from vv.insight import papers
from vv.insight import rows_of_run as rows_of_run_module
from vv.insight.history import history
from vv.insight.papers import Row
from vv.insight.rows_of_run import rows_of_run
from vv.plan.exact_numbers import with_exact_numbers
from vv.plan.project import Project, find
from vv.records.accepted import AcceptedQuantity, AcceptedResult
from vv.store.store import Store

SEEN = (Computed("bounce", "T1", "y"),)


def paper(exact: float, asked: list[float]) -> Paper:
    """A paper of two statements, the second without an exact number; `asked` grows by each call."""

    def number() -> float:
        asked.append(exact)
        return exact

    one = Statement("Eq. 1", "what", "2.0", Assessment.REPRODUCED, "", "m", number, SEEN)
    return Paper("A", "B", "", (one, Statement("Eq. 2", "a", "1", Assessment.OPEN, "no number")))


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Project:
    monkeypatch.delenv("VV_DATA", raising=False)
    return find(tiny_project(tmp_path).root)


def test_an_exact_number_is_worked_out_once_and_kept(project: Project) -> None:
    asked: list[float] = []
    for _ in range(2):
        (found,) = with_exact_numbers([paper(2.5, asked)], project, [])
        first, second = found.statements
        assert callable(first.exact)
        assert first.exact() == 2.5
        assert not callable(second.exact)
    assert asked == [2.5]


@pytest.mark.parametrize("kept", [(), (1.0, 2.0, 3.0)])
def test_kept_numbers_and_rows_of_another_count_are_worked_out_anew(
    project: Project, monkeypatch: pytest.MonkeyPatch, kept: tuple[float, ...]
) -> None:
    """Sealed as they are, such as by an older form: they ended reports in a traceback."""
    store = Store(project.data())
    whole = manifest(record("dem/default", "T1", 1e-3), name="01")
    store.manifests.keep(whole)
    monkeypatch.setattr(
        Store, "facts", lambda _, kind, key: kept if f"{kind}".startswith("tuple[") else None
    )
    ((first, _),) = [one.statements for one in with_exact_numbers([paper(2.5, [])], project, [])]
    assert callable(first.exact)
    assert first.exact() == 2.5
    assert len(rows_of_run([paper(2.5, [])], project, whole)) == 1
    assert len(history(store, "bounce", print)) == 1


def test_what_ran_at_other_parameters_or_not_at_all_answers_no_statement(project: Project) -> None:
    value = entry("pass", {"max": 1e-4}, figures={"value": 2.0})
    good = record("dem/default", "T1", 1e-3, quantities=[value])
    rows: tuple[tuple[dict[str, Any], int], ...] = (
        ({}, 1),
        ({"modified": True}, 0),
        ({"status": "error"}, 0),
    )
    for changes, answers in rows:
        whole = manifest(changed(good, **changes))
        ((row, _),) = rows_of_run([paper(2.0, [])], project, whole)
        assert len(row.answers) == answers, changes


def test_new_results_of_a_case_have_only_the_papers_about_it_read_anew(
    project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is kept of the others stays."""
    asked: list[str] = []
    rows = papers.rows

    def worked_out(paper: Paper, results: Callable[[str], papers.Results]) -> tuple[Row, ...]:
        asked.append(paper.name)
        return rows(paper, results)

    monkeypatch.setattr(papers, "rows", worked_out)
    seen, open_ = paper(2.0, []).statements
    one = Paper("one", "", "", (seen,))
    other = Paper("other", "", "", (open_,))
    for number, error in enumerate((1e-3, 1e-3, 2e-3)):
        whole = manifest(record("dem/default", "T1", error), name=f"0{number}")
        Store(project.data()).manifests.keep(whole)
        rows_of_run([one, other], project, whole)
    assert asked == ["one", "other", "one"]


def test_an_answer_of_the_invocation_stands_in_place_of_the_accepted_one(
    project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The second statement is of a setting that was accepted, and did not run here."""
    kept = {
        f"T1 dem/default dt={dt}": AcceptedResult("1", None, {
            "y": AcceptedQuantity(1e-4, 1.0, {"value": value})
        })
        for dt, value in (("0.001", 3.0), ("0.002", 4.0))
    }  # fmt: skip
    monkeypatch.setattr(all_checks, "baseline_of", lambda *_: some(results=kept))
    value = entry("pass", {"max": 1e-4}, figures={"value": 2.0})
    whole = manifest(record("dem/default", "T1", 1e-3, quantities=[value]))
    statements = tuple(
        Statement("Eq.", "what", "2", Assessment.OPEN, "open", "m", "none",
                  (Computed("bounce", "T1", "y", rung=Knobs(dt)),))
        for dt in (1e-3, 2e-3)
    )  # fmt: skip
    (rows,) = rows_of_run([Paper("A", "B", "", statements)], project, whole)
    assert [[answer.text for answer in row.answers] for row in rows] == [["2"], ["4"]]


def test_rows_that_are_kept_are_those_of_a_paper_and_of_its_sources(
    project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = manifest(record("dem/default", "T1", 1e-3), name="01")
    Store(project.data()).manifests.keep(whole)
    one, other = (
        Paper(
            name, "", "", (Statement("Eq.", name, "2", Assessment.OPEN, "open", "m", "none", SEEN),)
        )
        for name in ("one", "other")
    )
    for _ in ("computed", "kept"):
        assert [row.what for (row,) in rows_of_run([one, other], project, whole)] == [
            "one", "other"
        ]  # fmt: skip
    edited = Paper("one", "", "", (dataclasses.replace(one.statements[0], what="edited"),))
    monkeypatch.setattr(rows_of_run_module, "_sources", lambda _: "other sources")
    ((row,),) = rows_of_run([edited], project, whole)
    assert row.what == "edited"

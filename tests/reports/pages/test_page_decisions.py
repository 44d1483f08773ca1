"""Claims about decisions in whole pages and the environment's part: small truth tables, by hand."""

from __future__ import annotations

from typing import Any

import pytest

import reports.pages.case as case_page
import reports.pages.code as code_page
import reports.pages.papers as papers_page
from reports import environment
from reports.marks import marks
from reports.outcomes import OUTCOMES
from reports.pages import troubles
from tests.support.fabricated import case, changed, entry, record, some
from vv.case.published import Assessment
from vv.gate.judgement import breaches
from vv.insight.papers import Answer
from vv.records.finding import Aspect
from vv.records.outcomes import Outcome


@pytest.mark.parametrize(
    ("outcome", "quiet", "known"),
    [(Outcome.FAIL, True, True), (Outcome.FAIL, False, False), (Outcome.PASS, True, False),
     (Outcome.PASS, False, False)],
)  # fmt: skip
def test_what_the_gate_is_not_red_for_is_reported_only(
    outcome: Outcome, quiet: bool, known: bool
) -> None:
    said = str(environment.tag(OUTCOMES[outcome], 3, quiet))
    assert ("reported only" in said) is known
    assert ('class="tag known"' in said) is known
    assert " 3" in said
    assert " 3" not in str(environment.tag(OUTCOMES[outcome]))


def test_new_findings_count_as_without_a_baseline_unless_they_are_red(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for name in ("troubles", "findings", "refused", "sections"):
        monkeypatch.setattr(environment, name, lambda *given: [])
    every = [
        some(case=name, kind=kind, red=red, compares=compares)
        for name, kind, red, compares in (
            ("a", "new", False, True), ("b", "new", True, True), ("c", "worse", False, True),
            ("a", "new", False, True), ("d", "worse", True, False),
        )
    ]  # fmt: skip
    monkeypatch.setattr(environment, "worst_first", lambda found: found)
    seen = environment._attention(some(manifest=some(findings=every)))
    assert (seen["without"], seen["unheld"]) == (["a"], 2)
    assert [one.case for one in seen["moved"]] == ["b", "c"]


def test_a_code_has_its_own_records_schemes_findings_and_refusals(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    noted: list[Any] = []

    def note(book: Any, found: list[Any]) -> list[Any]:
        noted.extend(found)
        return []

    monkeypatch.setattr(code_page, "troubles", note)
    monkeypatch.setattr(code_page, "heads", lambda book: {"a": "head"})
    looks = marks(["a/one", "a/two", "b/one"])
    rows = [some(mark=looks[label]) for label in looks]
    refused = [
        record("a/one", variant, 1e-3, status="refused", reason=reason)
        for variant, reason in (("T1", "seldom"), ("T1", "often"), ("T2", "often"))
    ]
    runs = [record("b/one", "T1", 1e-3, code_version="9"), record("a/two", "T1", 1e-3)]
    book = some(
        shown=[(one, OUTCOMES[Outcome.PASS]) for one in (*runs, runs[1])],
        findings=[some(label="a/one"), some(label="b/one"), some(label="aa/one")],
        manifest=some(records=[*runs, *refused], external=lambda: {"b"}),
        to_case=lambda *names: "-".join(names),
    )
    ranks = [some(mark=looks[label], error=e, why="") for label, e in
             (("b/one", 1e-3), ("a/two", 2e-3), ("a/one", None))]  # fmt: skip
    made = code_page.code(book, "a", some(rows=rows), {("bounce", "T1"): ranks})
    assert (made.version, made.in_house, made.head) == ("1.2", True, "head")
    assert [one.label for one in made.marks] == ["a/one", "a/two"]
    assert [one.label for one in noted] == ["a/one"]
    assert [count for _, count in made.counts] == [2]
    assert [(one.row.mark.label, one.rank, one.of) for one in made.lines] == [
        ("a/two", 2, 2), ("a/one", 3, 2)
    ]  # fmt: skip
    assert made.refusals == [
        ("one", "often", [("bounce", ["T1", "T2"])]), ("one", "seldom", [("bounce", ["T1"])])
    ]  # fmt: skip
    other = code_page.code(book, "b", some(rows=rows), {})
    assert (other.version, other.in_house, other.head) == ("9", False, "")


def test_a_breach_of_conservation_is_told_by_its_own_law() -> None:
    energy = {"terms": {}, "unaccounted": 2.0, "peak": 9.0, "bound": 1.0, "audits": {}}
    judged = record("a/a", "T1", 1e-3, quantities=[entry("fail", {"max": 1.0})])
    one = changed(judged, ledger=energy)
    (kind,) = (found[0] for found in breaches(one.ledger))

    def told(check: Aspect, known: Any) -> str:
        return troubles._text(some(check=check, kind=kind, text="slow", quantity="y"), known)

    assert told(Aspect.CONSERVATION, one).startswith("Energy not accounted for: 2 J")
    assert not told(Aspect.ACCURACY, one).startswith("Energy not")
    assert told(Aspect.SPEED, None).endswith("low")


def test_quantities_that_are_judged_alike_stand_together() -> None:
    facts = case()
    (one,) = facts.variants["T1"].quantities
    (bound,) = (one.tolerances or {}).values()
    wide = changed(one, name="w", tolerances={"second order in dt": changed(bound, value=0.5)})
    alike, free = changed(one, name="z"), changed(one, name="v", norm="final")
    piles = case_page._judged_alike([(q, ["T1"]) for q in (one, wide, alike, free)])
    assert [[q.name for q, _ in pile] for pile in piles] == [["y", "z"], ["w"], ["v"]]
    assert [(q.name, names) for q, names in case_page._quantities(facts)] == [("y", ["T1", "T2"])]
    assert case_page._stated_step(facts) == 1e-3
    bare = changed(one, tolerances={"exact": changed(bound, dt=None)})
    variants = {name: changed(v, quantities=[bare]) for name, v in facts.variants.items()}
    assert case_page._stated_step(changed(facts, variants=variants)) is None
    runs = [record("a/a", "T1", dt, quantities=[entry("pass", {"pointwise": e})]) for dt, e in
            ((2e-3, 0.5), (1e-3, 0.25))]  # fmt: skip
    runs.append(record("b/b", "T1", None, quantities=[entry("pass", {"pointwise": 0.125})]))
    assert case_page._pointwise(runs, 2e-3) == {"a/a": 0.5, "b/b": 0.125}


def test_of_several_broken_laws_each_is_told_by_its_own_numbers() -> None:
    audits = {"penetration [m]": (0.25, 0.125), "residual of contact [N]": (7.0, 6.0)}
    energy = {"terms": {}, "unaccounted": 2.0, "peak": 9.0, "bound": 1.0, "audits": audits}
    one = record("a/a", "T1", 1e-3, ledger=energy)
    told = [troubles._text(some(check=Aspect.CONSERVATION, kind=law, text="", quantity=""), one)
            for law, *_ in breaches(one.ledger)]  # fmt: skip
    assert told == [
        "Energy not accounted for: 2 J, allowed 1 J",
        "Bodies penetrate each other: by 0.25 m, allowed 0.125 m",
        "Contact not converged: residual 7 N, allowed 6 N",
    ]


def test_the_source_is_compared_by_the_first_quantity_in_its_own_norm() -> None:
    errors = {"max": 0.5, "pointwise": 0.25, "final": 0.125}
    other = {name: 9.0 * error for name, error in errors.items()}
    runs = [record("a/a", "T1", 1e-3, quantities=[entry("pass", errors),
                                                  entry("pass", other, name="z")])]  # fmt: skip
    assert case_page._pointwise(runs, 1e-3) == {"a/a": 0.25}


def test_statements_of_papers_are_counted_and_shown_with_who_is_known_here() -> None:
    kinds = [*Assessment, Assessment.DIFFERS]
    answer = Answer("bounce:T1", "2.5", ("a/a", "c/c"))
    rows = [some(assessment=one, answers=(answer,)) for one in kinds]
    book: Any = some(
        beside=some(papers=[(some(name="A"), rows)]), records={("bounce", "T1"): {}},
        marks=marks(["a/a"]), to_case=lambda *names: "-".join(names),
    )  # fmt: skip
    (part,) = papers_page.papers(book)
    assert part.counts == {one: 1 + (one is Assessment.DIFFERS) for one in Assessment}
    assert {row.row.assessment: row.look for row in part.rows} == {
        Assessment.REPRODUCED: "good", Assessment.DIFFERS: "bad", Assessment.MISPRINT: "known",
        Assessment.WRONG: "odd", Assessment.OPEN: "idle",
    }  # fmt: skip
    (given,) = part.rows[0].given
    assert (given.link, given.text) == ("bounce-T1", "2.5")
    assert ([mark.label for mark in given.marks], given.others) == (["a/a"], ["c/c"])

"""Claims about what the papers publish: numbers are as they are said to be, and nothing is lost."""

import math
from pathlib import Path

import pytest

from vv.case.published import Assessment, Paper, Statement
from vv.gate.all_checks import baseline_of
from vv.insight.papers import rows
from vv.output.papers_page import page
from vv.plan.project import find
from vv.plan.published import papers
from vv.records.accepted import AcceptedResult

PROJECT = find(Path(__file__))
PAPERS = papers(PROJECT)
STATEMENTS = [(paper.name, one) for paper in PAPERS for one in paper.statements]
NUMBERS = [
    one for _, one in STATEMENTS if one.number is not None and not isinstance(one.exact, str)
]


BOUNDS = [one for _, one in STATEMENTS if one.printed[:1] in ("<", ">")]
PUBLISHED = "dda/published"  # steps by the paper's own equations


def accepted(case: str) -> dict[str, AcceptedResult]:
    baseline = baseline_of(PROJECT, case)
    return dict(baseline.results) if baseline else {}


@pytest.mark.parametrize("one", NUMBERS, ids=lambda one: f"{one.place} {one.what}")
def test_a_number_is_reproduced_if_it_rounds_to_what_is_printed_and_only_then(
    one: Statement,
) -> None:
    assert one.number is not None
    assert not isinstance(one.exact, str)
    same = math.isclose(one.exact(), one.number, rel_tol=0.0, abs_tol=one.allowance)
    if one.assessment in (Assessment.REPRODUCED, Assessment.MISPRINT, Assessment.DIFFERS):
        assert same == (one.assessment is Assessment.REPRODUCED), (one.exact(), one.number)


@pytest.mark.parametrize(
    "one", [one for one in NUMBERS if one.close is not None], ids=lambda one: one.what
)
def test_a_number_that_is_reproduced_less_closely_is_called_so_by_no_more_than_it_needs(
    one: Statement,
) -> None:
    """By a third more than it is apart, or half a unit of the last digit that is no zero."""
    assert one.number is not None
    assert one.close is not None
    assert not isinstance(one.exact, str)
    digits = one.printed.rstrip("0")
    last = 0.5 * 10.0 ** (len(one.printed) - len(digits)) if "." not in digits else 0.0
    assert one.close <= max(last, 4.0 / 3.0 * abs(one.exact() - one.number))


@pytest.mark.parametrize("one", BOUNDS, ids=lambda one: f"{one.place} {one.what}")
def test_a_bound_is_reproduced_if_the_papers_own_equations_keep_it_and_only_then(
    one: Statement,
) -> None:
    (row,) = rows(Paper("A", "B", "", (one,)), accepted)
    found = [float(answer.text) for answer in row.answers if PUBLISHED in answer.codes]
    if not found:
        assert not isinstance(one.exact, str)
        found = [one.exact()]
    below, limit = one.printed[0] == "<", float(one.printed[1:])
    kept = all((figure < limit) is below for figure in found)
    if one.assessment in (Assessment.REPRODUCED, Assessment.DIFFERS):
        assert kept == (one.assessment is Assessment.REPRODUCED), (found, one.printed)


def test_what_a_statement_points_to_is_there() -> None:
    """Its case, variant and quantity, and once the case is accepted a result to show."""
    for name, one in STATEMENTS:
        for computed in one.computed:
            case = PROJECT.load_case(computed.case)
            trial = case.declare(computed.variant, case.defaults(computed.variant))
            assert computed.quantity in {q.name for q in trial.quantities}, (name, computed)
    shown = [row for paper in PAPERS for row in rows(paper, accepted)]
    for (_, one), row in zip(STATEMENTS, shown, strict=True):
        known = {s.case for s in one.computed if accepted(s.case)}
        assert known <= {answer.where.partition(":")[0] for answer in row.answers}, one.what


def test_more_than_thirty_contradictions_are_told_with_their_reasons() -> None:
    false = [
        one for _, one in STATEMENTS if one.assessment in (Assessment.MISPRINT, Assessment.WRONG)
    ]
    assert len(false) > 30
    assert all(len(one.why) > 10 for one in false)


def test_the_page_in_the_docs_is_what_vv_papers_writes() -> None:
    """After a change that is meant: vv papers --accepted --output docs/papers.md."""
    found = [(paper, rows(paper, accepted)) for paper in PAPERS]
    assert (PROJECT.root / "docs" / "papers.md").read_text() == page(found)


def test_a_statement_that_is_called_wrong_without_a_reason_is_refused() -> None:
    with pytest.raises(ValueError, match=r"Eq\. 1, a: why = ''; what is wrong has a reason"):
        Statement("Eq. 1", "a", "1", Assessment.WRONG)


@pytest.mark.parametrize(
    ("printed", "number", "allowance"),
    [("0.1971", 0.1971, 5e-5), ("-0.0005", -5e-4, 5e-5), ("2.1651e7", 2.1651e7, 500.0),
     ("82", 82.0, 0.5), ("", None, math.inf), ("12.3 mm", 12.3, 0.05), ("0.10", 0.10, 0.005),
     ("~ 2.5", 2.5, 0.05), ("2.40e-3 m", 2.4e-3, 5e-6), ("< 5 %", None, 0.5),
     ("> 5 %", None, 0.5), ("grows", None, math.inf)],
)  # fmt: skip
def test_a_number_is_known_to_half_its_last_place(
    printed: str, number: float | None, allowance: float
) -> None:
    one = Statement("Eq. 1", "a", printed, Assessment.REPRODUCED)
    assert one.number == number
    assert one.allowance == pytest.approx(allowance, rel=1e-3)
    close = Statement("Eq. 1", "a", printed, Assessment.REPRODUCED, close=0.25)
    assert close.allowance == 0.25


def test_papers_are_found_by_their_files() -> None:
    assert [paper.name.split()[0] for paper in PAPERS] == ["Li", "Liu", "Yagoda-Biran"]
    assert all(isinstance(paper, Paper) and paper.citation for paper in PAPERS)

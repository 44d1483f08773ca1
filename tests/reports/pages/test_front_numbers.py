"""Claims about the numbers of the front page: medians, ratios, steps and counts, by hand."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from typing import Any

import pytest

from reports.marks import marks
from reports.outcomes import OUTCOMES
from reports.pages import front as front_page
from reports.pages import overview as numbers
from reports.pages.overview import Cell
from reports.variant.advice import TARGETS
from reports.variant.models import Modelled, models
from reports.variant.reading import TARGET
from tests.support.fabricated import some
from vv.insight.stability_summary import Kind
from vv.records.finding import Aspect, Bit, Finding
from vv.records.outcomes import Outcome

LABELS = ("a/a", "a/b", "b/b")
LOOKS = marks(LABELS)
PASS = OUTCOMES[Outcome.PASS]


def cell(error: float | None, ladder: bool = True) -> Cell:
    return Cell(error, None, PASS, ladder)


def found(label: str, enforced: bool = True, **changes: Any) -> Finding:
    given = {"label": label, "bit": Bit.ACCURACY, "enforced": enforced, **changes}
    return Finding(given.pop("check", Aspect.ACCURACY), given.pop("kind", "off"), "x", **given)


def at_target(cpu: float | None) -> list[float | None]:
    return [cpu if target == TARGET else 99.0 for target in TARGETS]


CELLS = {
    ("c", "1"): {"a/a": cell(1e-3), "a/b": cell(4e-3), "b/b": cell(1e-1)},
    ("c", "2"): {"a/a": cell(3e-3), "b/b": cell(None)},
    ("c", "3"): {"a/a": cell(None), "a/b": cell(2e-3), "b/b": cell(5e-2)},
    ("c", "4"): {"a/a": cell(1e-9), "b/b": cell(1e-9, ladder=False)},
    ("c", "5"): {"a/a": cell(5e-3), "b/b": cell(3e-1)},
}


def test_errors_compare_on_variants_that_each_code_solves_with_one_of_its_schemes() -> None:
    assert numbers._common(CELLS) == [("c", "1"), ("c", "3"), ("c", "5")]
    assert numbers._common({}) == []
    assert numbers._common({("c", "1"): {}}) == []


def row(label: str, findings: Sequence[Finding] = (), ratios: Sequence[float] = ()) -> Any:
    book: Any = some(findings=findings, manifest=some(external=lambda: {"b"}))
    common = numbers._common(CELLS)
    return numbers._row(book, LOOKS[label], CELLS, common, ratios, {"a/a": (0.9, 1.1)})


def test_a_row_has_the_median_over_what_all_solve_and_how_many_it_solves_itself() -> None:
    rows = [row(label) for label in LABELS]
    assert [one.covers for one in rows] == [5, 2, 5]
    assert [one.median for one in rows] == pytest.approx([3e-3, 3e-3, 1e-1])
    assert [one.shared for one in rows] == [2, 2, 3]
    assert [one.in_house for one in rows] == [True, True, False]
    assert [one.step for one in rows] == [(0.9, 1.1), None, None]


def test_a_row_counts_its_own_findings_red_and_reported_only() -> None:
    every = [found("a/a"), found("a/a"), found("a/a", enforced=False), found("b/b"),
             found("a/a", bit=Bit(0)),
             found("a/a", check=Aspect.REGRESSION, kind="better")]  # fmt: skip
    assert (row("a/a", every).red, row("a/a", every).reported) == (2, 1)
    assert (row("b/b", every).red, row("b/b", every).reported) == (1, 0)


def test_how_dear_a_scheme_is_is_the_median_of_ratios_on_a_scale_of_factors() -> None:
    assert row("a/a", ratios=[1.0, 4.0]).dear == pytest.approx(2.0)
    assert row("a/a", ratios=[1.0, 4.0, 100.0]).dear == pytest.approx(4.0)
    assert (row("a/a").dear, row("a/a").reached) == (None, 0)
    assert row("a/a", ratios=[1.0, 4.0]).reached == 2


def test_a_cost_is_over_that_of_the_cheapest_where_a_scheme_gets_there() -> None:
    costs = {
        ("c", "1"): {"a/a": at_target(6.0), "b/b": at_target(2.0)},
        ("c", "2"): {"a/a": at_target(1.0), "b/b": at_target(None)},
        ("c", "3"): {"b/b": at_target(1.0)},
    }
    assert numbers._ratios(costs, "a/a") == [3.0, 1.0]
    assert numbers._ratios(costs, "b/b") == [1.0, 1.0]
    assert numbers._ratios(costs, "a/b") == []


def test_the_profile_is_of_the_variants_that_anybody_solves() -> None:
    costs = {
        ("c", "1"): {"a/a": at_target(6.0), "b/b": at_target(2.0)},
        ("c", "2"): {"a/a": at_target(None), "b/b": at_target(4.0)},
        ("c", "3"): {"a/a": at_target(None)},
    }
    book: Any = some(marks=LOOKS)
    seen: Any = some(costs=costs)
    assert front_page._profile(book, seen, TARGET) == {"a/a": [3.0, math.inf], "b/b": [1.0, 1.0]}
    at = TARGETS.index(TARGET)
    shares = {one.label: row[at] for one, row in front_page._shares(book, seen)}
    assert shares == {"a/a": 0.5, "b/b": 1.0}


def test_stable_steps_have_the_least_and_the_largest_over_theory() -> None:
    told = [("a/a", Kind.STEP, 2.2, 2.0), ("a/a", Kind.STEP, 1.8, 2.0),
            ("a/a", Kind.STEP, 2.0, 2.0), ("b/b", Kind.STEP, None, 2.0),
            ("b/b", Kind.STEP, 2.0, None),
            ("a/b", next(k for k in Kind if k is not Kind.STEP), 5.0, 2.0)]  # fmt: skip
    stability = [some(label=n, kind=k, value=v, due=due) for n, k, v, due in told]
    book: Any = some(stability=stability)
    assert numbers._steps(book) == {"a/a": (0.9, 1.1)}


@pytest.mark.parametrize(("count", "cards", "more"), [(3, 3, 0), (10, 10, 0), (14, 10, 4)])
def test_the_front_page_shows_ten_cards_and_how_many_there_are_besides(
    count: int, cards: int, more: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = made(monkeypatch, count, [found("a/a"), found("a/a", enforced=False)])
    assert (len(seen.cards), seen.more) == (cards, more)


def test_the_front_page_counts_what_is_reported_only_and_is_red_by_what_is_enforced(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    quiet = [found("a/a", enforced=False), found("b/b", enforced=False), found("a/a", bit=Bit(0)),
             found("a/a", False, check=Aspect.REGRESSION, kind="better")]  # fmt: skip
    one = made(monkeypatch, 0, quiet)
    assert (one.red, one.reported) == (False, 2)
    both = made(monkeypatch, 0, [*quiet, found("a/a")])
    assert (both.red, both.reported) == (True, 2)
    assert both.codes == {"a": True, "b": False}
    assert both.known == 3


def made(monkeypatch: pytest.MonkeyPatch, troubles: int, findings: list[Finding]) -> Any:
    """The front page of a book with this many troubles, and four outcomes, three of them known."""
    seen = some(costs={}, cells={}, guessed=False)
    monkeypatch.setattr(front_page, "overview", lambda book: seen)
    monkeypatch.setattr(front_page, "troubles", lambda book: [some()] * troubles)
    known = [(None, OUTCOMES[Outcome.XFAIL])] * 3 + [(None, PASS)]
    book: Any = some(
        manifest=some(external=lambda: {"b"}), marks=LOOKS, shown=known, findings=findings,
        beside=some(papers=[]),
    )  # fmt: skip
    monkeypatch.setattr(front_page, "coverage_map", some(rows=lambda *_: ""))
    return front_page.front(book)


def test_the_page_s_script_has_costs_of_three_digits_and_no_scheme_that_reaches_nothing() -> None:
    none = [None] * len(TARGETS)
    costs = {("c", "1"): {"a/a": [1.23456e-3, *none[1:]], "b/b": none}}
    cells = {("c", "1"): {"a/a": cell(1.23456e-3), "b/b": cell(1.0, ladder=False)}}
    book: Any = some(marks=LOOKS)
    told = json.loads(front_page._data(book, some(cells=cells, costs=costs, guessed=True)))
    assert told["costs"] == {"c:1": {"a/a": [1.23e-3, *none[1:]]}}
    assert told["errors"] == {"a/a": [1.23e-3], "a/b": [None], "b/b": [None]}
    assert told["guessed"] is True


def modelled(label: str, note: str, unknowns: int = 1, balance: str = "") -> Any:
    return some(mark=LOOKS[label], model=some(note=note, unknowns=unknowns), balance=balance)


def test_a_balance_names_its_scheme_where_there_are_several() -> None:
    one, other = (modelled(n, "x", balance=f"off {n}") for n in ("a/a", "a/b"))
    silent = modelled("b/b", "x")
    assert Modelled("x", [one]).energy == "off a/a"
    assert Modelled("x", [one, other]).energy == "a/a off a/a; a/b off a/b"
    assert Modelled("x", [one, silent]).energy == "a/a off a/a"
    assert Modelled("x", [silent]).energy == ""
    assert (Modelled("x", [one, other]).who, Modelled("x", [], "a").who) == (
        "a/a, a/b", "a, all schemes"
    )  # fmt: skip


LONG = "a sphere is a ball of so many kilograms; a wall is a plane that nothing can move"


def test_a_model_that_stands_above_is_told_by_its_difference_where_that_is_shorter() -> None:
    above: dict[tuple[str, ...], tuple[str, str]] = {}
    (first,) = models([modelled("a/a", LONG)], "T1", above)
    assert (first.note, first.like) == (f"{LONG}; unknowns: 1", "")
    (same,) = models([modelled("a/a", LONG)], "T2", above)
    assert (same.note, same.like) == ("", "T1")
    (other,) = models([modelled("a/a", LONG, 2)], "T3", above)
    assert (other.note, other.like) == ("unknowns: 2", "T1")
    (less,) = models([modelled("a/a", LONG.partition("; ")[0])], "T4", above)
    assert (less.note, less.like) == (f"{LONG.partition('; ')[0]}; unknowns: 1", "")
    (unlike,) = models([modelled("a/a", "nothing of that")], "T5", above)
    assert unlike.like == ""
    (fresh,) = models([modelled("a/b", LONG)], "T6", above)
    assert fresh.like == ""
    assert models([some(mark=LOOKS["a/a"], model=None)], "T7", above) == []

"""Claims about the common source of all pages: quiet outcomes, order of records, and links."""

from __future__ import annotations

from typing import Any

import pytest

from reports.book import Book
from reports.variant.likeness import difference, nearest
from tests.support.fabricated import case, changed, entry, manifest, record
from vv.records.finding import Aspect, Bit, Finding


def book(*records: Any, **parts: Any) -> Book:
    whole = manifest(*records, **{"cases": {"bounce": case()}, **parts})
    return Book(whole, lambda key: {}, {})


def test_records_stand_by_variant_and_scheme_coarsest_first_and_what_was_taken_on_alone() -> None:
    none = record("a/a", "T2", 1e-3, status="refused", reason="no")
    made = book(record("b/b", "T1", 1e-3), none, record("a/a", "T1", 1e-3),
                record("a/a", "T1", 2e-3))  # fmt: skip
    told = {
        place: {label: [r.rung.dt for r in pile] for label, pile in piles.items()}
        for place, piles in made.records.items()
    }
    assert told == {
        ("bounce", "T1"): {"a/a": [2e-3, 1e-3], "b/b": [1e-3]}, ("bounce", "T2"): {"a/a": [1e-3]}
    }  # fmt: skip
    assert [*made.records[("bounce", "T1")]] == ["a/a", "b/b"]
    assert made.ran[("bounce", "T2")] == {}
    assert made.ran[("bounce", "T1")].keys() == {"a/a", "b/b"}
    assert made.places == [("bounce", "T1"), ("bounce", "T2")]
    assert len(made.of_case["bounce"]) == 4


def found(enforced: bool, **where: Any) -> Finding:
    return Finding(Aspect.ACCURACY, "off", "x", bit=Bit.ACCURACY, enforced=enforced, **where)


@pytest.mark.parametrize(
    ("place", "quiet"),
    [
        (("c", "v", "a/a"), False),
        (("c", "v", "a/"), False),
        (("c", "v", ""), False),
        (("c", "", "a/a"), False),
        (("", "", ""), False),
        (("", "v", "a/"), False),
        (("c", "v", "a/b"), True),
        (("c", "w", "a/a"), True),
        (("d", "v", "a/a"), True),
        (("c", "v", "b/"), True),
    ],
)
def test_a_place_is_quiet_unless_something_of_it_turns_the_gate_red(
    place: tuple[str, str, str], quiet: bool
) -> None:
    made = book()
    vars(made)["findings"] = [
        found(True, case="c", variant="v", label="a/a"),
        found(False, case="d", variant="v", label="a/a"),
    ]
    assert made.quiet(*place) is quiet


def test_links_lead_to_pages_or_within_the_one_file() -> None:
    apart, whole = book(), Book(book().manifest, lambda key: {}, {}, whole=True)
    assert apart.to_case("c", "v") == "case-c.html#c--v"
    assert whole.to_case("c", "v") == "#c--v"
    assert apart.to_code("a/b") == "code-a.html"
    assert whole.to_code("a/b") == "#code-a"
    assert whole.to("front.html", "x") == "#x"


@pytest.mark.parametrize(
    ("measured", "told"), [((True, False), True), ((False, True), True), ((False, False), False)]
)
def test_measurements_are_told_of_where_something_was_compared_with_one(
    measured: tuple[bool, ...], told: bool
) -> None:
    seen = {
        "value": 1.0,
        "digitisation": 0.1,
        "experiment": 0.0,
        "conditions": "",
        "source": "x",
        "band": 0.5,
    }
    records = [record("a/a", "T1", dt, quantities=[entry("pass", {})]) for dt in (1e-3, 2e-3)]
    made = book(*(_measured(one, seen) if has else one
                  for one, has in zip(records, measured, strict=True)))  # fmt: skip
    assert made.has_measurements is told


def _measured(one: Any, seen: dict[str, Any]) -> Any:
    return changed(one, quantities=[
        changed(quantity, judge="measured", measurement=seen) for quantity in one.quantities
    ])  # fmt: skip


LONG = "".join(f"a line that both texts have, number {n}\n" for n in range(20))


@pytest.mark.parametrize(
    ("base", "text", "shorter"),
    [
        (LONG, LONG + "more\n", True),
        (LONG, LONG, False),
        (LONG[:-1], LONG + "more\n", False),
        (LONG, LONG + "more", False),
        (LONG, "another text\n" * 9, False),
    ],
)
def test_a_text_is_told_by_a_difference_if_that_is_shorter_and_both_end_a_line(
    base: str, text: str, shorter: bool
) -> None:
    told = difference(base, text)
    assert told == ("@@ -20,0 +21 @@\n+more\n" if shorter else "")


def test_the_nearest_text_has_most_lines_in_common_the_first_of_several() -> None:
    assert nearest(["a\nx\n", "a\nb\n", "b\na\n"], "b\na\nc\n") == 1

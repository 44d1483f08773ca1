"""Claims that what cases declare, and measure of runs by formula, is what was recorded."""

from __future__ import annotations

import json

import pytest

from tests.cases.declarations import LARGE, RECORD, Row, declared
from vv.plan.project import find

PROJECT = find()
ROWS: dict[str, Row | str] = json.loads(RECORD.read_text())
ANEW = "if it is meant: python -m tests.cases.declarations"


@pytest.mark.parametrize("name", PROJECT.case_names())
def test_a_case_declares_and_measures_what_was_recorded(name: str) -> None:
    case = PROJECT.load_case(name)
    kept = {variant: row for variant, row in ROWS.items() if variant.startswith(f"{name}:")}
    assert kept.keys() == {f"{name}:{one.name}" for one in case.variants}, ANEW
    for one in case.variants:
        row = kept[f"{name}:{one.name}"]
        if not isinstance(row, str):
            found = declared(case, one)
            assert not isinstance(found, str), f"{one.name} is {LARGE}; {ANEW}"
            lost = [what for what in row.keys() | found.keys() if not same(what, row, found)]
            assert not lost, f"{one.name}: {sorted(lost)}; {ANEW}"


def same(what: str, kept: Row, found: Row) -> bool:
    """Whether two texts are equal but for the last digits of numbers."""
    if what not in kept or what not in found:
        return False
    if kept[what] == found[what] or what.startswith("draw "):
        return kept[what] == found[what]
    return _near(kept[what].split(", "), found[what].split(", "))


def _near(first: list[str], second: list[str]) -> bool:
    try:
        values = [float(one) for one in second]
        return [float(one) for one in first] == pytest.approx(
            values, rel=1e-4, abs=1e-9, nan_ok=True
        )
    except ValueError:
        return False


@pytest.mark.parametrize(
    ("kept", "found", "equal"),
    [("1, 2", "1, 2.0001", True), ("1, 2", "1, 2.01", False), ("1, 2", "1", False),
     ("refused", "1a2b3c4d", False), ("nan", "nan", True), ("nan", "1", False)],
)  # fmt: skip
def test_a_record_allows_for_the_last_digits_of_numbers_only(
    kept: str, found: str, equal: bool
) -> None:
    assert same("s", {"s": kept}, {"s": found}) is equal
    assert same("draw 0", {"draw 0": kept}, {"draw 0": found}) is (kept == found)
    assert not same("s", {"s": kept}, {})

"""Entries of the ledger are asked by code and case, by patterns of both."""

from types import SimpleNamespace
from typing import Any

import pytest

from vv.gate.expiry import by_code_and_case


@pytest.mark.parametrize(
    ("code", "case", "found"),
    [
        ("dem", "bounce", ["both", "any case", "any code"]),
        ("dem", "fall", ["any case"]),
        ("dda", "bounce", ["any code"]),
        ("dda", "fall", []),
    ],
)
def test_an_entry_speaks_of_what_both_its_patterns_match(
    code: str, case: str, found: list[str]
) -> None:
    rows = (("both", "dem", "bounce"), ("any case", "dem", "*"), ("any code", "*", "boun*"))
    entries: Any = [SimpleNamespace(name=name, code=a, case=b) for name, a, b in rows]
    of = by_code_and_case(entries)
    for _ in range(2):
        assert [one.name for one in of(code, case)] == found

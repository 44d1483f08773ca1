"""Claims about selecting by words and operators."""

from __future__ import annotations

import re

import pytest

from vv.base.errors import UsageError
from vv.plan.expression import matcher

NAME = "contact single-contact:T3-rotated yade/half-step-mass"


@pytest.mark.parametrize(
    ("text", "fits"),
    [
        ("T3", True),
        ("t3", True),
        ("T4", False),
        ("T3 and yade", True),
        ("T3 and not rotated", False),
        ("T4 or half-step", True),
        ("not (T4 or dem)", True),
        ("not T3 or yade", True),  # `not` binds first
        ("T4 and dem or yade", True),  # then `and`
        ("((T3))", True),
    ],
)
def test_words_fit_names_that_hold_them(text: str, fits: bool) -> None:
    assert matcher(text)(NAME) is fits


@pytest.mark.parametrize("text", ["", "T3 and", "or T3", "(T3", "T3)", "T3 T4", "not", "T3 and ()"])
def test_what_cannot_be_read_is_refused_with_an_example(text: str) -> None:
    with pytest.raises(UsageError, match="an example: T3 and not"):
        matcher(text)


@pytest.mark.parametrize(
    ("text", "at"),
    [("or T3", "'or'"), ("(T3 T4", "'T4'"), ("T3)", "')'"), ("(T3", "end"), ("not", "end")],
)
def test_what_cannot_be_read_is_named(text: str, at: str) -> None:
    with pytest.raises(UsageError, match=re.escape(f": unexpected {at}")):
        matcher(text)


def test_an_expression_of_thousands_of_brackets_is_refused() -> None:
    with pytest.raises(UsageError, match="at most 1000"):
        matcher("(" * 5000)

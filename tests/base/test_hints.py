"""Claims about hints: what is similar is offered, else all that is known."""

import pytest

from vv.base.hints import name_hint

KNOWN = ("folder", "Newmark-30", "drop")


@pytest.mark.parametrize(
    ("typed", "hint"),
    [
        ("foldre", "; did you mean folder?"),
        ("newmark", "; did you mean Newmark-30?"),
        ("fold", "; did you mean folder?"),
        ("FOLDER", "; did you mean folder?"),  # as few letters in common as case allows
        ("bounce", "; known: Newmark-30, drop, folder"),
    ],
)
def test_similar_names_are_offered_else_all(typed: str, hint: str) -> None:
    assert name_hint(typed, KNOWN) == hint


def test_the_two_most_similar_names_are_offered() -> None:
    known = ("wall-contact", "ball-contact", "drag")
    assert name_hint("all-contact", known) == "; did you mean wall-contact or ball-contact?"


def test_where_nothing_is_known_that_is_said() -> None:
    assert name_hint("bounce", ()) == "; there is none"

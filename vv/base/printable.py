"""Makes texts of unknown origin safe to print: control characters are shown, not executed.

The output of a program may contain sequences that control a terminal, that end a line and forge the
next one, or that XML forbids. Everything that prints or writes such texts uses this module.
"""

from __future__ import annotations

import re

OBEYED = re.compile(  # controls, marks of direction, halves of pairs, and what is no character
    "[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff"
    "\ufeff\ufffe\uffff]"
)
LINE_ENDS = re.compile("[ \t]*[\r\n\v\f\x1c-\x1e\x85\u2028\u2029][\\s\x1c-\x1e]*")


def printable(text: str) -> str:
    """The text with control characters written as Python escapes, such as \x1b.

    Tabs and line breaks stay.
    """
    return text if text.isascii() and text.isprintable() else OBEYED.sub(_written, text)


def one_line(text: str) -> str:
    """As `printable`, in one line: line breaks and the blanks around them become one blank."""
    if text.isascii() and text.isprintable():
        return text
    return printable(LINE_ENDS.sub(" ", text).replace("\t", " "))


def _written(character: re.Match[str]) -> str:
    return character[0].encode("unicode_escape").decode()

"""Says whether a drawing that was kept in a store is one: shapes and text, and nothing that acts.

It is put into a page as it is, so it may hold only the elements and attributes that our figures
are made of; no script, no link but to itself or its own pixels, no style that reaches out.
"""

from __future__ import annotations

import re
from xml.parsers import expat

ELEMENTS = frozenset(
    (
        "svg",
        "g",
        "path",
        "use",
        "defs",
        "clipPath",
        "rect",
        "text",
        "tspan",
        "style",
        "polygon",
        "image",
    )
)
ATTRIBUTES = frozenset(
    (
        "xmlns", "viewBox", "aria-hidden", "focusable", "id", "d", "x", "y", "width", "height",
        "transform", "style", "clip-path", "href", "points", "type", "fill", "stroke", "class",
    )
)  # fmt: skip
SHEET = re.compile(r"\s*(\*\{stroke-linejoin: round; stroke-linecap: butt\})?\s*")
REFERENCE = re.compile(r"#[\w.-]+|data:image/png;base64,[\w+/=\s]*")  # itself, or its pixels
REACHING = re.compile(r"url\((?!#[\w.-]+\))|[\\@<]|expression|javascript|/\*|position", re.I)


def is_drawing(text: str) -> bool:
    """Whether a text is one <svg> element that holds nothing but a drawing."""
    if "<!" in text or "<?" in text:  # no entities, comments or sections: none is ours
        return False
    parser, seen = expat.ParserCreate(), _Seen()
    parser.StartElementHandler, parser.EndElementHandler = seen.start, seen.end
    parser.CharacterDataHandler = seen.said
    try:
        parser.Parse(text, True)
    except (expat.ExpatError, ValueError):
        return False
    return seen.harmless


class _Seen:
    """What has been met of a drawing."""

    def __init__(self) -> None:
        self.harmless = True
        self.first = True
        self.sheet: list[str] | None = None

    def start(self, name: str, attributes: dict[str, str]) -> None:
        """An element begins."""
        known = name in ELEMENTS and not (attributes.keys() - ATTRIBUTES) and self.sheet is None
        if not known or (self.first and name != "svg") or _reaches(attributes):
            self.harmless = False
        self.first = False
        self.sheet = [] if name == "style" else None

    def end(self, name: str) -> None:
        """An element ends; a style sheet is that of every figure."""
        if self.sheet is not None and not SHEET.fullmatch("".join(self.sheet)):
            self.harmless = False
        self.sheet = None

    def said(self, text: str) -> None:
        """A text within an element."""
        if self.sheet is not None:
            self.sheet.append(text)


def _reaches(attributes: dict[str, str]) -> bool:
    """Whether an attribute points outside the drawing."""
    link = attributes.get("href")
    if link is not None and not REFERENCE.fullmatch(link):
        return True
    return any(REACHING.search(text) for name, text in attributes.items() if name != "href")

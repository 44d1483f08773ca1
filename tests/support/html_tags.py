"""Parses a page for tests: its tags, their attributes, the texts of links."""

from __future__ import annotations

from collections.abc import Iterator
from html.parser import HTMLParser

VOID = {"meta", "link", "img", "br", "hr", "input"}
ENDS = {"td": {"td", "th"}, "th": {"td", "th"}, "tr": {"td", "th", "tr"}}  # end tags left out
ENDS["tbody"] = ENDS["tr"] | {"tbody"}


class Tags(HTMLParser):
    """Collects (tag, attributes), and the text of each row by its id; fails on unbalanced tags."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.open: list[str] = []
        self.rows: dict[str, str] = {}
        self.row = ""
        self.feed(page)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self._let_go(ENDS.get(tag, set()))
        named = dict(attrs)
        self.tags.append((tag, named))
        if tag not in VOID:
            self.open.append(tag)
        self.row = (named.get("id") or "") if tag == "tr" else self.row

    def handle_endtag(self, tag: str) -> None:
        if tag in ("tr", "tbody", "table"):
            self._let_go(ENDS["tbody"] - {tag})
        assert self.open.pop() == tag, (tag, self.getpos())
        self.row = "" if tag == "tr" else self.row

    def _let_go(self, ended: set[str]) -> None:
        """Close what ends without an end tag."""
        while self.open and self.open[-1] in ended:
            self.open.pop()

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        if self.row:
            self.rows[self.row] = f"{self.rows.get(self.row, '')} {data.strip()}"

    def all(self, name: str) -> Iterator[str]:
        return (named[name] or "" for _, named in self.tags if name in named)

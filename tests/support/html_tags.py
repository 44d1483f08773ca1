"""Reads a page as tests need it: its tags, their attributes, the texts of the matrix."""

from __future__ import annotations

from collections.abc import Iterator
from html.parser import HTMLParser

VOID = {"meta", "link", "img", "br", "hr", "input"}


class Tags(HTMLParser):
    """Collects (tag, attributes) and the texts of matrix cells; fails on unbalanced tags."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.open: list[str] = []
        self.cells: dict[str, str] = {}
        self.cell, self.matrix = "", False
        self.feed(page)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        named = dict(attrs)
        self.tags.append((tag, named))
        if tag not in VOID:
            self.open.append(tag)
        self.matrix = named.get("class") == "matrix" if tag == "table" else self.matrix
        if tag == "a" and "td" in self.open and self.matrix:
            self.cell = (named.get("href") or "").removeprefix("#")

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag, (tag, self.getpos())
        self.cell = "" if tag == "a" else self.cell

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        if self.cell:
            self.cells[self.cell] = f"{self.cells.get(self.cell, '')} {data.strip()}"

    def all(self, name: str) -> Iterator[str]:
        return (named[name] or "" for _, named in self.tags if name in named)

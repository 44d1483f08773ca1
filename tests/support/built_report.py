"""Builds the report of a fabricated manifest, and hands over its files."""

from __future__ import annotations

from reports import html
from vv.records.manifest import Manifest
from vv.store.store import Store

CASE = "case-bounce.html"


def pages(manifest: Manifest, store: Store) -> dict[str, str]:
    """Every file of the report, by name."""
    folder = store.root / "report"
    assert html.build(manifest, store, folder) == folder / "index.html"
    return {path.name: path.read_text(encoding="utf-8") for path in sorted(folder.iterdir())}


def built(manifest: Manifest, store: Store) -> str:
    """The page of the case."""
    return pages(manifest, store)[CASE]

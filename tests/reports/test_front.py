"""Claims about the front page: costs without timings, and known disagreements."""

from __future__ import annotations

import dataclasses
import re

import pytest

from tests.support.built_report import pages
from tests.support.fabricated import changed, cost
from vv.records.manifest import Manifest
from vv.store.store import Store


def untimed(whole: Manifest) -> Manifest:
    """The manifest without any cost that was timed alone."""
    records = (changed(one, cost=cost()) for one in whole.records)
    return dataclasses.replace(whole, records=tuple(records))


def dear(page: str, label: str) -> str:
    """The text in the column of costs of a scheme."""
    row = re.search(f'<tr data-k="{label}">.*?</tr>', page, re.DOTALL)
    assert row
    cell = re.search(r'class="n dear"[^>]*>([^<]*)', row[0])
    assert cell
    return cell[1].strip()


def test_costs_that_nobody_timed_are_shown_as_such(manifest: Manifest, store: Store) -> None:
    page = pages(untimed(manifest), store)["index.html"]
    assert dear(page, "dem/default").startswith("~")
    assert "no variant was timed alone" in page


def test_timed_costs_are_not_marked(manifest: Manifest, store: Store) -> None:
    page = pages(manifest, store)["index.html"]
    assert re.match(r"\d", dear(page, "dem/default"))
    assert "no variant was timed alone" not in page


@pytest.mark.parametrize(("count", "words"), [(6, "6 known disagreements</a>"), (0, "")])
def test_known_disagreements_are_counted_and_linked(
    manifest: Manifest, store: Store, count: int, words: str
) -> None:
    kept = [one for one in manifest.records if count or one.label != "dem/published"]
    page = pages(dataclasses.replace(manifest, records=tuple(kept)), store)["index.html"]
    assert ("#look-known" in page.partition("What needs attention")[2]) is bool(words)
    assert words in page


def test_what_is_printed_is_on_paper_whatever_the_theme(manifest: Manifest, store: Store) -> None:
    style = pages(manifest, store)["report.css"]
    outside = re.sub(r"@media screen[^{]*\{(?:[^{}]*\{[^{}]*\})*[^{}]*\}", "", style)
    assert "data-theme=dark" in style
    assert "data-theme=dark" not in outside

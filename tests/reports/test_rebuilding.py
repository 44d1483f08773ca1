"""Claims about when pages are made: once for the same results, and again after any change."""

from __future__ import annotations

import dataclasses
import json
import os
import shutil

import pytest

from reports import html
from tests.support.built_report import CASE, built, pages
from tests.support.fabricated import case, requantified
from vv.records.manifest import Manifest
from vv.store.store import Store


def test_the_same_results_are_not_rendered_again(manifest: Manifest, store: Store) -> None:
    first = pages(manifest, store)
    folder = store.root / "report"
    for path in folder.iterdir():
        os.utime(path, ns=(1, 1))
    later = dataclasses.replace(manifest.provenance, utc="2026-01-01T00:00:00+00:00")
    assert pages(dataclasses.replace(manifest, name="20260101", provenance=later), store) == first
    assert {path.stat().st_mtime_ns for path in folder.iterdir()} == {1}


def test_a_changed_case_has_its_page_and_the_common_ones_made_again(
    manifest: Manifest, store: Store
) -> None:
    two = dataclasses.replace(manifest, cases={**manifest.cases, "other": case()})
    pages(two, store)
    folder = store.root / "report"
    for path in folder.iterdir():
        os.utime(path, ns=(1, 1))
    first, *others = manifest.records
    worse = (requantified(first, verdict="fail"), *others)
    pages(dataclasses.replace(two, records=worse), store)
    kept = {path.name for path in folder.iterdir() if path.stat().st_mtime_ns == 1}
    looks = {"report.css", "report.js", "uplot.js"}
    assert kept == {"case-other.html", "case-other.csv", "inputs.js", *looks}


def test_pages_of_what_is_no_longer_there_go(manifest: Manifest, store: Store) -> None:
    two = dataclasses.replace(manifest, cases={**manifest.cases, "other": case()})
    assert "case-other.html" in pages(two, store)
    (store.root / "report" / "notes.txt").write_text("somebody's own")
    left = pages(manifest, store)
    assert "case-other.html" not in left
    assert "notes.txt" in left


def test_a_page_that_was_touched_is_made_again(manifest: Manifest, store: Store) -> None:
    page = built(manifest, store)
    (store.root / "report" / CASE).write_bytes(b"\xff\xfe <script>alert(1)</script>")
    assert built(manifest, store) == page
    (store.root / "report" / "stamps.json").write_text("[")
    assert built(manifest, store) == page


def test_same_results_give_the_same_bytes(manifest: Manifest, store: Store) -> None:
    first = pages(manifest, store)
    shutil.rmtree(store.root / "report")
    assert pages(manifest, store) == first


def test_missing_series_leave_tables_and_ladders(manifest: Manifest, store: Store) -> None:
    assert "Relative error of y over time" in built(manifest, store)
    shutil.rmtree(store.root / "records")
    shutil.rmtree(store.root / "report")
    page = built(manifest, store)
    assert "not in the store" in page
    assert "Error of y against step" in page
    assert "Relative error of y over time" not in page


def test_stored_records_are_told_apart_case_by_case(manifest: Manifest, store: Store) -> None:
    first, *others = manifest.records
    worse = (requantified(first, verdict="fail"), *others)
    two = {**manifest.cases, "other": case()}
    more = tuple(dataclasses.replace(one, case="other") for one in others)
    for name, own in (("1", manifest.records), ("2", worse)):
        store.manifests.keep(
            dataclasses.replace(manifest, name=name, cases=two, records=(*own, *more))
        )
    before, now = store.manifests.digests_of("1"), store.manifests.digests_of("2")
    assert before.keys() == now.keys() == two.keys()
    assert before["bounce"] != now["bounce"]
    assert before["other"] == now["other"]
    assert store.manifests.digests_of("3") == {}


def test_a_report_that_several_processes_write_is_that_of_one(
    manifest: Manifest, store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    def made(processes: int) -> dict[str, bytes]:
        monkeypatch.setattr("os.sched_getaffinity", lambda pid: range(processes))
        folder = store.root / f"by-{processes}"
        html.build(manifest, store, folder)
        return {path.name: path.read_bytes() for path in folder.iterdir()}

    monkeypatch.setattr("vv.base.parallel.ALONE", -1.0)
    one, several = made(1), made(3)
    assert one == several
    assert one.keys() - {"stamps.json"} == json.loads(one["stamps.json"]).keys()

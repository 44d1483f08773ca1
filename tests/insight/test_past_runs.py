"""Claims about what past runs say: it is read once, and is the same the second time."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from unittest import mock

import pytest

from tests.support.fabricated import (
    NOWHERE,
    changed,
    entry,
    manifest,
    manifest_of_all,
    record,
    requantified,
)
from vv.case import Norm
from vv.insight import history as past
from vv.insight.history import history
from vv.insight.past_runs import PastRuns, digest_of
from vv.records.job_record import Record
from vv.records.manifest import Manifest, Provenance
from vv.store.manifests import Manifests
from vv.store.store import Store


def test_a_past_run_is_read_once_and_says_the_same_later(tmp_path: Path) -> None:
    store = Store(tmp_path / ".vv")
    whole = manifest_of_all(store)
    store.manifests.keep(whole)
    first = history(store, "bounce", print)
    assert first[0].closeness
    assert first[0].outcomes
    with mock.patch.object(Manifests, "reader", side_effect=AssertionError("read again")):
        assert history(store, "bounce", print) == first
    store.manifests.keep(dataclasses.replace(whole, name=f"{whole.name}.1", records=()))
    assert history(store, "bounce", print) == first


def test_runs_that_hold_the_same_records_are_read_once(tmp_path: Path) -> None:
    store = Store(tmp_path / ".vv")
    whole = manifest_of_all(store)
    store.manifests.keep(whole)
    first = history(store, "bounce", print)
    again = dataclasses.replace(whole, name=f"{whole.name}.1")
    store.manifests.keep(dataclasses.replace(again, provenance=elsewhere(again)))
    with mock.patch.object(Manifests, "reader", side_effect=AssertionError("read again")):
        both = history(store, "bounce", print)
    assert [point.closeness for point in both] == [first[0].closeness] * 2


def test_what_a_history_came_to_is_kept_until_a_run_holds_something_new(tmp_path: Path) -> None:
    store = Store(tmp_path / ".vv")
    whole = manifest_of_all(store)
    store.manifests.keep(whole)
    first = history(store, "bounce", print)
    later = dataclasses.replace(whole.provenance, utc="2026-01-02T00:00:00+00:00")
    store.manifests.keep(dataclasses.replace(whole, name=f"{whole.name}.1", provenance=later))
    with mock.patch.object(PastRuns, "digest", side_effect=AssertionError("worked out again")):
        again = history(store, "bounce", print)
    assert again == [dataclasses.replace(first[0], utc=later.utc)]
    worse = requantified(whole.records[0], verdict="fail", errors={Norm.MAX: 0.5}, norm=None)
    other = dataclasses.replace(whole, name=f"{whole.name}.2", records=(worse,))
    store.manifests.keep(other)
    assert history(store, "bounce", print) != again


def test_runs_have_a_key_only_where_each_of_them_is_stored_and_one_of_its_own(
    tmp_path: Path,
) -> None:
    past = PastRuns(Store(tmp_path / ".vv"), {}, print)
    past.held.update(a={"c": "1"}, b={"c": "2"}, lost={}, other={"d": "1"})
    both = past.key_of(["a", "b"], "c")
    assert both
    assert both != past.key_of(["b", "a"], "c") != past.key_of(["a"], "c")
    for names in ([], ["lost"], ["a", "lost"], ["lost", "a"], ["a", "other"]):
        assert past.key_of(names, "c") == ""


def elsewhere(manifest: Manifest) -> Provenance:
    return dataclasses.replace(manifest.provenance, commit="another")


@pytest.mark.parametrize(
    ("damaged", "stored", "kept"),
    [(False, "abc", True), (True, "abc", False), (False, "", False), (True, "", False)],
)
def test_figures_are_stored_of_records_that_are_stored_and_can_be_read(
    damaged: bool, stored: str, kept: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    known: list[object] = []
    store: Any = SimpleNamespace(
        facts=lambda kind, key: None, keep_facts=lambda key, what: known.append(what)
    )
    runs = PastRuns(store, {}, print, held={"run": {"bounce": stored}})
    monkeypatch.setattr(PastRuns, "_records", lambda self, name, case: None if damaged else ())
    assert runs.digest("run", "bounce") == digest_of(())
    assert known == [digest_of(())] * kept


def test_figures_of_unlike_variants_settings_and_quantities_are_kept_apart() -> None:
    def one(variant: str, dt: float, errors: tuple[float, float], cost: list[float]) -> Record:
        quantities = [entry("pass", {"max": error}, name=name, tolerance=1e-2)
                      for name, error in zip("pq", errors, strict=True)]  # fmt: skip
        made = record("a/x", variant, dt, quantities=quantities)
        return changed(made, cost=changed(made.cost, relative=cost))

    told = digest_of([
        one("T1", 2e-3, (1e-3, 2e-3), [2.0, 8.0]), one("T1", 1e-3, (3e-3, 4e-3), [3.0, 12.0]),
        one("T2", 1e-3, (5e-3, 6e-3), [4.0, 16.0]),
    ])  # fmt: skip
    places = [(v, dt, q) for v, dt in (("T1", "0.002"), ("T1", "0.001"), ("T2", "0.001"))
              for q in "pq"]  # fmt: skip
    near = zip(places, (0.1, 0.2, 0.3, 0.4, 0.5, 0.6), strict=True)
    assert told.closeness == {
        "a/x": {f"{v}\ndt={dt}\n{q}": pytest.approx(share) for (v, dt, q), share in near}
    }
    assert told.cost == {
        "a/x": {f"{v}\ndt={dt}\ncost": pytest.approx(share)
                for v, dt, share in (("T1", "0.002", 4.0), ("T1", "0.001", 6.0),
                                     ("T2", "0.001", 8.0))}
    }  # fmt: skip


def test_a_history_that_was_kept_stands_beside_its_own_commits(tmp_path: Path) -> None:
    store = Store(tmp_path / ".vv")
    for day, error in (("1", 1e-3), ("2", 3e-3)):
        judged = [entry("pass", {"max": error}, tolerance=1e-2)]
        made = dataclasses.replace(NOWHERE, utc=f"day {day}", commit=day * 9, dirty=False)
        store.manifests.keep(manifest(record("a/x", "T1", 1e-3, quantities=judged),
                                      provenance=made, name=f"2025010{day}"))  # fmt: skip
    for _ in ("computed", "kept"):
        told = history(store, "bounce", print)
        assert [(p.utc, p.name) for p in told] == [("day 1", "1" * 9), ("day 2", "2" * 9)]
        assert [p.closeness["a/x"] for p in told] == pytest.approx([0.1, 0.3])


def test_a_history_ends_where_a_commit_more_than_it_shows_begins(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Runs at two commits are shown; what lies before the first run at a third is not looked at."""
    monkeypatch.setattr(past, "COMMITS", 2)
    names = ["0a", "1c", "2a", "3b", "4b", "5a"]  # each with its commit, oldest first
    runs: Any = SimpleNamespace(
        head=lambda name: ({"bounce"}, SimpleNamespace(commit=name[1], dirty=False)),
        key_of=lambda names, case: names[0],
    )
    store: Any = SimpleNamespace(manifests=SimpleNamespace(names=lambda: names))
    found = past._last_runs(store, runs, ["bounce"])["bounce"]
    assert {at: [name for name, _ in kept] for at, kept in found.items()} == {
        ("a", False): ["5a", "2a"], ("b", False): ["4b", "3b"]
    }  # fmt: skip

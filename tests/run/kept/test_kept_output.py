"""What was printed is printed again only where it is of the same manifest, report and commit."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests.support.fabricated import NOWHERE, changed, manifest, ran, record
from vv.records.manifest import PrintedOutput
from vv.run import reuse
from vv.store.store import Store

COMMIT = (NOWHERE.commit, NOWHERE.dirty)


class Kept:
    """A store with the output of one invocation, and the files of its report."""

    def __init__(self, root: Path, patched: pytest.MonkeyPatch) -> None:
        self.store, self.report = Store(root / ".vv"), root / "report"
        self.report.mkdir()
        (self.report / "index.html").write_text("page")
        self.made = manifest(record("a/a", "T1", 1e-3), name="run")
        self.store.manifests.keep(self.made)
        self.commit, self.project = COMMIT, Any
        patched.setattr(reuse, "commit", lambda root: self.commit)
        reuse.remember(self.store, "same", self.made)
        self.keep("run")

    def keep(self, name: str, identity: str = "same") -> None:
        of = reuse.output_key(self.store, name, self.report, ("a",))
        reuse.keep_output(self.store, identity, name, PrintedOutput((), ("told",), 0, of))

    def again(self, required: tuple[str, ...] = ("a",), identity: str = "same") -> bool:
        project: Any = type("Project", (), {"root": Path()})
        return reuse.output_of(project, self.store, identity, self.report, required) is not None


@pytest.fixture
def kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Kept:
    return Kept(tmp_path, monkeypatch)


def test_it_is_told_again_while_all_is_the_same(kept: Kept) -> None:
    assert kept.again()
    assert not kept.again(identity="other")


@pytest.mark.parametrize("commit", [("another", COMMIT[1]), (COMMIT[0], not COMMIT[1])])
def test_not_at_another_commit_or_with_uncommitted_changes(
    kept: Kept, commit: tuple[str, bool]
) -> None:
    kept.commit = commit
    assert not kept.again()


def test_not_where_other_codes_are_required(kept: Kept) -> None:
    assert not kept.again(("a", "b"))


def test_not_with_another_report_results_or_timing(kept: Kept) -> None:
    (kept.report / "index.html").write_text("page, touched")
    assert not kept.again()
    kept.keep("run")
    assert kept.again()
    (kept.store.root / "records" / "ab").mkdir(parents=True)
    (kept.store.root / "records" / "ab" / "new.json").write_text("")
    assert not kept.again()
    kept.keep("run")
    assert kept.again()
    (kept.store.root / "timings" / "aa").mkdir(parents=True)
    (kept.store.root / "timings" / "aa" / "session.json").write_text("")
    assert not kept.again()


def test_output_of_another_run_is_not_kept_under_this_one(kept: Kept) -> None:
    of = kept.store.answer(reuse._key(kept.store, "same"))
    kept.keep("later")
    assert kept.store.answer(reuse._key(kept.store, "same")) == of


@pytest.mark.parametrize("commit", [("another", COMMIT[1]), (COMMIT[0], not COMMIT[1])])
def test_a_manifest_of_another_commit_is_stored_again_under_the_present_one(
    kept: Kept, commit: tuple[str, bool], monkeypatch: pytest.MonkeyPatch
) -> None:
    project: Any = type("Project", (), {"root": Path()})
    same = reuse.of_this_commit(project, kept.store, "same", kept.made, ["vv", "run"])
    assert same is kept.made
    kept.commit = commit
    here = changed(NOWHERE, commit=commit[0], dirty=commit[1])
    monkeypatch.setattr(reuse, "provenance", lambda *_: here)
    other = reuse.of_this_commit(project, kept.store, "same", kept.made, ["vv", "run"])
    assert other.provenance == here
    assert kept.store.manifests.read(other.name).provenance == here
    assert reuse.recall(kept.store, "same") == other


def test_what_lacks_the_series_of_one_of_its_records_does_not_stand(tmp_path: Path) -> None:
    store = Store(tmp_path)
    runs = [ran(store, label, "T1", 1e-3, "pass") for label in ("a/a", "b/b")]
    whole = manifest(*runs, name="run")
    store.manifests.keep(whole)
    reuse.remember(store, "same", whole)
    assert reuse.recall(store, "same") == whole
    first, second = sorted((tmp_path / "records").rglob("*.npz"))
    for lost in (first, second):
        content = lost.read_bytes()
        lost.unlink()
        assert reuse.recall(store, "same") is None
        lost.write_bytes(content)
    assert reuse.recall(store, "same") == whole

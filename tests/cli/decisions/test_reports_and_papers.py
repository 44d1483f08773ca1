"""Claims about what commands decide that report, compare papers, draw, or check a code."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.support.fabricated import entry, record
from vv.ask import Run, Status
from vv.base.errors import UsageError
from vv.cli import check_command, docs_command, past_commands, report_command
from vv.records.job_record import Record

PROJECT: Any = SimpleNamespace(data=lambda: Path("nowhere"))


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("new", ""),
        ("empty", ""),
        ("report", ""),
        ("other", "it already exists and is not a report"),
        ("file", "it already exists and is not a report"),
        ("none/new", "there is no folder"),
        ("new.html", "a report is a folder"),
    ],
)
def test_a_report_is_written_over_nothing_but_a_report(
    name: str, said: str, tmp_path: Path
) -> None:
    for folder in ("empty", "report", "other"):
        (tmp_path / folder).mkdir()
    for file in ("report/stamps.json", "report/index.html", "other/mine", "file"):
        (tmp_path / file).write_text("")
    if not said:
        assert report_command._folder(tmp_path / name) == tmp_path / name
        return
    with pytest.raises(UsageError, match=said):
        report_command._folder(tmp_path / name)


def test_a_report_of_single_cases_names_a_pattern_that_fits_none(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    built = SimpleNamespace(build_single=lambda manifest, store, cases, file, more: cases)
    monkeypatch.setattr("vv.cli.invocation.report_writer", lambda project: built)
    monkeypatch.setattr("vv.cli.invocation.report_extras", lambda *_: None)
    manifest: Any = SimpleNamespace(cases={"bounce": 0, "fall": 0})
    store: Any = None
    written: Any = report_command._written(PROJECT, store, manifest, None, ("b*", "x"))
    assert written == ["bounce"]
    with pytest.raises(UsageError, match="--single x,y: the run has no such case"):
        report_command._written(PROJECT, store, manifest, None, ("x", "y"))


def stored(monkeypatch: pytest.MonkeyPatch, **manifests: Any) -> None:
    """Let the store have these manifests, the newest last."""
    kept = SimpleNamespace(
        names=lambda: [*manifests],
        read=lambda name: manifests[name],
        records_of=lambda name, case: manifests[name],
    )
    monkeypatch.setattr("vv.store.store.Store", lambda _: SimpleNamespace(manifests=kept))


@pytest.mark.parametrize(
    ("kept", "name", "said"),
    [
        (["one", "two"], "one", "the manifest one"),
        (["one", "two"], "", "the manifest two"),
        (["one"], "three", "no run 'three'"),
        ([], "one", "no run 'one'"),
        ([], "", "there is no run yet"),
    ],
)
def test_a_report_is_of_the_run_of_a_name_or_of_the_latest(
    kept: list[str], name: str, said: str
) -> None:
    manifests = SimpleNamespace(
        names=lambda: kept,
        read=lambda name: f"the manifest {name}",
        latest=lambda: f"the manifest {kept[-1]}",
    )
    store: Any = SimpleNamespace(manifests=manifests)
    if said.startswith("the manifest"):
        manifest: Any = report_command._manifest(store, name)
        assert manifest == said
    else:
        with pytest.raises(UsageError, match=said):
            report_command._manifest(store, name)


def test_papers_are_compared_with_results_that_ran_with_their_own_parameters(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def made(label: str, **changes: Any) -> Record:
        return record(label, "T1", 1e-3, quantities=[entry("pass", {"max": 1e-4})], **changes)

    first, again = made("a/a"), made("a/a", code_version="2")
    others = made("b/b", modified=True), made("c/c", status="error"), made("d/d")
    stored(monkeypatch, first=[first, *others], second=[again])
    found = past_commands._newer(PROJECT, "bounce")
    assert len(found) == 2
    assert sorted(name.split()[1] for name in found) == ["a/a", "d/d"]


def test_a_picture_shows_the_named_schemes_of_one_variant_as_timed_last(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    every = [
        SimpleNamespace(case=case, variant=variant, label=label)
        for case, variant, label in (
            ("fall", "up", "a/x"), ("fall", "up", "b/x"), ("fall", "down", "a/x"),
            ("rise", "up", "a/x"),
        )
    ]  # fmt: skip
    drawn: list[Any] = []
    scheme = SimpleNamespace(name="x")
    for name, what in (
        ("vv.plan.selection.select", lambda *_: [(SimpleNamespace(name="fall"), "up")]),
        ("vv.plan.selection.named_adapters", lambda *_: None),
        ("vv.plan.selection.choose_schemes", lambda *_: [(SimpleNamespace(name="a"), scheme)]),
        ("vv.insight.effort.efforts", lambda manifest: manifest),
        ("vv.output.gallery.error_cost.picture", lambda own, name, file: drawn.append(own)),
    ):
        monkeypatch.setattr(name, what)
    stored(monkeypatch, early=every[:1], timed=every, late=every[1:])
    docs_command._picture(PROJECT, ["fall:up"], ("a",), Path("a.svg"))
    assert drawn == [[every[0]]]
    assert capsys.readouterr().out == "a.svg, of run timed\n"
    stored(monkeypatch, late=every[1:])
    with pytest.raises(UsageError, match="fall:up was never timed"):
        docs_command._picture(PROJECT, ["fall:up"], ("a",), Path("a.svg"))


@pytest.mark.parametrize(
    ("reason", "fates", "came"),
    [
        ("no walls", [], ["refused"]),
        (None, ["ran", "ran", "ran"], ["ran", "ran", "ran"]),
        (None, ["ran", "timeout", "ran"], ["ran", "timeout"]),
    ],
)
def test_a_code_that_takes_too_long_is_asked_no_smaller_step(
    reason: str | None,
    fates: list[str],
    came: list[str],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    def runs(*_: object) -> Iterator[tuple[int, Run]]:
        yield from ((n, Run(Status(fate))) for n, fate in enumerate(fates))

    monkeypatch.setattr("vv.run.runner.run_batches", runs)
    monkeypatch.setattr("vv.records.checking.checked", lambda run, ask: run)
    adapter: Any = SimpleNamespace(refuses=lambda ask, scheme: reason)
    tiny: Any = SimpleNamespace(name="a fall", asks=lambda scheme: [0, 1, 2])
    scheme: Any = SimpleNamespace(name="x")
    found = check_command._answers(adapter, scheme, tiny, 1.0, tmp_path)
    assert [one.status.value for one in found] == came
    assert [one.reason for one in found if one.status is Status.REFUSED] == [reason] * bool(reason)

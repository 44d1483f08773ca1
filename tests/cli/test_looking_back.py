"""Claims about commands that look back: which results papers and pictures are made of."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.support import fabricated
from tests.support.records.priced import manifest, record
from vv.base.errors import UsageError
from vv.case.published import Paper
from vv.cli import docs_command, past_commands
from vv.plan import imports, published
from vv.plan.content import ProjectError

NAMES = ["run 1", "run 2", "run 3"]


def project(tmp_path: Path) -> Any:
    return SimpleNamespace(data=lambda: tmp_path, roots=[tmp_path])


def test_the_newest_result_of_a_setting_counts_that_ran_with_the_case_s_own_parameters(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def made(dt: float, error: float, **changes: Any) -> Any:
        seen = [fabricated.entry("pass", {"max": error})]
        return fabricated.record("a/a", "T1", dt, quantities=seen, **changes)

    runs = {
        "run 1": [made(1e-3, 0.1), made(2e-3, 0.2)],
        "run 2": [made(1e-3, 0.3, modified=True), made(2e-3, 0.4, status="error", reason="x")],
        "run 3": [made(1e-3, 0.5)],
    }

    def records_of(name: str, case: str) -> Sequence[Any]:
        assert case == "bounce"
        if name == "run 0":
            raise OSError(5, "cannot be read")
        return runs[name]

    past = SimpleNamespace(names=lambda: ["run 0", *NAMES], records_of=records_of)
    store = SimpleNamespace(manifests=past)
    monkeypatch.setattr("vv.store.store.Store", lambda data: store)
    found = past_commands._newer(project(tmp_path), "bounce")
    errors = {name: one.quantities["y"].error for name, one in found.items()}
    assert errors == {"T1 a/a dt=0.001": 0.5, "T1 a/a dt=0.002": 0.2}
    assert "past run run 0: cannot be read; skipped" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("accepted", "said"), [(True, {"x": 1, "y": 2}), (False, {"x": 1, "y": 3})]
)
def test_what_is_newer_stands_for_what_is_accepted_unless_that_is_all_that_is_asked_for(
    accepted: bool, said: dict[str, int], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    baseline = SimpleNamespace(results={"x": 1, "y": 2})
    monkeypatch.setattr("vv.gate.all_checks.baseline_of", lambda *given: baseline)
    monkeypatch.setattr(past_commands, "_newer", lambda *given: {"y": 3})
    results: Any = past_commands._results
    assert results(project(tmp_path), accepted, "bounce") == said
    monkeypatch.setattr("vv.gate.all_checks.baseline_of", lambda *given: None)
    assert results(project(tmp_path), accepted, "bounce") == ({} if accepted else {"y": 3})


def drawn(
    monkeypatch: pytest.MonkeyPatch, runs: dict[str, Any], chosen: Sequence[Any] = ("a",)
) -> list[Any]:
    """What a picture of `made-up:a` is made of, for codes of which `ours` alone is asked for."""
    made: list[Any] = []
    case = SimpleNamespace(name="made-up")
    codes = [(SimpleNamespace(name="ours"), SimpleNamespace(name="default"))]
    store = SimpleNamespace(manifests=SimpleNamespace(names=lambda: [*runs], read=runs.__getitem__))
    monkeypatch.setattr("vv.store.store.Store", lambda data: store)
    monkeypatch.setattr("vv.plan.selection.select", lambda *_: [(case, one) for one in chosen])
    monkeypatch.setattr("vv.plan.selection.named_adapters", lambda *_: [])
    monkeypatch.setattr("vv.plan.selection.choose_schemes", lambda *_: codes)
    monkeypatch.setattr(
        "vv.output.gallery.error_cost.picture", lambda own, title, file: made.extend((own, title))
    )
    docs_command._picture(project(Path()), ["made-up:a"], ("ours",), Path("a.svg"))
    return made


def run_of(*codes: str, variant: str = "a", cpu: float | None = 1.0, error: float = 0.1) -> Any:
    return manifest(*(record(code, (1e-3, None, error, cpu), variant) for code in codes))


def test_a_picture_is_of_the_newest_run_that_timed_the_variant_in_a_code_asked_for(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    runs = {
        "run 1": run_of("ours", error=0.5),
        "run 2": run_of("ours", "theirs"),
        "run 3": run_of("theirs"),
        "run 4": run_of("ours", variant="b"),
        "run 5": run_of("ours", cpu=None),
    }
    own, title = drawn(monkeypatch, runs)
    assert [(one.case, one.variant, one.label, one.best) for one in own] == [
        ("made-up", "a", "ours/default", 0.1)
    ]  # fmt: skip
    assert title == "made-up:a"
    assert "a.svg, of run run 2" in capsys.readouterr().out


def test_a_picture_of_what_was_never_timed_or_of_two_variants_is_refused(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    with pytest.raises(UsageError, match="was never timed"):
        drawn(monkeypatch, {"run 1": run_of("theirs")})
    with pytest.raises(UsageError, match="takes one CASE:VARIANT, not 2"):
        drawn(monkeypatch, {}, ["a", "b"])


def test_a_paper_s_file_must_hold_a_paper_and_files_of_two_dashes_are_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "cases" / "papers"
    folder.mkdir(parents=True)
    for name in ("_b.py", "_a.py", "__init__.py", "c.py"):
        (folder / name).touch()
    some = project(tmp_path)
    assert [path.name for path in published.files(some)] == ["_a.py", "_b.py"]
    paper = Paper.__new__(Paper)
    monkeypatch.setattr(imports, "attribute", lambda roots, file, name: paper)
    assert published.papers(some) == (paper, paper)
    monkeypatch.setattr(imports, "attribute", lambda roots, file, name: 3.0)
    with pytest.raises(ProjectError, match="PAPER is of type float"):
        published.papers(some)


def test_past_runs_are_listed_newest_first_and_damaged_ones_are_passed_over(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def head(name: str) -> tuple[str]:
        if name == "3":
            raise OSError(5, "damaged")
        return (f"head of {name}",)

    told: list[Any] = []
    store = SimpleNamespace(
        manifests=SimpleNamespace(names=lambda: ["1", "2", "3", "4"], head=head)
    )
    monkeypatch.setattr("vv.store.store.Store", lambda _: store)
    monkeypatch.setattr("vv.output.result_lines.print_runs", told.extend)
    past_commands.runs(rows=3)
    assert told == [("4", "head of 4"), ("2", "head of 2")]

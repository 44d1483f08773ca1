"""Claims about tests that are run on one mutant at a time."""

from __future__ import annotations

from pathlib import Path

import pytest

from bench.mutation import left_out
from bench.mutation.mutants import ROOT, all_places

FILE = "vv/engines/dda/law.py"


def test_tests_that_are_green_in_a_plain_copy_are_run_on_each_mutant(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """One is always red; one detects the first mutant, so that it alone has been put in then."""
    first, second, *_ = all_places([FILE])

    def copied(folder: Path, files: object) -> None:
        (folder / FILE).parent.mkdir(parents=True)
        (folder / FILE).write_text((ROOT / FILE).read_text())

    def passes(project: Path, test: str) -> bool:
        return test != "red" and (project / FILE).read_text() != first.text()

    monkeypatch.setattr(left_out, "copied", copied)
    monkeypatch.setattr(left_out, "with_tests", dict)
    monkeypatch.setattr(left_out, "passes", passes)
    told = left_out.seeing(["red", "keen"], [first, second])
    assert told == {first.what: "keen", second.what: ""}
    assert "not run at all: red\n" in capsys.readouterr().out

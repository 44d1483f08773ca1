"""Claims about the lines that show how far an invocation has got."""

from __future__ import annotations

import pytest

from tests.support.fabricated import record
from vv.output import progress


def test_the_time_left_is_told_once_some_runs_are_done_and_timing_says_for_how_many(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    clock = iter(range(0, 10_000, 10))
    monkeypatch.setattr("time.monotonic", lambda: next(clock))
    with progress.progress() as shown:
        shown.begin(5)
        for _ in range(5):
            shown.done(record("a/a", "T1", 1e-3))
    few = capsys.readouterr().err.splitlines()
    assert few[:3] == ["1 of 5 runs", "2 of 5 runs", "3 of 5 runs, about 20 s left"]
    with progress.progress() as shown:
        shown.begin(100)
        for _ in range(100):
            shown.done(record("a/a", "T1", 1e-3))
        shown.timing(20)
    lines = capsys.readouterr().err.splitlines()
    assert lines[0] == "1 of 100 runs"
    assert lines[9] == "10 of 100 runs, about 15 min left"
    assert lines[8] == "9 of 100 runs"
    assert lines[-1].startswith("timing 20 settings, one after the other on one core: about 4 s")

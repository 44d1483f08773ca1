"""Claims about the circumstances of a result that are kept with it."""

from __future__ import annotations

import datetime
import os
import platform
from pathlib import Path

import pytest

import vv
from vv.store import provenance

LISTED = "processor : 0\nmodel name : Swift 9\nmodel name : Slow 1\n"


@pytest.mark.parametrize(
    ("listed", "told", "name"),
    [
        (LISTED, "x", "Swift 9"),
        ("processor : 0\n", "x", "arm64"),  # as on ARM, where the list has no names
        (None, "Swift 9", "Swift 9"),  # None: there is no list
        (None, "", "arm64"),
    ],
)
def test_a_processor_has_the_name_in_the_list_of_the_system_else_the_best_known(
    listed: str | None, told: str, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def read(path: Path) -> str:
        if listed is None:
            raise FileNotFoundError(path)
        return listed

    monkeypatch.setattr(Path, "read_text", read)
    monkeypatch.setattr(platform, "processor", lambda: told)
    monkeypatch.setattr(platform, "machine", lambda: "arm64")
    assert provenance._processor() == name


def test_a_result_is_kept_with_its_commit_command_time_and_versions(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(provenance, "commit", lambda root: (f"the commit of {root}", True))
    now = datetime.datetime(2026, 1, 2, 3, 4, 5, 678901, datetime.UTC)
    found = provenance.provenance(tmp_path, ["vv", "run", "--all"], now)
    assert (found.commit, found.dirty) == (f"the commit of {tmp_path}", True)
    assert (found.command, found.utc) == ("vv run --all", "2026-01-02T03:04:05+00:00")
    assert (found.versions["vv"], found.threads) == (vv.__version__, 1)
    assert found.versions["python"] == platform.python_version()
    assert {"numpy", "scipy", "numba"} <= found.versions.keys()
    assert provenance.run_name(now) == f"20260102T030405.678901Z-{os.getpid()}"


def test_machines_of_another_name_are_others(monkeypatch: pytest.MonkeyPatch) -> None:
    prints = []
    for name, cores in (("one", 2), ("two", 2), ("one", 4), ("one", 2)):
        monkeypatch.setattr(platform, "node", lambda name=name: name)
        monkeypatch.setattr(os, "cpu_count", lambda cores=cores: cores)
        provenance.machine.cache_clear()
        prints.append(provenance.machine().fingerprint)
    provenance.machine.cache_clear()
    assert prints[0] == prints[3]
    assert len(set(prints)) == 3

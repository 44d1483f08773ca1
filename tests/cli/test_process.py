"""Claims about the process of `vv`: what it imports, and how it ends."""

from __future__ import annotations

import gc
import subprocess
import sys

import pytest

from tests import ROOT
from vv import __main__, cli

NEEDLESS = {"numba", "scipy", "matplotlib", "pandas", "importlib.metadata", "multiprocessing"}


@pytest.mark.parametrize("word", ["list", "--help"])
def test_a_quick_look_imports_nothing_heavy(word: str) -> None:
    command = [sys.executable, "-X", "importtime", "-m", "vv", word]
    told = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stderr
    names = {line.rpartition("|")[2].strip() for line in told.splitlines()}
    assert "numpy" in names
    assert not NEEDLESS & names


def test_what_was_read_is_not_searched_as_the_process_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cli, "main", lambda: pytest.exit("as typer does"))
    threshold = gc.get_threshold()
    try:
        with pytest.raises(pytest.exit.Exception):
            __main__.main()
        assert gc.get_freeze_count() > 0
    finally:
        gc.unfreeze()
        gc.set_threshold(*threshold)

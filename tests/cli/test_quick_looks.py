"""Commands that only look do not import what they do not need."""

from __future__ import annotations

import subprocess
import sys

import pytest

from tests import ROOT

NEEDLESS = {"numba", "scipy", "matplotlib", "pandas", "importlib.metadata", "multiprocessing"}


@pytest.mark.parametrize("word", ["list", "--help"])
def test_a_quick_look_imports_nothing_heavy(word: str) -> None:
    command = [sys.executable, "-X", "importtime", "-m", "vv", word]
    told = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stderr
    names = {line.rpartition("|")[2].strip() for line in told.splitlines()}
    assert "numpy" in names
    assert not NEEDLESS & names

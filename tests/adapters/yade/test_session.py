"""Claims about how YADE is imported: from its folder without IPython, or as it is already there."""

from __future__ import annotations

import glob
import runpy
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any
from unittest import mock

import pytest

from tests import ROOT

SESSION = ROOT / "adapters" / "yade" / "inside" / "session.py"
YADE = "import sys\nO, met = 'omega', getattr(sys.modules.get('IPython'), '__version__', 'none')\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder with a package that stands for YADE, and notes the IPython that it meets."""
    (tmp_path / "yade").mkdir()
    for name, text in (("__init__", YADE), ("utils", ""), ("wrapper", "")):
        (tmp_path / "yade" / f"{name}.py").write_text(text)
    monkeypatch.setattr(sys, "path", [*sys.path])
    with mock.patch.dict(sys.modules):
        for name in [one for one in sys.modules if one.partition(".")[0] in ("yade", "IPython")]:
            del sys.modules[name]
        yield tmp_path


def test_yade_is_found_in_its_folder_and_spared_the_import_of_ipython(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("VV_YADE", str(folder))
    session = runpy.run_path(str(SESSION))
    assert (session["O"], session["yade"].met) == ("omega", "0.0")
    assert (session["WITHIN_YADE"], sys.path[0]) == (False, str(folder))
    assert "IPython" not in sys.modules


@pytest.mark.parametrize("within", [True, False])
def test_what_is_there_already_and_python_s_own_path_are_left_alone(
    folder: Path, within: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A script that YADE runs, which may have IPython; or no folder of YADE is known."""
    monkeypatch.setattr(glob, "glob", lambda pattern: [])
    monkeypatch.setenv("VV_YADE", "elsewhere" if within else "")
    sys.path.insert(0, str(folder))
    ipython: Any = ModuleType("IPython")
    ipython.__version__ = "9"
    sys.modules["IPython"] = ipython
    if within:
        __import__("yade")
    session = runpy.run_path(str(SESSION))
    assert (session["WITHIN_YADE"], session["yade"].met) == (within, "9")
    assert (sys.path[0], sys.modules["IPython"]) == (str(folder), ipython)

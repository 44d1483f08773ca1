"""Claims about docs/your-program.md: its commands run, its declaration is the example's."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests import ROOT
from vv.codes.program import declared
from vv.codes.program.process import REFUSED

PAGE = (ROOT / "docs" / "your-program.md").read_text()
COMMANDS = [line for block in re.findall(r"```sh\n(.*?)```", PAGE, re.DOTALL) for line in
            block.splitlines()]  # fmt: skip


@pytest.mark.skipif(shutil.which("cc") is None, reason="there is no C compiler")
def test_the_commands_of_the_page_run_one_after_another(tmp_path: Path) -> None:
    for name in ("first_dem.c", "first_dem.toml"):
        shutil.copy(ROOT / "examples" / "c" / name, tmp_path)
    environment = {"PATH": "/usr/bin:/bin", "VV_DATA": str(tmp_path / ".vv"), "HOME": str(tmp_path)}
    said = ""
    for command in COMMANDS:
        words = command.split()
        if words[0] in ("vv", "pytest"):
            words = [sys.executable, "-m", *words]
        if "pytest" in words:
            words += ["-p", "vv.pytest_plugin"]  # which it finds by itself where vv is installed
        done = subprocess.run(
            words,
            cwd=tmp_path,
            env={**environment, "PYTHONPATH": str(ROOT)},
            capture_output=True,
            text=True,
            check=False,
            timeout=120,
        )
        assert done.returncode == 0, (command, done.stderr)
        said += done.stdout
    assert re.search(r"first-dem/default +dt=1e-05 +2.1e-04 +2.5e-04 +1.00 of 1 ", said)
    assert "2 passed" in said


def test_the_page_shows_the_example_as_it_is() -> None:
    (shown,) = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    assert shown == (ROOT / "examples" / "c" / "first_dem.toml").read_text()


def test_the_workflow_for_others_does_what_the_page_says() -> None:
    text = (ROOT / "docs" / "ci" / "program.yml").read_text()
    for command in ("vv check ", "pytest --vv ", "vv gate ", "vv report"):
        assert command in text
    assert "ci/program.yml" in PAGE


def test_the_page_names_every_entry_of_a_declaration() -> None:
    named = set(re.findall(r"^\| `([\w-]+)` \|", PAGE, re.MULTILINE))
    assert {*declared.TOP, *declared.SCHEME} - {"scheme"} <= named
    assert f"| {REFUSED} | it refuses" in PAGE

"""The gate on real codes that were broken on purpose: each exit bit turns red for its reason."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests import ROOT
from vv.records.finding import Bit

FOLDERS = ("vv", "adapters", "cases", "reference_solutions", "reports")


class Copy:
    """A copy of this project, tool and all, to be broken."""

    def __init__(self, root: Path) -> None:
        self.root = root
        for folder in FOLDERS:
            ignored = shutil.ignore_patterns("__pycache__", "recorded")
            shutil.copytree(ROOT / folder, root / folder, ignore=ignored)
        shutil.copy(ROOT / "pyproject.toml", root)
        self.edit("vv/run/runner.py", "GRACE = 5.0", "GRACE = 0.2")

    def edit(self, file: str, old: str, new: str) -> None:
        """Replace a text in a file, which must hold it; an empty one: add at the end."""
        path = self.root / file
        text = path.read_text()
        assert old in text
        path.write_text(text.replace(old, new, 1) if old else f"{text}\n\n{new}")

    def gate(self, *words: str, **environment: str) -> tuple[int, str]:
        """Exit status and output of the gate, at its quick level."""
        done = subprocess.run(
            [sys.executable, "-m", "vv", "gate", *words],
            cwd=self.root,
            env={**os.environ, "VV_CACHE": str(self.root / "cache"), **environment},
            capture_output=True,
            text=True,
            check=False,
            timeout=120,
        )
        assert "Traceback" not in done.stderr, done.stderr
        return done.returncode, done.stdout


@pytest.fixture
def copy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Copy:
    monkeypatch.delenv("VV_DATA", raising=False)
    monkeypatch.delenv("VV_PROJECT", raising=False)
    return Copy(tmp_path)


DEM, EXACT = ("--codes", "dem/default"), ("--codes", "exact")
BREAKAGES = {
    "a perturbed constant of a kernel": (
        "single-contact:T1", DEM, "vv/engines/dem/line/kernel.py",
        "dt / mass, 1.0", "1.00001 * dt / mass, 1.0", Bit.ACCURACY, "worse than accepted",
    ),
    "friction of the wrong sign": (
        "single-contact:T3", DEM, "vv/engines/dem/line/kernel.py",
        "shear - ks * dt", "shear + ks * dt", Bit.CRASH | Bit.INCOMPLETE, "diverged",
    ),
    "energy not booked": (
        "single-contact:T4", EXACT, "vv/engines/exact/ledger.py",
        'np.asarray(path.system.eta *', 'np.asarray(0.999 * path.system.eta *',
        Bit.CONSERVATION, "energy not conserved: unexplained",
    ),
    "a process that is killed": (
        "single-contact:T1", EXACT, "vv/engines/exact/__init__.py",
        "", "def answer(*_):\n    import os\n    os.kill(os.getpid(), 9)\n",
        Bit.CRASH | Bit.INCOMPLETE, "SIGKILL",
    ),
    "a process that hangs": (
        "single-contact:T1", EXACT, "vv/engines/exact/__init__.py",
        "", "def answer(*_):\n    import time\n    time.sleep(60)\n",
        Bit.TIMEOUT | Bit.INCOMPLETE, "no answer in time",
    ),
}  # fmt: skip


def test_the_copy_is_green_as_it_is(copy: Copy) -> None:
    code, said = copy.gate("single-contact:T[14]", "--codes", "dem/default,exact")
    assert (code, "gate: green" in said) == (0, True), said


@pytest.mark.parametrize("name", BREAKAGES)
def test_what_is_broken_is_red(copy: Copy, name: str) -> None:
    selection, codes, file, old, new, bits, words = BREAKAGES[name]
    copy.edit(file, old, new)
    hung = ("--timeout", "1") if bits & Bit.TIMEOUT else ()
    code, said = copy.gate(selection, *codes, *hung)
    assert Bit(code) == bits, said
    assert words in said


@pytest.mark.skipif(not shutil.which("liggghts"), reason="LIGGGHTS is not installed")
@pytest.mark.parametrize(
    ("script", "bits"),
    [
        ("kill -9 $$", Bit.CRASH),
        ("sleep 60", Bit.TIMEOUT),
        ("exit 0", Bit.CRASH),
    ],
)
def test_an_external_program_that_fails_is_red(
    copy: Copy, tmp_path: Path, script: str, bits: Bit
) -> None:
    program = tmp_path / "program"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(0o755)
    words = ("single-contact:T1", "--codes", "liggghts/default", "--timeout", "0.5")
    code, said = copy.gate(*words, VV_LIGGGHTS=str(program))
    assert Bit(code) == bits | Bit.INCOMPLETE, said

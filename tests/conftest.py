"""What several tests share: a tiny project made from the texts in tests/tiny."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

TINY = Path(__file__).parent / "tiny"


class Tiny:
    """A project with one case and a code that misbehaves as its schemes' names say."""

    def __init__(self, root: Path) -> None:
        self.root = root

    def vv(self, *words: str, **environment: str) -> subprocess.CompletedProcess[str]:
        """Run the command line in the project."""
        return subprocess.run(
            [sys.executable, "-m", "vv", *words],
            cwd=self.root,
            env={**os.environ, **environment},
            capture_output=True,
            text=True,
            check=False,
            timeout=60,
        )

    def edit(self, file: str, old: str, new: str) -> None:
        """Replace a text in a file of the project; it must be there."""
        path = self.root / file
        text = path.read_text()
        assert old in text
        path.write_text(text.replace(old, new))


@pytest.fixture
def tiny(tmp_path: Path) -> Tiny:
    """A fresh tiny project."""
    for source in TINY.glob("*/*.txt"):
        target = tmp_path / source.parent.name / source.stem
        target.parent.mkdir(exist_ok=True)
        target.write_text(source.read_text())
        (target.parent / "__init__.py").write_text('"""Part of the tiny project."""\n')
    (tmp_path / "vv.toml").write_text("")
    return Tiny(tmp_path)

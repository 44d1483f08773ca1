"""What several tests share: a tiny project made from the texts in tests/support/tiny."""

import os
import subprocess
import sys
from pathlib import Path

import hypothesis
import pytest

# A busy machine fails no test: the time that an example takes says nothing of the code.
hypothesis.settings.register_profile("vv", deadline=None)
hypothesis.settings.load_profile("vv")
TINY = Path(__file__).parent / "support" / "tiny"


def _without_vv() -> dict[str, str]:
    """The environment without what steers vv, so that a test sees only its own project."""
    return {name: value for name, value in os.environ.items() if not name.startswith("VV_")}


class Tiny:
    """A project with one case and a code that misbehaves as its schemes' names say."""

    def __init__(self, root: Path) -> None:
        self.root = root

    def vv(self, *words: str, **environment: str) -> subprocess.CompletedProcess[str]:
        """Run the command line in the project."""
        return subprocess.run(
            [sys.executable, "-m", "vv", *words],
            cwd=self.root,
            env={**_without_vv(), **environment},
            capture_output=True,
            text=True,
            check=False,
            timeout=60,
        )

    def git(self, *words: str) -> None:
        """Run git in the project, as somebody."""
        identity = ("-c", "user.name=a", "-c", "user.email=a@b.c")
        subprocess.run(["git", *identity, *words], cwd=self.root, check=True, capture_output=True)

    def edit(self, file: str, old: str, new: str) -> None:
        """Replace a text in a file of the project; it must be there.

        Python tells compiled from newer sources by size and seconds: an edit ages by some.
        """
        path = self.root / file
        text, then = path.read_text(), path.stat().st_mtime
        assert old in text
        path.write_text(text.replace(old, new))
        os.utime(path, (then + 2, then + 2))


def tiny_project(root: Path) -> Tiny:
    """Write a tiny project into an empty folder."""
    for source in TINY.glob("*/*.txt"):
        target = root / source.parent.name / source.stem
        target.parent.mkdir(exist_ok=True)
        target.write_text(source.read_text())
        (target.parent / "__init__.py").write_text('"""Part of the tiny project."""\n')
    (root / "vv.toml").write_text("alone = true\n")
    return Tiny(root)


@pytest.fixture
def tiny(tmp_path: Path) -> Tiny:
    """A fresh tiny project."""
    return tiny_project(tmp_path)

"""Claims about `vv docs`: a page for each case and code, or for those named alone."""

from __future__ import annotations

from pathlib import Path

from tests.conftest import Tiny


def pages(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*.md")}


def test_all_pages_are_written_anew_or_those_named_beside_the_others(tiny: Tiny) -> None:
    out = tiny.root / "out"
    done = tiny.vv("docs", "--output", "out")
    assert done.returncode == 0, done.stderr
    whole = pages(out)
    assert whole >= {"cases/fall.md", "codes/fake.md", "codes/missing.md"}
    old = out / "cases" / "old.md"
    old.write_text((out / "cases" / "fall.md").read_text())  # of a case that is no more
    (out / "codes" / "fake.md").unlink()
    (out / "cases" / "fall.md").unlink()
    assert tiny.vv("docs", "fall", "--output", "out").returncode == 0
    assert pages(out) == whole - {"codes/fake.md"} | {"cases/old.md"}
    assert tiny.vv("docs", "--output", "out").returncode == 0
    assert pages(out) == whole

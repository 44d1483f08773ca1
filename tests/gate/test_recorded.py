"""Recorded results of external codes: kept small, shown with their age, never a live pass."""

import json
from pathlib import Path

from tests.conftest import Tiny
from vv.records.finding import Bit


def external(tiny: Tiny) -> Path:
    """Make the fake code one that needs a program; returns the program."""
    program = tiny.root / "program"
    program.write_text("one")
    old, new = "return Found(True, version=\"1.0\")", (
        f"return Found(True, version='1.0', files=(Path({str(program)!r}),)) "
        f"if Path({str(program)!r}).exists() else Found(False, how_to_install='make it')"
    )  # fmt: skip
    tiny.edit("adapters/fake.py", old, new)
    return program


def test_what_is_recorded_is_shown_where_the_code_is_absent_and_never_passes(tiny: Tiny) -> None:
    program = external(tiny)
    tiny.edit("adapters/fake.py", "(*map(scheme, NAMES)", "(*map(scheme, ['good'])")
    done = tiny.vv("record", "fall", "--codes", "fake,missing")
    assert done.returncode == 0, done.stderr
    path = tiny.root / "cases" / "recorded" / "fake" / "fall.json"
    text = path.read_text()
    kept = json.loads(text)
    assert {"version", "executables", "utc", "commit", "machine", "parameters"} <= kept.keys()
    assert list(kept["executables"]) == ["program"]
    assert sum(name.startswith("up fake/good") for name in kept["results"]) == 3
    finest = kept["results"]["up fake/good dt=0.025"]["y"]
    assert {"max error", "final", "mean"} <= finest.keys()
    assert len(finest["t"]) == len(finest["y"]) <= 41
    assert "t" not in kept["results"]["up fake/good dt=0.1"]["y"]

    old = kept["utc"]
    path.write_text(text.replace(old, old.replace(old[:4], str(int(old[:4]) - 1))))
    program.unlink()
    words = ("gate", "fall:up", "--codes", "fake/good", "--markdown", "s.md")
    done = tiny.vv(*words)
    assert done.returncode == Bit.INCOMPLETE  # nothing ran
    assert "1 not installed" in done.stdout
    assert tiny.vv(*words, "--require", "fake").returncode == Bit.INCOMPLETE
    said = (tiny.root / "s.md").read_text()
    assert "fake is not installed: the report shows results of 1.0 recorded 36" in said
    assert tiny.vv("report").returncode == 0
    report = (tiny.root / ".vv" / "report" / "case-fall.html").read_text()
    assert f"recorded {int(old[:4]) - 1}{old[4:10]} with 1.0, 36" in report

    tiny.vv("run", "fall:up", "--codes", "fake/good", "--set", "speed=5.5")
    report = (tiny.root / ".vv" / "report" / "case-fall.html").read_text()
    assert "recorded 2" not in report  # other parameters


def test_only_external_codes_that_are_here_are_recorded(tiny: Tiny) -> None:
    done = tiny.vv("record", "fall")
    assert (done.returncode, "names no external code" in done.stderr) == (Bit.USAGE, True)
    assert not (tiny.root / "cases" / "recorded").exists()

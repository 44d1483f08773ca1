"""What is wrong with a call is said before a plan is built, let alone a case run."""

from __future__ import annotations

import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from tests.conftest import Tiny
from vv import cli
from vv.base.files import check_output, write_output
from vv.records.finding import Bit

WRONG = {
    "run fall --since nope": "git says: ",
    "run fall --since=--output=planted": "git says: ",
    "run fall --budget soon": "--budget 'soon'",
    "run fall --executor ssh://there": "--executor 'ssh://there'",
    "run fall --timeout nan": "--timeout = nan s; it must be positive",
    "run fall --json nowhere/out.json": "nowhere: no such folder",
    "run fall --json cases": "cannot use cases: Is a directory",
    "gate fall --json nowhere/out.json": "nowhere: no such folder",
    "gate fall --junit nowhere/out.xml": "nowhere: no such folder",
    "gate fall --markdown cases": "cannot use cases: Is a directory",
    "speed fall --json nowhere/out.json": "nowhere: no such folder",
    f"gate fall --junit {'x' * 300}": "File name too long",
}


@pytest.mark.parametrize("call", WRONG)
@pytest.mark.parametrize("more", ["", " --dry-run"])
def test_it_is_said_before_a_plan_is_built(
    tiny: Tiny, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], call: str,
    more: str,
) -> None:  # fmt: skip
    def no_plan(*_: object) -> None:
        raise AssertionError("a plan was built")

    monkeypatch.setattr("vv.cli.options.plan_of", no_plan)
    monkeypatch.chdir(tiny.root)
    words = [*call.split(), *(more.split() if call.startswith("run") else ())]
    monkeypatch.setattr(sys, "argv", ["vv", *words])
    with pytest.raises(SystemExit) as ended:
        cli.main()
    said = capsys.readouterr().err
    assert (ended.value.code, WRONG[call] in said) == (Bit.USAGE, True), said
    assert len(said.splitlines()) == 1
    assert not (tiny.root / "planted").exists()


def test_what_was_typed_is_quoted_in_part_only(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["vv", "run", "bounce", "--rung", "x" * 100_000])
    with pytest.raises(SystemExit):
        cli.main()
    assert len(capsys.readouterr().err) < 2100


def test_a_pipe_that_was_named_is_written_to_and_not_replaced(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    write_output(pipe, b"told")
    assert (os.read(reader, 9), stat.S_ISFIFO(pipe.stat().st_mode)) == (b"told", True)
    os.close(reader)


@pytest.mark.parametrize(
    ("words", "place"),
    [
        ("list", "standard output"),
        ("run fall:up --codes fake/good --json -", "standard output"),
        ("run fall:up --codes fake/good --json /dev/full", "/dev/full"),
        ("gate fall:up --codes fake/good --junit /dev/full", "/dev/full"),
    ],
)
def test_what_is_full_is_named(tiny: Tiny, words: str, place: str) -> None:
    with open("/dev/full" if place == "standard output" else os.devnull, "w") as out:
        done = subprocess.run(
            [sys.executable, "-m", "vv", *words.split()], cwd=tiny.root, stdout=out,
            stderr=subprocess.PIPE, text=True, check=False,
        )  # fmt: skip
    assert (done.returncode, done.stderr.splitlines()[-1]) == (
        Bit.USAGE,
        f"vv: cannot use {place}: No space left on device",
    )


@pytest.mark.parametrize("kind", ["junit", "markdown"])
def test_a_summary_never_takes_the_place_of_a_device(tiny: Tiny, kind: str) -> None:
    """Renamed over /dev/null, it would spoil a machine on which root asked."""
    target = tiny.root / "pipe"
    os.mkfifo(target)
    reader = os.open(target, os.O_RDWR | os.O_NONBLOCK)
    done = tiny.vv("gate", "fall:up", "--codes", "fake/good", f"--{kind}", str(target))
    assert (done.returncode, stat.S_ISFIFO(target.stat().st_mode)) == (0, True), done.stderr
    assert os.read(reader, 9)
    os.close(reader)


def test_a_place_that_nobody_may_write_to_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    check_output(tmp_path / "new")
    monkeypatch.setattr(os, "access", lambda *_: False)  # as to all but root
    with pytest.raises(PermissionError):
        check_output(tmp_path / "new")

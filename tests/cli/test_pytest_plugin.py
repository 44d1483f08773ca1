"""Claims about the plug-in of pytest: each variant and setting is a test, judged as by the gate."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from tests.cli.test_programs import declare
from tests.conftest import Tiny, _without_vv

CODES = "fake/good,fake/coarse,fake/refuses,fake/raises"


def run(tiny: Tiny, *words: str) -> subprocess.CompletedProcess[str]:
    """Run pytest with the plug-in in the project."""
    plugin = ("-p", "vv.pytest_plugin", "-p", "no:cacheprovider")
    return subprocess.run(
        [sys.executable, "-m", "pytest", "-v", "-rs", *plugin, *words],
        cwd=tiny.root,
        env=_without_vv(),
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )


def test_each_setting_is_a_test_and_the_report_is_linked(tiny: Tiny) -> None:
    (tiny.root / "test_mine.py").write_text("def test_of_their_own(): pass\n")
    done = run(tiny, "--vv", "fall:up", "--vv-code", CODES)
    assert done.returncode == 1, done.stdout
    assert "vv::fall:up fake/good dt=0.1 PASSED" in done.stdout
    assert "vv::fall:up fake/coarse dt=0.1 FAILED" in done.stdout
    assert "error 0.01, tolerance 0.001" in done.stdout
    assert "___ vv: fall:up fake/coarse dt=0.1 ___" in done.stdout
    assert "vv::fall:up fake/raises dt=0.1 FAILED" in done.stdout
    assert "error: RuntimeError: a bug in the code" in done.stdout
    assert "refused: it does not feel like it" in done.stdout
    assert "2 failed, 2 passed, 1 skipped" in done.stdout
    assert f"vv report: {tiny.root}/.vv/report/index.html" in done.stdout
    assert Path(tiny.root, ".vv", "report", "index.html").is_file()


def test_a_failure_ends_in_the_command_that_runs_it_again(tiny: Tiny) -> None:
    done = run(tiny, "--vv", "fall:up", "--vv-code", "fake/coarse", "--vv-rung", "dt=0.2")
    assert "vv::fall:up fake/coarse dt=0.2 FAILED" in done.stdout
    assert "again: vv run fall:up --codes fake/coarse --rung dt=0.2" in done.stdout
    done = run(tiny, "--vv", "fall:up", "--vv-code", "fake/coarse", "--vv-set", "g=5")
    assert "--set g=5\n" in done.stdout


def test_a_named_program_that_refuses_all_fails(tiny: Tiny) -> None:
    declare(tiny.root, "mine", "echo 'not today' >&2; exit 3")
    done = run(tiny, "--vv", "fall:up", "--vv-code", "mine.toml")
    assert done.returncode == 1, done.stdout
    assert "mine: required, but none of its jobs ran; refused: not today" in done.stdout


def test_without_the_option_there_is_nothing_of_it(tiny: Tiny) -> None:
    (tiny.root / "test_mine.py").write_text("def test_of_their_own(): pass\n")
    done = run(tiny)
    assert "1 passed" in done.stdout
    assert "vv" not in done.stdout.replace(str(tiny.root), "").partition("collected")[2]


def test_the_tests_of_the_project_are_left_out_if_asked(tiny: Tiny) -> None:
    (tiny.root / "test_mine.py").write_text("raise ValueError\n")
    done = run(tiny, "--vv-only", "--vv", "fall:up", "--vv-code", "fake/good")
    assert done.returncode == 0, done.stdout
    assert "1 passed" in done.stdout
    done = run(tiny, "--vv-only")
    assert done.returncode == 4
    assert "--vv-only: name the cases to run with --vv CASE" in done.stdout + done.stderr


def test_what_names_no_case_is_a_mistake_in_the_call(tiny: Tiny) -> None:
    done = run(tiny, "--vv", "fal")
    assert done.returncode == 4
    assert "--vv: no case or family 'fal'; did you mean fall?" in done.stdout + done.stderr

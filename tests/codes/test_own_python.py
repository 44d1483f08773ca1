"""Claims about codes in Pythons of their own: found, driven and read, or said to be missing."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from vv.ask import Ask, Displacement, History, Knobs, Model, Run, Status
from vv.codes.own_python import Driver, PythonEnvironment
from vv.scene import Contact, Scene, Spheres, Vector

FRAME = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
MODEL = Model(3, frozenset())
DRIVER = '''
"""Moves steadily by x = t, or does what its ask says."""

import numpy as np

from vv.codes.driver_protocol import Plan, RunError, Stopwatch, serve, swung


def simulate(ask: Plan, watched: bool, watch: Stopwatch):
    if ask["does"] == "dies":
        raise SystemExit(3)
    if ask["does"] == "refuses":
        raise RunError("refused", "it does not like this")
    if ask["does"] == "fails":
        raise ZeroDivisionError("by nought")
    watch.lap("setup")
    t = ask["dt"] * np.arange(0, ask["steps"] + 1, ask["stride"])
    values = np.zeros((ask["seen"], len(t), 3))
    values[0, :, 0] = np.nan if ask["does"] == "diverges" else t
    watch.lap("steps")
    return values, {}


if __name__ == "__main__":
    serve(simulate)
'''


@pytest.fixture
def driver(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Driver:
    """A code whose environment is our own Python under another name."""
    home = tmp_path / "codes" / "mine"
    (home / "bin").mkdir(parents=True)
    python = home / "bin" / "python"
    python.write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
    python.chmod(0o755)
    listed = home / "lib/python3.11/site-packages/mine-1.2.3.dist-info"
    listed.mkdir(parents=True)
    (listed / "RECORD").write_text("mine.so,sha256=abc,3\n")
    monkeypatch.setenv("VV_CODES", str(tmp_path / "codes"))
    source = tmp_path / "driver.py"
    source.write_text(DRIVER)
    return Driver(PythonEnvironment("mine", ("mine",)), source)


def ask() -> Ask:
    ball = Spheres(
        np.zeros((1, 3)), np.zeros((1, 3)), np.ones(1), np.ones(1), np.ones((1, 3), bool)
    )
    return Ask(Scene((ball,), Contact(1.0)), History(1.0, 0.5), (Displacement(0),), Knobs(0.1))


def ran(driver: Driver, does: Sequence[str], folder: Path, seen: int = 1) -> list[Run]:
    plan = {"dt": 0.1, "steps": 10, "stride": 5, "seen": seen}
    built: list[tuple[dict[str, object], Model, Vector]] = [
        ({**plan, "does": what}, MODEL, FRAME) for what in does
    ]
    folder.mkdir(exist_ok=True)
    return list(driver.run([ask()] * len(built), built, folder, 0.0))


def test_an_answer_is_turned_into_the_frame_of_the_scene(driver: Driver, tmp_path: Path) -> None:
    (run,) = ran(driver, ["moves"], tmp_path / "scratch")
    assert run.status is Status.RAN
    assert run.values[Displacement(0)] == pytest.approx(np.outer([0, 0.5, 1.0], [0, 1.0, 0]))
    assert run.cost.startup > 0


def test_every_ask_has_its_own_outcome(driver: Driver, tmp_path: Path) -> None:
    does = ["moves", "refuses", "fails", "diverges", "dies", "moves"]
    runs = ran(driver, does, tmp_path / "scratch")
    assert [run.status.value for run in runs] == [
        "ran", "refused", "error", "diverged", "error", "ran",
    ]  # fmt: skip
    assert runs[1].reason == "it does not like this"
    assert runs[2].reason == "ZeroDivisionError: by nought"
    assert "exit code 3" in runs[4].reason


def test_an_answer_of_another_shape_is_an_error(driver: Driver, tmp_path: Path) -> None:
    (run,) = ran(driver, ["moves"], tmp_path / "scratch", seen=2)
    assert (run.status, run.reason) == (
        Status.ERROR, "the answer has shape (2, 3, 3); (1, 3, 3) was asked for",
    )  # fmt: skip


def test_its_version_and_the_digests_of_its_files_come_from_its_package(driver: Driver) -> None:
    found = driver.home.find()
    assert found.installed
    assert found.version == "1.2.3"
    assert [file.name for file in found.files[1:]] == ["RECORD"]


def test_a_code_without_its_environment_is_not_installed_and_says_how(
    driver: Driver, tmp_path: Path
) -> None:
    other = Driver(PythonEnvironment("other", ("other",)), driver.file)
    (run,) = other.run([ask()], [({}, MODEL, FRAME)], tmp_path, 0.0)
    assert run.status is Status.NOT_INSTALLED
    assert run.reason.startswith("make setup CODES=other")


def test_one_that_dies_in_a_folder_used_before_gives_no_answer(
    driver: Driver, tmp_path: Path
) -> None:
    (before,) = ran(driver, ["moves"], tmp_path / "scratch")
    (run,) = ran(driver, ["dies"], tmp_path / "scratch")
    assert before.status is Status.RAN
    assert (run.status, run.values) == (Status.ERROR, {})
    assert "exit code 3" in run.reason

"""Claims about drivers in Pythons of their own: what is found, asked, timed and read of each."""

from __future__ import annotations

import dataclasses
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.codes.test_own_python import FRAME, MODEL, ask, driver
from vv.ask import Cost, Displacement, Knobs, Model, Status
from vv.codes import driver_protocol, own_python
from vv.codes.own_python import Driver, PythonEnvironment

assert driver  # a fixture
PLAN: dict[str, Any] = {"dt": 0.1, "steps": 10, "stride": 5, "seen": 1, "does": "moves"}


def test_each_ask_is_read_with_its_own_frame_and_model(driver: Driver, tmp_path: Path) -> None:
    asks = [ask(), dataclasses.replace(ask(), knobs=Knobs(0.25))]
    built = [(PLAN, MODEL, FRAME), (PLAN, Model(7, frozenset()), np.eye(3))]
    one, other = driver.run(asks, built, tmp_path, 0.0)
    assert one.values[Displacement(0)][-1] == pytest.approx([0.0, 1.0, 0.0])
    assert other.values[Displacement(0)][-1] == pytest.approx([1.0, 0.0, 0.0])
    assert (one.model, other.model) == (MODEL, Model(7, frozenset()))


def test_the_start_is_paid_by_the_first_ask_and_takes_seconds_not_an_epoch(
    driver: Driver, tmp_path: Path
) -> None:
    first, second = driver.run([ask()] * 2, [(PLAN, MODEL, FRAME)] * 2, tmp_path, 0.0)
    assert 0.0 < first.cost.startup < 100.0
    assert second.cost.startup == 0.0


def test_what_is_to_be_timed_is_repeated(driver: Driver, tmp_path: Path) -> None:
    (once,) = driver.run([ask()], [(PLAN, MODEL, FRAME)], tmp_path, 0.0)
    (again,) = driver.run([ask()], [(PLAN, MODEL, FRAME)], tmp_path, 1e-9)
    assert (once.cost.repeats, again.cost.repeats) == (1, 3)


def test_variables_for_our_own_python_do_not_reach_the_other(
    driver: Driver, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "ours").mkdir()
    (tmp_path / "ours" / "json.py").write_text("raise SystemExit('ours was imported')")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path / "ours"))
    (run,) = driver.run([ask()], [(PLAN, MODEL, FRAME)], tmp_path, 0.0)
    assert (run.status, run.reason) == (Status.RAN, "")


def test_every_ask_of_a_code_that_is_not_there_says_so(driver: Driver, tmp_path: Path) -> None:
    other = Driver(PythonEnvironment("other", ("other",)), driver.file)
    runs = [*other.run([ask()] * 3, [(PLAN, MODEL, FRAME)] * 3, tmp_path, 0.0)]
    assert [run.status for run in runs] == [Status.NOT_INSTALLED] * 3


def environment(place: Path, **versions: str) -> Path:
    """An environment `mine` with these packages, whose Python is a link to another place."""
    home = place / "mine"
    (home / "bin").mkdir(parents=True)
    (place / "python3").write_text("")
    (home / "bin" / "python").symlink_to(place / "python3")
    for name, version in versions.items():
        listed = home / "lib" / "python3.12" / "site-packages" / f"{name}-{version}.dist-info"
        listed.mkdir(parents=True)
        (listed / "RECORD").write_text(name)
    return home


def test_a_code_of_several_packages_has_the_version_of_the_first_and_the_files_of_all(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("VV_CODES", raising=False)
    monkeypatch.chdir(tmp_path)  # one looks for .codes here too
    environment(tmp_path / ".codes", mine="1.5", zebra="9.9")
    found = PythonEnvironment("mine", ("mine", "zebra")).find()
    assert (found.installed, found.version) == (True, "1.5")
    assert found.path == str(tmp_path / ".codes" / "mine" / "bin" / "python")
    assert found.files[0] == (tmp_path / ".codes" / "python3").resolve()
    assert [file.read_text() for file in found.files[1:]] == ["mine", "zebra"]


@pytest.mark.parametrize("lacks", ["package", "python"])
def test_an_environment_that_lacks_a_part_is_not_installed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, lacks: str
) -> None:
    monkeypatch.setenv("VV_CODES", str(tmp_path))
    home = environment(tmp_path, mine="1.5")
    if lacks == "python":
        (home / "bin" / "python").unlink()
    packages = ("mine", "zebra") if lacks == "package" else ("mine",)
    assert not PythonEnvironment("mine", packages).find().installed


def test_each_part_of_a_cost_is_read(tmp_path: Path) -> None:
    told = {"setup": 2.0, "solve_cpu": 3.0, "solve_wall": 4.0, "output": 5.0, "repeats": 6,
            "spread": 7.0}  # fmt: skip
    whole = {"status": "ran", "reason": "", "steps": 2, "ready": 11.0, **told}
    (tmp_path / "ask.json.answer").write_text(json.dumps(whole))
    np.save(tmp_path / "ask.json.npy", np.zeros((1, 3, 3)))
    run = own_python.parse(tmp_path / "ask.json", ask(), MODEL, FRAME, 10.0)
    assert run is not None
    assert run.cost == Cost(startup=1.0, **told)  # type: ignore[arg-type]


def test_a_run_that_came_to_nothing_has_cost_its_start(tmp_path: Path) -> None:
    whole = {"status": "diverged", "reason": "up", "ready": 11.0}
    (tmp_path / "ask.json.answer").write_text(json.dumps(whole))
    run = own_python.parse(tmp_path / "ask.json", ask(), MODEL, FRAME, 10.0)
    assert run is not None
    assert (run.status, run.cost) == (Status.DIVERGED, Cost(startup=1.0))


def test_arrays_of_objects_are_not_unpacked(tmp_path: Path) -> None:
    """A pickle could run code; what a program of others writes is data."""
    whole = {"status": "ran", "reason": "", "steps": 2, "ready": 0.0}
    (tmp_path / "ask.json.answer").write_text(json.dumps(whole))
    np.save(tmp_path / "ask.json.npy", np.array([print], dtype=object))
    with pytest.raises(ValueError, match="Object arrays cannot be loaded"):
        own_python.parse(tmp_path / "ask.json", ask(), MODEL, FRAME, 10.0)


def test_a_script_that_runs_alone_has_all_of_its_plan_and_its_notes_first(
    driver: Driver, tmp_path: Path
) -> None:
    deep = {**PLAN, "law": {"parts": [{"kn": [1.0, {"ks": 0.1 + 0.2}]}]}, "n": np.float64(2.5),
            "observe": [["displacement", 0]]}  # fmt: skip
    text = driver.script(deep, "first note; second note")
    notes, _, literal = text.partition("ASK: dict[str, Any] | None = ")
    assert notes.endswith("# first note\n# second note\n")
    assert eval(literal.partition("\nPlan =")[0]) == {**deep, "n": 2.5}
    script = tmp_path / "alone.py"
    script.write_text(text)
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[1:] == [
        "# t [s], displacement of body 0: x, y, z [SI]", "0 0 0 0", "0.5 0.5 0 0", "1 1 0 0",
    ]  # fmt: skip


def answered(folder: Path, error: Exception | None = None) -> dict[str, Any]:
    """What a driver writes to an ask whose solution is a third, or raises an error."""

    def simulate(_: Any, watched: bool, watch: driver_protocol.Stopwatch) -> tuple[Any, Any]:
        if error is not None:
            raise error
        watch.lap("setup")
        watch.lap("steps")
        return np.full((1, 2, 3), 1.0 / 3.0), {}

    asked = folder / "ask.json"
    asked.write_text(json.dumps({"steps": 7, "repeat": 0.0}))
    driver_protocol.answer(str(asked), simulate, 1.0)
    told: dict[str, Any] = json.loads((folder / "ask.json.answer").read_text())
    return told


@pytest.mark.parametrize("error", [ValueError("odd"), KeyError("x"), ZeroDivisionError("by 0")])
def test_whatever_a_driver_stumbles_over_is_told(tmp_path: Path, error: Exception) -> None:
    told = answered(tmp_path, error)
    assert (told["status"], told["reason"]) == ("error", f"{type(error).__name__}: {error}")


def test_an_answer_is_there_only_when_its_values_are(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[bool] = []
    rename = os.replace

    def noted(source: str, target: str) -> None:
        values = tmp_path / "ask.json.npy"
        seen.append(values.exists() and np.load(values).shape == (1, 2, 3))
        rename(source, target)

    monkeypatch.setattr(os, "replace", noted)
    assert answered(tmp_path)["status"] == "ran"
    assert seen == [True]


def test_what_is_printed_has_all_digits(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    asked = {"steps": 4, "stride": 2, "dt": 0.1, "observe": [["velocity", 3]]}
    monkeypatch.setattr(driver_protocol, "ASK", asked)

    def simulate(_: Any, watched: bool, watch: driver_protocol.Stopwatch) -> tuple[Any, Any]:
        watch.lap("setup")
        watch.lap("steps")
        return np.array([[[1.0, 2.0, 3.0], [1.0 / 3.0, -1e-300, np.pi]]]), {}

    driver_protocol.serve(simulate)
    last = [float(part) for part in capsys.readouterr().out.splitlines()[-1].split()]
    assert last == [0.2, 1.0 / 3.0, -1e-300, np.pi]

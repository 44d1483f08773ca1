"""What is kept, and what is run again and why."""

import dataclasses
import json
import os
import typing
from pathlib import Path

import numpy as np
import pytest

from tests.conftest import Tiny
from tests.support.fabricated import record
from vv.ask import Cost, Displacement, Ledger, Model, Observable, Run, Status, Velocity
from vv.base.files import write_whole
from vv.records.finding import Bit
from vv.records.job_record import RunSummary
from vv.scene import Term
from vv.store.run_arrays import OBSERVABLES
from vv.store.store import Store

SELECTION = ("run", "fall:up", "--codes", "fake/good")


def runs(tiny: Tiny, *words: str) -> int:
    """How many asks the code really answered during an invocation."""
    log = tiny.root / "log"
    log.write_text("")
    done = tiny.vv(*(words or SELECTION), FAKE_LOG=str(log))
    assert done.returncode in (0, Bit.ACCURACY), done.stderr  # wrong results are kept as well
    return len(log.read_text().splitlines())


def test_every_kind_of_observable_can_be_kept() -> None:
    assert set(OBSERVABLES.values()) == set(typing.get_args(Observable))


def test_what_all_workers_need_is_loaded_once(tiny: Tiny) -> None:
    tiny.edit(
        "adapters/fake.py",
        'return Found(True, version="1.0")',
        'return Found(True, version="1.0", load=lambda: print("loaded"))',
    )
    words = ("run", "fall:up", "--codes", "fake/good,fake/first-order")
    assert tiny.vv(*words).stdout.count("loaded") == 1
    assert "loaded" not in tiny.vv(*words).stdout


def test_a_second_call_answers_from_the_store(tiny: Tiny) -> None:
    assert runs(tiny) == 3
    assert runs(tiny) == 0
    assert runs(tiny, *SELECTION, "--fresh") == 3


def test_editing_the_code_runs_it_again(tiny: Tiny) -> None:
    runs(tiny)
    tiny.edit("adapters/fake.py", "FACTOR = 1.0", "FACTOR = 1.0 + 1e-9")
    assert runs(tiny) == 3


@pytest.mark.parametrize(
    ("file", "old", "new", "verdict"),
    [
        ("cases/fall.py", "Tolerance(1e-3", "Tolerance(1e-2", "pass"),
        ("reference_solutions/fall.py", "g * t**2 / 2", "g * t**2 / 3", "fail"),
    ],
)
def test_editing_a_tolerance_or_a_reference_judges_again_and_runs_nothing(
    tiny: Tiny, file: str, old: str, new: str, verdict: str
) -> None:
    runs(tiny)
    tiny.edit(file, old, new)
    assert runs(tiny, *SELECTION, "--json", "out.json") == 0
    records = json.loads((tiny.root / "out.json").read_text())["records"]
    assert {r["quantities"][0]["verdict"] for r in records} == {verdict}


def test_changing_a_parameter_runs_again_and_is_marked(tiny: Tiny) -> None:
    runs(tiny)
    assert runs(tiny, *SELECTION, "--set", "speed=5.5", "--json", "out.json") == 3
    records = json.loads((tiny.root / "out.json").read_text())["records"]
    assert {(r["modified"], r["parameters"]["speed"]) for r in records} == {(True, 5.5)}


def test_each_scheme_has_runs_of_its_own(tiny: Tiny) -> None:
    runs(tiny)
    assert runs(tiny, "run", "fall:up", "--codes", "fake/coarse") == 3


def test_what_is_stored_of_a_code_does_not_stand_in_for_it_once_it_is_gone(tiny: Tiny) -> None:
    tiny.edit("adapters/fake.py", "Found(True", 'Found("FAKE_GONE" not in os.environ')
    words = ("run", "fall:up", "--codes", "fake/good", "--require", "fake")
    assert tiny.vv(*words).returncode == 0
    gone = tiny.vv(*words, FAKE_GONE="1")
    assert (gone.returncode, "not installed" in gone.stdout) == (Bit.INCOMPLETE, True)


def test_a_code_is_not_asked_whether_it_refuses_what_stands_until_it_is_edited(tiny: Tiny) -> None:
    said = 'print("?", file=open(os.environ["FAKE_LOG"], "a"))'
    tiny.edit("adapters/fake.py", 'return "it does', f'{said}\n        return "it does')
    words = ("run", "fall:up", "--codes", "fake/good,fake/refuses")
    assert runs(tiny, *words) == 3 + 3 + 3  # asked for each rung of both, and run for one
    tiny.edit("cases/fall.py", "the tiny project says so", "it says so still")
    assert runs(tiny, *words) == 3
    tiny.edit("adapters/fake.py", 'if scheme == "refuses"', 'if scheme == "good"')
    assert "3 pass, 3 not supported" in tiny.vv(*words, FAKE_LOG=os.devnull).stdout


def test_a_failure_is_never_kept(tiny: Tiny) -> None:
    log = tiny.root / "log"
    for _ in range(2):
        tiny.vv("run", "fall:up", "--codes", "fake/raises", "--rung", "dt=0.1", FAKE_LOG=str(log))
    assert len(log.read_text().splitlines()) == 2


@pytest.mark.parametrize("status", Status)
def test_only_a_run_that_reached_its_end_is_stored(status: Status, tmp_path: Path) -> None:
    store, key = Store(tmp_path), "ab" * 32
    store.keep_run(key, Run(status, "" if status is Status.RAN else "a reason"))
    assert store.has_run(key) is (status is Status.RAN)


def test_timing_repeats_its_solves_alone_and_once(tiny: Tiny) -> None:
    log = tiny.root / "log"
    words = ("run", "--all", "--codes", "fake/good", "--json", "out.json")
    tiny.vv(*words, FAKE_LOG=str(log))
    timed = [line for line in log.read_text().splitlines() if not line.endswith(" 0.0")]
    visits = len(timed) / 4  # of two variants at two timed rungs
    assert visits in (1, 2)  # two if the machine was slower beside one of them
    records = json.loads((tiny.root / "out.json").read_text())["records"]
    kinds = [(r["rung"]["dt"], r["cost"]["kind"]) for r in records if r["variant"] == "up"]
    assert kinds == [(0.1, "timed"), (0.05, "timed"), (0.025, "indicative")]
    assert len({r["cost"]["session"] for r in records if r["cost"]["kind"] == "timed"}) == 1
    tiny.vv(*words, FAKE_LOG=str(log))
    again = [line for line in log.read_text().splitlines() if not line.endswith(" 0.0")]
    assert again == timed


def test_a_run_comes_back_as_it_was_kept(tmp_path: Path) -> None:
    run = Run(
        Status.RAN,
        times=np.array([0.0, 0.1]),
        values={Displacement(1): np.eye(3)[:2], Velocity(0): np.ones((2, 3))},
        cost=Cost(setup=0.5, repeats=3),
        steps=7,
        model=Model(1, frozenset({Term.DRAG}), "a note"),
        ledger=Ledger({"kinetic": 2.0}, 1e-16, 3.0, None),
    )
    store = Store(tmp_path)
    store.keep_run("ab12", run)
    again = store.run("ab12")
    assert again is not None
    assert (again.cost, again.steps, again.model, again.ledger) == (
        run.cost,
        run.steps,
        run.model,
        run.ledger,
    )
    assert list(again.values) == list(run.values)
    assert all(np.array_equal(again.values[o], run.values[o]) for o in run.values)


def test_what_a_record_says_of_a_run_comes_back_as_it_was_kept(tmp_path: Path) -> None:
    whole = record("dem/default", "T1", 1e-3)
    names = [field.name for field in dataclasses.fields(RunSummary)]
    said = RunSummary(**{name: getattr(whole, name) for name in names})
    store = Store(tmp_path)
    assert store.summary("ab12") is None
    store.keep_summary("ab12", said, {})
    assert store.summary("ab12") == said


def test_a_damaged_file_counts_as_absent(tmp_path: Path) -> None:
    store = Store(tmp_path)
    store.keep_run("ab12", Run(Status.RAN, times=np.zeros(1)))
    path = next(tmp_path.rglob("*.npz"))
    path.write_bytes(path.read_bytes()[:50])
    assert store.run("ab12") is None


def test_a_failed_write_leaves_the_old_file_and_nothing_else(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target = tmp_path / "file"
    write_whole(target, b"old")

    def fails(*_: object) -> None:
        raise OSError("disk full")

    monkeypatch.setattr(os, "replace", fails)
    with pytest.raises(OSError, match="disk full"):
        write_whole(target, b"new")
    assert [(p.name, p.read_bytes()) for p in tmp_path.iterdir()] == [("file", b"old")]


def test_a_full_disk_is_told_with_the_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "chmod", fails)
    with pytest.raises(OSError, match="No space left on device") as told:
        write_whole(tmp_path / "file", b"new")
    assert told.value.filename == str(tmp_path / "file")

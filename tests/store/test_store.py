"""What is kept, what is run again and why, and what survives a kill."""

import copy
import functools
import json
import os
import shutil
import signal
import subprocess
import sys
import time
import typing
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.conftest import Tiny
from tests.support.fabricated import manifest, record
from vv.ask import Cost, Displacement, Ledger, Model, Observable, Run, Status, Velocity
from vv.base.files import write_whole
from vv.insight.history import history
from vv.records import codec
from vv.records.finding import Bit
from vv.records.job_record import Record
from vv.scene import Term
from vv.store.store import OBSERVABLES, Store

SELECTION = ("run", "fall:up", "--codes", "fake/good")


def runs(tiny: Tiny, *words: str) -> int:
    """How many asks the code really answered during an invocation."""
    log = tiny.root / "log"
    log.write_text("")
    done = tiny.vv(*(words or SELECTION), FAKE_LOG=str(log))
    assert done.returncode == 0, done.stderr
    return len(log.read_text().splitlines())


def test_every_kind_of_observable_can_be_kept() -> None:
    assert set(OBSERVABLES.values()) == set(typing.get_args(Observable))


def jobs(*cases: str) -> list[Record]:
    """A record of each of these cases, which number tells apart."""
    return [record("dem/default", "T1", 1e-3, case=case, steps=n) for n, case in enumerate(cases)]


def test_a_past_run_can_be_read_in_part(tmp_path: Path) -> None:
    store, records = Store(tmp_path), jobs("b", "b", "a")
    kept = manifest(*records, name="01")
    store.keep_manifest(kept)
    assert store.manifest("01") == kept
    assert store.head("01") == (("b", "a"), kept.provenance)
    assert store.records_of("01", "b") == tuple(records[:2])
    assert store.records_of("01", "c") == ()


def test_a_damaged_manifest_fails_where_it_is_damaged_only(tmp_path: Path) -> None:
    store, path = Store(tmp_path), tmp_path / "manifests" / "01.json"
    records = jobs("b", "a")
    store.keep_manifest(manifest(*records, name="01"))
    path.write_text(path.read_text().replace('"steps": 1', '"steps": 7'))
    assert store.records_of("01", "b") == (records[0],)
    with pytest.raises(OSError, match="what it holds is not what was kept: the digest differs"):
        store.manifest("01")
    with pytest.raises(OSError, match="the records of a is not what was kept"):
        store.records_of("01", "a")
    path.write_text('{"provenance": {}, "records": []}')
    for read in (store.manifest, store.head):
        with pytest.raises(OSError, match="its first line has no seal: it is of an older form"):
            read("01")


def test_what_is_damaged_is_passed_over_with_a_word(tmp_path: Path) -> None:
    store = Store(tmp_path)
    said: list[str] = []
    for name in ("01", "02"):
        store.keep_manifest(manifest(*jobs("a"), name=name))
    path = tmp_path / "manifests" / "01.json"
    path.write_text(path.read_text().replace('"solve_cpu": 0.0001', '"solve_cpu": 0.0002'))
    assert [one.name for one in store.newest(5, said.append)] == ["02"]
    assert said == [
        "past run 01: no whole manifest: what it holds is not what was kept: the digest differs; "
        "passed over"
    ]
    assert history(store, "a", said.append)[0].name.startswith("c0ffee")
    assert len(said) == 1  # another run of the same commit was whole, and came first
    path.with_name("02.json").unlink()
    assert history(store, "a", said.append) == []
    assert "the records of a" in said[1]
    assert store.latest() is None


def test_the_latest_run_is_no_copy_and_none_of_the_future(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    store, folder = Store(tmp_path), tmp_path / "manifests"
    true, future = "20260101T000000.000000Z-1", "20990101T000000.000000Z-1"
    store.keep_manifest(manifest(*jobs("a"), name=true))
    store.keep_manifest(manifest(*jobs("b"), name=future))
    copy = "20260201T000000.000000Z-1"
    (folder / f"{copy}.json").write_bytes((folder / f"{true}.json").read_bytes())
    latest = store.latest()
    assert latest is not None
    assert latest.name == true
    said = capsys.readouterr().err
    assert f"past run {future}: its time has not come; passed over" in said
    assert f"past run {copy}: no whole manifest: its first line is not what was kept" in said


HOSTILE: tuple[object, ...] = (
    None, "", 10**400, 1e300, -1, ["x"], {"x": 1}, "<script>alert(1)</script>", "\x1b[31m\x00",
    "no-such-word", json.loads("[" * 200 + "]" * 200),
)  # fmt: skip


def test_no_field_of_a_manifest_can_break_what_reads_it(tmp_path: Path) -> None:
    """Sealed anew each time, as by somebody who means harm: it is whole, or named as damaged."""
    made = manifest(*jobs("a"), name="01")
    data = codec.to_data(made)
    texts = []
    for place in places(data):
        for value in HOSTILE:
            changed = copy.deepcopy(data)
            functools.reduce(lambda part, step: part[step], place[:-1], changed)[place[-1]] = value
            texts.append(changed)
    assert len(texts) > 300
    for changed in texts:
        try:
            found = codec.read(type(made), codec.parse(json.dumps(changed)), "manifest")
        except ValueError:
            continue
        assert codec.parse(codec.render(found)) is not None
    with pytest.raises(ValueError, match="nested"):
        codec.parse("[" * 100_000 + "]" * 100_000)
    for number in ("1e999", "-1e999", "NaN", "9" * 400):
        with pytest.raises(ValueError, match=r"finite|whole"):
            codec.read(tuple[float, ...], codec.parse(f"[{number}]"), "numbers")


def places(data: object, above: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The ways to all that is in plain data."""
    parts = data.items() if isinstance(data, dict) else enumerate(data)  # type: ignore[arg-type]
    for step, part in parts:
        yield (*above, step)
        if isinstance(part, dict | list):
            yield from places(part, (*above, step))


@pytest.mark.parametrize("layer", ["records", "runs", "timings", "answers"])
def test_every_damaged_file_is_named_and_its_job_run_again(tiny: Tiny, layer: str) -> None:
    words = ("run", "--all", "--codes", "fake/good", "--json", "out.json")
    assert tiny.vv(*words).returncode == 0
    told = (tiny.root / "out.json").read_text()
    damaged = [
        *(tiny.root / ".vv" / layer).rglob("*.json"),
        *(tiny.root / ".vv" / layer).rglob("*.npz"),
    ]
    assert damaged
    if layer == "runs":  # which nobody reads as long as there are records
        shutil.rmtree(tiny.root / ".vv" / "records")
    if layer == "timings":  # which nobody reads as long as the invocation stands
        shutil.rmtree(tiny.root / ".vv" / "answers")
    for path in damaged:
        content = bytearray(path.read_bytes())
        content[len(content) // 2] ^= 1
        path.write_bytes(content)
    done = tiny.vv(*words)
    assert done.returncode == 0, done.stderr
    lost = [path for path in damaged if f"{path}: " not in done.stderr]
    if layer == "answers":  # of which only that of this invocation is asked for, and its report's
        assert len(lost) < len(damaged)
    elif layer == "records":  # each is two files, of which the first is named
        assert len(lost) <= len(damaged) / 2
    else:
        assert not lost
    assert "the digest differs; passed over, and made again" in done.stderr
    again = json.loads((tiny.root / "out.json").read_text())["records"]
    assert [r["quantities"] for r in again] == [
        r["quantities"] for r in json.loads(told)["records"]
    ]
    assert "digest differs" not in tiny.vv(*words).stderr


def test_a_lost_series_is_made_again(tiny: Tiny) -> None:
    words = (*SELECTION, "--json", "out.json")
    tiny.vv(*words)
    told = json.loads((tiny.root / "out.json").read_text())["records"]
    next((tiny.root / ".vv" / "records").rglob("*.npz")).unlink()
    shutil.rmtree(tiny.root / ".vv" / "answers")
    tiny.vv(*words)
    again = json.loads((tiny.root / "out.json").read_text())["records"]
    assert [r["quantities"] for r in again] == [r["quantities"] for r in told]


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
    assert "3 pass, 3 refused" in tiny.vv(*words, FAKE_LOG=os.devnull).stdout


def test_a_failure_is_never_kept(tiny: Tiny) -> None:
    log = tiny.root / "log"
    for _ in range(2):
        tiny.vv("run", "fall:up", "--codes", "fake/raises", "--rung", "dt=0.1", FAKE_LOG=str(log))
    assert len(log.read_text().splitlines()) == 2


def test_timing_repeats_its_solves_alone_and_once(tiny: Tiny) -> None:
    log = tiny.root / "log"
    words = ("run", "--all", "--codes", "fake/good", "--json", "out.json")
    tiny.vv(*words, FAKE_LOG=str(log))
    timed = [line for line in log.read_text().splitlines() if not line.endswith(" 0.0")]
    assert len(timed) == 8  # two variants, two timed rungs, two rounds
    records = json.loads((tiny.root / "out.json").read_text())["records"]
    kinds = [(r["rung"]["dt"], r["cost"]["kind"]) for r in records if r["variant"] == "up"]
    assert kinds == [(0.1, "timed"), (0.05, "timed"), (0.025, "indicative")]
    assert len({r["cost"]["session"] for r in records if r["cost"]["kind"] == "timed"}) == 1
    tiny.vv(*words, FAKE_LOG=str(log))
    assert sum(1 for line in log.read_text().splitlines() if not line.endswith(" 0.0")) == 8


def test_two_invocations_at_once_do_not_disturb_each_other(tiny: Tiny) -> None:
    words = [sys.executable, "-m", "vv", "run", "fall", "--codes", "fake/good"]
    both = [
        subprocess.Popen([*words, "--json", f"{i}.json"], cwd=tiny.root, stdout=subprocess.DEVNULL)
        for i in range(2)
    ]
    assert [process.wait(30) for process in both] == [0, 0]
    first, second = (json.loads((tiny.root / f"{i}.json").read_text())["records"] for i in range(2))
    assert [r["quantities"] for r in first] == [r["quantities"] for r in second]
    assert len(list((tiny.root / ".vv" / "manifests").iterdir())) == 2


def test_a_killed_invocation_leaves_its_finished_results_usable(tiny: Tiny) -> None:
    log = tiny.root / "log"
    tiny.edit("adapters/fake.py", 'if scheme == "hangs":', "if ask.knobs.dt == 0.025:")
    process = subprocess.Popen(
        [sys.executable, "-m", "vv", *SELECTION],
        cwd=tiny.root,
        env={**os.environ, "FAKE_LOG": str(log)},
    )
    _wait_until(lambda: log.exists() and len(log.read_text().splitlines()) >= 3)
    kept = tiny.root / ".vv" / "runs"
    _wait_until(lambda: len(list(kept.rglob("*.npz"))) >= 2)  # the third ask hangs
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert not list((tiny.root / ".vv").rglob(".part-*"))
    words = ("run", "fall:up", "--codes", "fake/good", "--rung", "dt=0.1", "--rung", "dt=0.05")
    assert runs(tiny, *words) == 0


def test_a_worker_does_not_outlive_a_killed_invocation(tiny: Tiny) -> None:
    marker = f"fall:up --codes fake/hangs --timeout {50 + os.getpid() % 7}.25"
    process = subprocess.Popen([sys.executable, "-m", "vv", "run", *marker.split()], cwd=tiny.root)
    _wait_until(lambda: len(_processes(marker)) >= 2)
    process.send_signal(signal.SIGKILL)
    process.wait()
    _wait_until(lambda: not _processes(marker))


def test_terminating_an_invocation_ends_a_worker_that_hears_nothing(tiny: Tiny) -> None:
    """As one in a kernel, during which Python handles no signals."""
    tiny.edit(
        "adapters/fake.py", "time.sleep(60)", "__import__('signal').signal(15, 1); time.sleep(60)"
    )
    marker = f"fall:up --codes fake/hangs --timeout {60 + os.getpid() % 7}.25"
    process = subprocess.Popen(
        [sys.executable, "-m", "vv", "run", *marker.split()], cwd=tiny.root, stderr=subprocess.PIPE
    )
    _wait_until(lambda: len(_processes(marker)) >= 2)
    time.sleep(1.0)  # for the worker to go deaf
    process.send_signal(signal.SIGTERM)
    _, said = process.communicate(timeout=20)
    assert (process.returncode, said) == (130, b"vv: interrupted; what has finished is kept\n")
    _wait_until(lambda: not _processes(marker))


BORN_AN_ORPHAN = """
import multiprocessing, os, time
from vv.run import runner

def child(parent):
    os.setpgid(0, 0)
    while os.getppid() == parent:
        time.sleep(0.001)
    runner._die_with_parent()
    print("alive", flush=True)

multiprocessing.get_context("fork").Process(target=child, args=(os.getpid(),)).start()
os._exit(0)
"""


def test_a_worker_whose_parent_is_gone_before_it_could_ask_dies_too() -> None:
    words = [sys.executable, "-c", BORN_AN_ORPHAN]
    done = subprocess.run(words, stdout=subprocess.PIPE, timeout=20, check=True)
    assert done.stdout == b""


def _wait_until(true: Callable[[], bool]) -> None:
    """Wait for a condition, 20 s at most."""
    until = time.monotonic() + 20
    while not true():
        assert time.monotonic() < until, "it did not come about"
        time.sleep(0.01)


def _processes(marker: str) -> list[int]:
    """Processes whose command line ends in the marker."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            command = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode().strip()
            state = (folder / "stat").read_text().rpartition(")")[2].split()[0]
        except OSError:
            continue
        if command.endswith(marker) and state != "Z":
            found.append(int(folder.name))
    return found


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

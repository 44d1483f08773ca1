"""Parts of the store by hand: records by their differences, arrays, scratch, names, digests."""

from __future__ import annotations

import io
import json
import os
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support.acceptances import ran
from tests.support.fabricated import changed, manifest
from vv.ask import (
    Cost,
    Displacement,
    Ledger,
    Model,
    Observable,
    Run,
    Status,
    Velocity,
)
from vv.records import codec
from vv.scene import Form, Term
from vv.store import array_files, provenance, record_list, run_arrays
from vv.store.manifests import DAY
from vv.store.store import STALE, Store


def test_a_record_is_written_by_what_it_has_other_than_the_one_before() -> None:
    first = ran()
    records = [first, changed(first, variant="T2"), changed(first, variant="T2", steps=7), first]
    _, second, third, fourth = json.loads(record_list.render(records))
    assert second == {"variant": "T2"}
    assert third == {"steps": 7}
    assert fourth == {"variant": "T1", "steps": first.steps}
    assert record_list.read(codec.parse(record_list.render(records)), "records") == tuple(records)


@pytest.mark.parametrize(
    ("one", "other", "alike"),
    [
        ("a", "a", True),
        ("a", "b", False),
        (1.0, 1.0, True),
        (1, 1.0, False),
        (0.0, -0.0, False),
        ({"a": 1}, {"a": 1}, True),
        ({"a": 1}, {"a": 1.0}, False),
        (None, None, True),
        (1, 2, False),
    ],
)
def test_values_are_alike_that_are_written_alike(one: object, other: object, alike: bool) -> None:
    assert record_list._alike(one, other) is alike


@pytest.mark.parametrize(
    "array",
    [
        np.arange(6.0).reshape(2, 3),
        np.asfortranarray(np.arange(6.0).reshape(2, 3)),
        np.zeros(0),
        np.array(3.5),
        np.arange(4, dtype=np.int32),
    ],
    ids=["rows", "columns", "none", "one", "whole"],
)
@pytest.mark.parametrize("version", [(1, 0), (2, 0)])
def test_arrays_are_read_as_numpy_reads_them(array: Any, version: tuple[int, int]) -> None:
    file = io.BytesIO()
    np.lib.format.write_array(file, array, version=version)
    found = array_files._array(file.getvalue())
    assert found.dtype == array.dtype
    assert found.shape == array.shape
    assert (found == array).all()


def test_scratch_goes_after_a_week(tmp_path: Path) -> None:
    store = Store(tmp_path)
    assert STALE == 7 * 24 * 3600
    young, old = store.scratch(), store.scratch()
    for folder, age in ((young, 6.9 * DAY), (old, 7.1 * DAY)):
        then = time.time() - age
        os.utime(folder, (then, then))
    store.clear_scratch()
    assert (young.exists(), old.exists()) == (True, False)


def test_the_state_of_the_store_shows_a_change_that_keeps_size_and_time(tmp_path: Path) -> None:
    store, file = Store(tmp_path), tmp_path / "records" / "aa" / "one.json"
    file.parent.mkdir(parents=True)
    states = []
    for text in ("1", "2"):
        file.write_text(text)
        os.utime(file, (0, 0))  # the time of its content can be set back, that of its inode not
        states.append(store.state())
        assert store.state() == states[-1]
        time.sleep(0.02)
    assert states[0] != states[1]


def test_the_last_timing_session_is_that_which_was_written_last(tmp_path: Path) -> None:
    store = Store(tmp_path)
    assert store.last_session() == ""
    for second, name in enumerate(("bb", "cc", "aa")):
        store.keep_timings(name, {})
        os.utime(tmp_path / "timings" / name / f"{name}.json", (0, second))
        assert store.last_session() == name


def test_of_many_past_runs_the_newest_are_read_newest_first(tmp_path: Path) -> None:
    past, told = Store(tmp_path).manifests, list[str]()
    for day in ("03", "01", "04", "02"):
        past.keep(manifest(ran(), name=f"202501{day}"))

    def newest(most: int) -> list[str]:
        return [one.name for one in past.newest(most, told.append)]

    assert newest(2) == ["20250104", "20250103"]
    assert newest(9) == ["20250104", "20250103", "20250102", "20250101"]
    assert told == []
    past.file("20250104").write_text("{")
    assert newest(2) == ["20250103"]  # the damaged one is told of, and counts
    assert ["20250104" in text for text in told] == [True]
    latest = past.latest()
    assert latest is not None
    assert latest.name == "20250103"


@pytest.mark.parametrize(("ahead", "known"), [(0.9, True), (1.1, False)])
def test_a_past_run_whose_name_lies_more_than_a_day_ahead_is_none(
    tmp_path: Path, ahead: float, known: bool
) -> None:
    assert DAY == 24 * 3600
    name = time.strftime("%Y%m%dT%H%M%S", time.gmtime(time.time() + ahead * DAY))
    (tmp_path / "manifests").mkdir()
    for one in ("20250101T000000", name):
        (tmp_path / "manifests" / f"{one}.json").write_text("")
    assert (name in Store(tmp_path).manifests.names()) is known
    assert Store(tmp_path).manifests.names()[0] == "20250101T000000"


def test_a_file_is_read_again_only_when_it_changes(tmp_path: Path) -> None:
    file, memory = tmp_path / "program", tmp_path / "digests.json"
    file.write_text("one")
    first = provenance.file_digests([file], memory)
    then = memory.stat().st_mtime_ns
    assert provenance.file_digests([file], memory) == first
    assert memory.stat().st_mtime_ns == then
    file.write_text("other")
    assert provenance.file_digests([file], memory) != first


def test_a_run_comes_back_from_the_store_in_all_its_parts(tmp_path: Path) -> None:
    t, way = np.array([0.0, 0.5, 1.0]), np.arange(9.0).reshape(3, 3)
    values: dict[Observable, Any] = {
        Displacement(2): way,
        Velocity(0): -way,
        Displacement(0): 2 * way,
    }
    ledger = Ledger({"kinetic": 3.0}, 0.25, 4.0, 0.5, {"Coulomb": (0.1, 0.2)})
    run = Run(
        Status.RAN, "as told", t, values, Cost(1.0, 2.0, 3.0, 4.0, 5.0, 6, 0.5, True), 7,
        Model(8, frozenset({Term.GRAVITY, Term.DRAG}), "a note"), ledger,
        {Form.KINETIC: 3 * t, Form.DRAG: 4 * t}, np.array([[1.0, 2.0], [3.0, np.inf]]),
    )  # fmt: skip
    Store(tmp_path).keep_run("aa", run)
    found = Store(tmp_path).run("aa")
    assert found is not None
    for name in ("status", "reason", "cost", "steps", "model", "ledger"):
        assert getattr(found, name) == getattr(run, name)
    assert found.times.tolist() == t.tolist()
    assert found.tried.tolist() == run.tried.tolist()
    assert [*found.values] == [*values]
    for asked, array in values.items():
        assert found.values[asked].tolist() == array.tolist()
    assert {form: array.tolist() for form, array in found.energies.items()} == {
        form: array.tolist() for form, array in run.energies.items()
    }


def test_what_is_no_number_is_no_part_of_a_run() -> None:
    arrays = run_arrays.arrays_of(Run(Status.RAN, times=np.zeros(1)), "aa")
    assert run_arrays.run_from(arrays, "aa").status is Status.RAN
    with pytest.raises(ValueError, match="t holds no numbers"):
        run_arrays.run_from({**arrays, "t": np.array(["0"])}, "aa")
    with pytest.raises(ValueError, match="it is of the key aa"):
        run_arrays.run_from(arrays, "bb")

"""Claims about programs asked twice in one folder, or one process: no answer is an earlier one."""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from tests.support.adapters.live_asks import COARSE, TRIALS
from tests.support.installed import require
from vv.ask import Ask, Run, Status
from vv.base.processes import end_children
from vv.codes import Adapter, external
from vv.codes.external import Process
from vv.plan.project import find

DROP, SLIDE = (TRIALS[name].study.ask(COARSE) for name in ("T1", "T3"))
PROGRAMS = ("yade", "liggghts", "kratos")


@pytest.fixture(params=PROGRAMS)
def code(request: pytest.FixtureRequest) -> Adapter:
    """A code that runs as a program and knows spheres."""
    adapter = find().load_adapter(request.param)
    require(adapter)
    return adapter


def answered(adapter: Adapter, asks: Sequence[Ask], folder: Path, repeat: float = 0.0) -> list[Run]:
    """The runs of asks in a folder that may have been used before."""
    folder.mkdir(exist_ok=True)
    return list(adapter.run(asks, "default", folder, repeat))


def assert_same(one: Run, other: Run) -> None:
    """Two runs ran, and their values agree in every bit."""
    assert (one.status, one.reason, other.status) == (Status.RAN, "", Status.RAN)
    assert one.values.keys() == other.values.keys()
    assert all(np.array_equal(one.values[each], other.values[each]) for each in one.values)


def test_a_folder_used_before_gives_the_answer_of_an_empty_one(
    code: Adapter, tmp_path: Path
) -> None:
    answered(code, [DROP], tmp_path / "used")
    (seen,) = answered(code, [SLIDE], tmp_path / "used")
    (due,) = answered(code, [SLIDE], tmp_path / "empty")
    assert_same(seen, due)


def test_a_program_that_dies_in_a_folder_used_before_gives_no_answer(
    code: Adapter, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def started(command: Sequence[str], folder: Path, *more: object, **named: object) -> Process:
        return start(["sh", "-c", "exit 7"], folder)

    assert [run.status for run in answered(code, [DROP], tmp_path)] == [Status.RAN]
    start = external.start
    monkeypatch.setattr(external, "start", started)
    for repeat in (0.0, 1e-3):
        (run,) = answered(code, [DROP], tmp_path, repeat)
        assert (run.status, run.values) == (Status.ERROR, {})
        assert "exit code 7" in run.reason


def test_scenes_before_it_in_the_same_process_change_no_bit_of_an_answer(
    code: Adapter, tmp_path: Path
) -> None:
    (due,) = answered(code, [SLIDE], tmp_path)
    waiting = code.found().may_wait or contextlib.nullcontext
    with waiting():
        first, second = answered(code, [DROP, SLIDE], tmp_path)
        (later,) = answered(code, [SLIDE], tmp_path)
    end_children()
    assert first.status is Status.RAN
    assert_same(second, due)
    assert_same(later, due)

"""Claims about a worker process: it answers, keeps to a core, and ends with its parent."""

from __future__ import annotations

import dataclasses
import os
import signal
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.run.test_runner import Deadly, batch
from vv.ask import Run, Status
from vv.run import process
from vv.run.runner import run_batches


class Pipe:
    """What a worker has said."""

    def __init__(self) -> None:
        self.sent: list[Run] = []

    def send(self, run: Run) -> None:
        """Note it."""
        self.sent.append(run)


class Raising(Deadly):
    """A code that raises an error instead of answering one ask, or after the last."""

    def run(self, asks: Sequence[Any], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """One Run for each ask, as far as it comes."""
        for ask in asks:
            if ask.number == self.dies:
                raise ValueError("no more")
            yield Run(Status.RAN, str(ask.number))
        if self.dies == len(asks):
            raise ValueError("too late")


@pytest.mark.parametrize(
    ("at", "ran", "failed", "goes_on"), [(9, 3, 0, True), (1, 1, 1, False), (3, 3, 0, False)]
)
def test_an_error_of_an_adapter_fails_the_ask_in_flight_if_there_is_one_and_ends_the_worker(
    at: int, ran: int, failed: int, goes_on: bool, tmp_path: Path
) -> None:
    pipe: Any = Pipe()
    assert process._answered(batch(Raising(at, -1), range(3)), pipe, tmp_path) is goes_on
    told = [run.status for run in pipe.sent]
    assert told == [Status.RAN] * ran + [Status.ERROR] * failed
    assert all("ValueError: no more (test_process.py:" in run.reason for run in pipe.sent[ran:])


@pytest.mark.parametrize(("repeat", "cores"), [(0.0, {3, 5, 7}), (0.5, {7})])
def test_what_is_timed_keeps_to_one_core(
    repeat: float, cores: set[int], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept = {3, 5, 7}

    def keep(_: int, chosen: set[int]) -> None:
        kept.clear()
        kept.update(chosen)

    monkeypatch.setattr("vv.run.process.os.sched_getaffinity", lambda _: kept)
    monkeypatch.setattr("vv.run.process.os.sched_setaffinity", keep)
    for name in ("setpgid", "dup2"):
        monkeypatch.setattr(f"vv.run.process.os.{name}", lambda *_: None)
    for name in ("die_with_parent", "adopt_orphans", "end_children"):
        monkeypatch.setattr(process, name, lambda: None)
    pipe: Any = Pipe()
    orders: Any = None
    one = dataclasses.replace(batch(Deadly(-1, -1), range(2)), repeat=repeat)
    process.work((one,), orders, pipe, tmp_path)
    assert kept == cores
    assert [run.reason for run in pipe.sent] == ["0", "1"]


@pytest.mark.parametrize(
    ("parent", "above", "ends"), [(None, 7, False), (7, 7, False), (7, 1, True)]
)
def test_a_worker_whose_parent_was_gone_before_it_could_be_told_ends(
    parent: int | None, above: int, ends: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    ended: list[bool] = []
    known = None if parent is None else SimpleNamespace(pid=parent)
    monkeypatch.setattr("vv.run.process.multiprocessing.parent_process", lambda: known)
    monkeypatch.setattr("vv.run.process.os.getppid", lambda: above)
    monkeypatch.setattr("vv.run.process.signal.signal", lambda *_: None)
    monkeypatch.setattr("vv.run.process.ctypes.CDLL", lambda _: SimpleNamespace(prctl=lambda *_: 0))
    monkeypatch.setattr(process, "_end_all", lambda: ended.append(True))
    process.die_with_parent()
    assert bool(ended) is ends


class Killed(Deadly):
    """A code that is ended by a real-time signal, which has no name."""

    def run(self, asks: Sequence[Any], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """Nothing."""
        os.kill(os.getpid(), signal.SIGRTMIN + 6)
        yield from ()


def test_a_worker_that_a_signal_without_a_name_ended_is_told_by_its_number(tmp_path: Path) -> None:
    ((_, run),) = run_batches([batch(Killed(-1, -1), range(1))], 1, 30.0, lambda: tmp_path)
    assert run.reason.startswith(f"the worker was killed by {signal.SIGRTMIN + 6}; see ")

"""What a worker leaves behind when it dies or hangs: the ask in flight fails, and no other."""

from __future__ import annotations

import dataclasses
import os
import time
from collections import deque
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from vv.ask import Knobs, Run, Status
from vv.codes import Found
from vv.codes.reused_program import ReusedProgram
from vv.run import runner
from vv.run.process import Batch
from vv.run.runner import _Worker, run_batches


class Deadly:
    """A code that answers with the number of an ask, but dies at one and hangs at another."""

    def __init__(self, dies: int, hangs: int, takes: float = 0.0) -> None:
        self.dies, self.hangs, self.takes = dies, hangs, takes

    def found(self) -> Found:
        """It is always there."""
        return Found(True)

    def run(self, asks: Sequence[Any], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """One Run for each ask, as far as it comes."""
        for ask in asks:
            if ask.number == self.dies:
                os._exit(3)
            if ask.number == self.hangs:
                time.sleep(60)
            time.sleep(self.takes)
            yield Run(Status.RAN, str(ask.number))


class Telling(Deadly):
    """A code that answers with the process that it runs in."""

    def run(self, asks: Sequence[Any], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """One Run for each ask, as far as it comes."""
        for one in super().run(asks, scheme, scratch, repeat):
            yield dataclasses.replace(one, reason=str(os.getpid()))


class Starting(Deadly):
    """A code that answers with whether its program may wait for more."""

    def __init__(self) -> None:
        super().__init__(-1, -1)
        self.program = ReusedProgram()

    def found(self) -> Found:
        """Its program may wait where it is let."""
        return Found(True, may_wait=self.program.may_wait)

    def run(self, asks: Sequence[Any], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """One Run for each ask."""
        for one in super().run(asks, scheme, scratch, repeat):
            yield dataclasses.replace(one, reason=str(self.program._may_wait))


def batch(code: Any, numbers: range, stays: bool = False) -> Batch:
    """Asks that have no more than a number."""
    asks: list[Any] = [
        SimpleNamespace(search=None, knobs=Knobs(), number=number) for number in numbers
    ]
    return Batch(code, "default", tuple(numbers), tuple(asks), stays=stays)


@pytest.mark.parametrize("at", [0, 1, 3])
def test_one_that_dies_costs_its_own_ask_alone(at: int, tmp_path: Path) -> None:
    folders = iter(range(100))

    def scratch() -> Path:
        (folder := tmp_path / str(next(folders))).mkdir()
        return folder

    found = dict(run_batches([batch(Deadly(at, -1), range(4))], 1, 30.0, scratch))
    assert found.keys() == set(range(4))
    assert found.pop(at).reason.startswith("the worker ended early with exit code 3")
    assert {number: run.reason for number, run in found.items()} == {n: str(n) for n in found}


def test_one_that_hangs_is_late_and_what_follows_it_is_answered(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("vv.run.runner.GRACE", 0.5)
    found = dict(run_batches([batch(Deadly(-1, 1), range(4))], 1, 0.5, lambda: tmp_path))
    assert [found[n].status for n in range(4)] == [
        Status.RAN, Status.TIMEOUT, Status.RAN, Status.RAN,
    ]  # fmt: skip
    assert "--timeout 0.5 s" in found[1].reason


def test_each_ask_has_its_own_time(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Four that take 0.8 s each, of which none takes 2 s."""
    monkeypatch.setattr("vv.run.runner.GRACE", 0.0)
    found = dict(run_batches([batch(Deadly(-1, -1, 0.8), range(4))], 1, 2.0, lambda: tmp_path))
    assert [found[n].status for n in range(4)] == [Status.RAN] * 4


@pytest.mark.parametrize(("stays", "processes"), [(True, 1), (False, 3)])
def test_a_worker_that_stays_answers_the_next_batches_of_its_code_and_no_other(
    stays: bool, processes: int, tmp_path: Path
) -> None:
    code, other, folders = Telling(-1, -1), Telling(-1, -1), iter(range(9))

    def scratch() -> Path:
        (folder := tmp_path / str(next(folders))).mkdir()
        return folder

    due = [batch(code, range(n, n + 2), stays) for n in (0, 2, 4)]
    due.append(batch(other, range(6, 8), stays))
    found = dict(run_batches(due, 1, 30.0, scratch))
    who = [found[n].reason for n in range(8)]
    assert found.keys() == set(range(8))
    assert len({*who[:6]}) == processes
    assert who[6] == who[7] not in who[:6]


def test_the_program_of_a_code_may_wait_in_a_worker_alone(tmp_path: Path) -> None:
    code = Starting()
    ((_, within),) = run_batches([batch(code, range(1))], 1, 30.0, lambda: tmp_path)
    (elsewhere,) = code.run(batch(code, range(1)).asks, "default", tmp_path, 0.0)
    assert (within.reason, elsewhere.reason) == ("True", "False")


@pytest.mark.parametrize("dies", [2, 3])
def test_one_that_dies_in_a_later_batch_of_a_worker_costs_its_own_ask_alone(
    dies: int, tmp_path: Path
) -> None:
    code, folders = Deadly(dies, -1), iter(range(9))

    def scratch() -> Path:
        (folder := tmp_path / str(next(folders))).mkdir()
        return folder

    due = [batch(code, range(n, n + 2), True) for n in (0, 2, 4)]
    found = dict(run_batches(due, 1, 30.0, scratch))
    assert found.keys() == set(range(6))
    assert "exit code 3" in found.pop(dies).reason
    assert {number: run.reason for number, run in found.items()} == {n: str(n) for n in found}


@pytest.mark.parametrize(
    ("answered", "hung_up", "stays", "known", "goes_on"),
    [
        (2, False, True, True, True),
        (1, False, True, True, False),
        (2, True, True, True, False),
        (2, False, False, True, False),
        (2, False, True, False, False),
    ],
)
def test_a_worker_goes_on_if_it_is_done_alive_and_may_stay_and_knows_what_is_next(
    answered: int, hung_up: bool, stays: bool, known: bool, goes_on: bool
) -> None:
    now, later = batch(None, range(2), stays), batch(None, range(2, 4), stays)
    orders = Orders()
    worker = made(now, (now, later) if known else (now,), orders)
    worker.answered, worker.hung_up = answered, hung_up
    waiting = deque([later])
    assert worker.goes_on_with(waiting) is goes_on
    assert orders.sent == ([1] if goes_on else [])
    assert [*waiting] == ([] if goes_on else [later])
    assert (worker.batch, worker.answered) == ((later, 0) if goes_on else (now, answered))


def test_a_worker_does_not_go_on_if_nothing_waits_or_it_is_gone() -> None:
    now, later = batch(None, range(2), True), batch(None, range(2, 4), True)
    done = made(now, (now, later), Orders())
    done.answered = 2
    assert not done.goes_on_with(deque())
    gone = made(now, (now, later), Orders(BrokenPipeError()))
    gone.answered = 2
    waiting = deque([later])
    assert not gone.goes_on_with(waiting)
    assert [*waiting] == [later]


class Orders:
    """A pipe to a worker that notes what is sent, or is broken."""

    def __init__(self, error: OSError | None = None) -> None:
        self.sent: list[int] = []
        self.error = error

    def send(self, place: int) -> None:
        """Note it."""
        if self.error is not None:
            raise self.error
        self.sent.append(place)


def made(now: Batch, known: Sequence[Batch], orders: Any) -> _Worker:
    """A worker without a process."""
    nothing: Any = None
    return _Worker(now, known, nothing, nothing, orders, Path(), 1.0, 0.0)


@pytest.mark.parametrize(
    ("left", "waits"),
    [((0.7, 0.3), 0.3), ((-2.0, 0.3), 0.0), ((1e10, 1e12), 1.0)],  # s to each deadline
)
def test_news_are_awaited_until_the_first_deadline_and_a_second_at_most(
    left: tuple[float, ...], waits: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[float] = []
    monkeypatch.setattr(runner, "wait", lambda pipes, timeout: asked.append(timeout))
    monkeypatch.setattr(time, "monotonic", lambda: 50.0)
    workers = [SimpleNamespace(deadline=50.0 + one, pipe=None) for one in left]
    runner._sleep_until_news(workers)  # type: ignore[arg-type]
    assert asked == [pytest.approx(waits)]

"""Claims about programs that wait for more, made with a small Python program in their place."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from vv.ask import Run, Status
from vv.codes import external
from vv.codes.external import Process
from vv.codes.reused_program import ReusedProgram

# answers each ask with its process, but ends at one that says `die`, and stops at `hang`
PROGRAM = """
import os, sys, time
for line in sys.stdin:
    for path in open(line.strip()).read().splitlines():
        if open(path).read() == "die":
            sys.exit(3)
        if open(path).read() == "hang":
            time.sleep(60)
        open(path + ".half", "w").write(str(os.getpid()))
        os.rename(path + ".half", path + ".answer")
"""


@pytest.fixture(params=[True, False], ids=["where it may wait", "elsewhere"])
def waits(request: pytest.FixtureRequest, program: ReusedProgram) -> Iterator[bool]:
    """Whether the program may wait."""
    with program.may_wait() if request.param else contextlib.nullcontext():
        yield bool(request.param)


def answers(program: ReusedProgram, folder: Path, *asks: str) -> Iterator[Run]:
    """Yield what it says to asks in a folder of their own."""
    folder.mkdir()
    files = [folder / f"ask-{number}" for number in range(len(asks))]
    for file, text in zip(files, asks, strict=True):
        file.write_text(text)

    def launch(indices: Sequence[int]) -> Process:
        return program.ask([sys.executable, "-c", PROGRAM], folder, {}, [files[i] for i in indices])

    def collect(index: int, started: Process) -> Run | None:
        file = Path(f"{files[index]}.answer")
        return Run(Status.RAN, file.read_text()) if file.exists() else None

    yield from external.run_batch(len(asks), launch, collect, program.dismiss)


def runs(pid: str) -> bool:
    try:
        os.kill(int(pid), 0)
    except ProcessLookupError:
        return False
    return True


def test_one_that_answered_all_waits_for_more_in_a_worker_and_ends_elsewhere(
    program: ReusedProgram, tmp_path: Path, waits: bool
) -> None:
    first = [*answers(program, tmp_path / "one", "a", "b")]
    second = [*answers(program, tmp_path / "two", "c")]
    seen = [run.reason for run in (*first, *second)]
    assert all(run.status is Status.RAN for run in (*first, *second))
    assert len(set(seen)) == (1 if waits else 2)
    assert seen[0] == seen[1]
    assert [runs(pid) for pid in sorted({*seen}, key=seen.index)] == (
        [True] if waits else [False] * 2
    )


def test_one_that_dies_fails_the_ask_in_flight_and_the_rest_run_alone(
    program: ReusedProgram, tmp_path: Path, waits: bool
) -> None:
    (before,) = answers(program, tmp_path / "one", "a")
    found = [*answers(program, tmp_path / "two", "b", "die", "c", "d")]
    assert [run.status is Status.RAN for run in found] == [True, False, True, True]
    assert "exit code 3" in found[1].reason
    assert (found[0].reason == before.reason) == waits
    assert found[2].reason != found[0].reason


def test_one_that_was_ended_while_it_waited_is_started_anew(
    program: ReusedProgram, tmp_path: Path
) -> None:
    with program.may_wait():
        (first,) = answers(program, tmp_path / "one", "a")
        os.kill(int(first.reason), signal.SIGKILL)
        time.sleep(0.05)
        (second,) = answers(program, tmp_path / "two", "b")
    assert second.status is Status.RAN
    assert second.reason != first.reason


def test_one_that_cannot_be_told_ended_early(tmp_path: Path) -> None:
    made = ReusedProgram()
    (tmp_path / "ask").write_text("a")

    def launch(indices: Sequence[int]) -> Process:
        return made.ask(
            [sys.executable, "-c", "raise SystemExit(4)"], tmp_path, {}, [tmp_path / "ask"]
        )

    (run,) = external.run_batch(1, launch, lambda index, program: None, made.dismiss)
    assert run.status is Status.ERROR
    assert "exit code 4" in run.reason


def test_one_that_is_not_awaited_to_its_end_does_not_wait(
    program: ReusedProgram, tmp_path: Path, waits: bool
) -> None:
    left = answers(program, tmp_path / "one", "a", "hang")
    first = next(left)
    left.close()  # type: ignore[attr-defined]  # it is a generator
    assert not runs(first.reason)


def test_one_waits_only_in_its_own_block(program: ReusedProgram, tmp_path: Path) -> None:
    other = ReusedProgram()
    with other.may_wait():
        (ended,) = answers(program, tmp_path / "one", "a")
    with program.may_wait():
        (waits,) = answers(program, tmp_path / "two", "a")
        (other_ended,) = answers(other, tmp_path / "three", "a")
    assert [runs(run.reason) for run in (ended, waits, other_ended)] == [False, True, False]

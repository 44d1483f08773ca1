"""Claims about a program that waits for more: its surroundings, its lists, and how it ends."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from vv.ask import Run, Status
from vv.codes import external
from vv.codes.external import Process
from vv.codes.reused_program import ReusedProgram

# answers each ask with a variable of its surroundings, and notes the end of its input
PROGRAM = """
import os, sys, time
for line in sys.stdin:
    for path in open(line.strip()).read().splitlines():
        open(path + ".half", "w").write(os.environ["GIVEN"])
        os.rename(path + ".half", path + ".answer")
time.sleep(0.5)
open("cleared", "w").close()
"""


def answers(program: ReusedProgram, folder: Path, count: int) -> Iterator[Run]:
    """Yield what it says to so many asks in a folder."""
    folder.mkdir(exist_ok=True)
    files = [folder / f"ask-{number}" for number in range(count)]

    def launch(indices: Sequence[int]) -> Process:
        given = {"GIVEN": "what it is given"}
        command = [sys.executable, "-c", PROGRAM]
        return program.ask(command, folder, given, [files[i] for i in indices])

    def collect(index: int, started: Process) -> Run | None:
        file = Path(f"{files[index]}.answer")
        return Run(Status.RAN, file.read_text()) if file.exists() else None

    yield from external.run_batch(count, launch, collect, program.dismiss)


def test_one_that_has_answered_all_finds_its_end_of_input_and_may_clear_up(
    program: ReusedProgram, tmp_path: Path
) -> None:
    runs = [*answers(program, tmp_path / "one", 2)]
    assert [run.reason for run in runs] == ["what it is given"] * 2
    assert (tmp_path / "one" / "cleared").exists()


def test_one_that_waited_is_ended_with_the_next_that_is_not_to_wait(
    program: ReusedProgram, tmp_path: Path
) -> None:
    with program.may_wait():
        [*answers(program, tmp_path / "one", 1)]
        assert not (tmp_path / "one" / "cleared").exists()
    [*answers(program, tmp_path / "two", 1)]
    assert (tmp_path / "one" / "cleared").exists(), "it answered both, and then ended"
    assert not (tmp_path / "two" / "cleared").exists()


def test_one_whose_answers_are_not_awaited_gets_no_time_to_clear_up(
    program: ReusedProgram, tmp_path: Path
) -> None:
    left = answers(program, tmp_path / "one", 2)
    next(left)
    left.close()  # type: ignore[attr-defined]  # it is a generator
    assert not (tmp_path / "one" / "cleared").exists()


def test_blocks_in_which_it_may_wait_lie_within_each_other(
    program: ReusedProgram, tmp_path: Path
) -> None:
    with program.may_wait():
        with program.may_wait():
            pass
        [*answers(program, tmp_path / "one", 1)]
        assert not (tmp_path / "one" / "cleared").exists()
    [*answers(program, tmp_path / "one", 1)]
    [*answers(program, tmp_path / "two", 1)]
    assert (tmp_path / "two" / "cleared").exists()


def test_lists_of_one_folder_stay_beside_each_other(program: ReusedProgram, tmp_path: Path) -> None:
    """The program may still read the first when the second is written."""
    for count in (1, 2):
        [*answers(program, tmp_path, count)]
    lists = sorted(tmp_path.glob("asks-*.txt"))
    assert [len(listed.read_text().splitlines()) for listed in lists] == [1, 2]

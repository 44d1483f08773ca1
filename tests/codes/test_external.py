"""Claims about running external programs, made with small Python programs in their place."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import pytest

from vv.ask import Run, Status
from vv.codes import external
from vv.codes.external import Process, how_it_ended, run_batch, start, stop

ANSWERING = "open('{i}.half', 'w').write('{i}'); os.rename('{i}.half', '{i}.answer')"


def batch(folder: Path, count: int, fate: Callable[[int], str]) -> Iterator[Run]:
    """A batch whose program does, for ask i, what the Python text fate(i) says."""

    def launch(indices: Sequence[int]) -> Process:
        (folder / f"launched-{len(list(folder.glob('launched-*')))}").write_text(str(indices))
        lines = ["import os, time", *(fate(i).format(i=i) for i in indices)]
        return start([sys.executable, "-c", "\n".join(lines)], folder)

    def collect(index: int, program: Process) -> Run | None:
        answer = folder / f"{index}.answer"
        return Run(Status.RAN, answer.read_text()) if answer.exists() else None

    return run_batch(count, launch, collect)


def launches(folder: Path) -> int:
    return len(list(folder.glob("launched-*")))


def test_one_program_answers_a_whole_batch_in_order(tmp_path: Path) -> None:
    runs = list(batch(tmp_path, 4, lambda i: ANSWERING))
    assert [run.reason for run in runs] == ["0", "1", "2", "3"]
    assert launches(tmp_path) == 1


def test_answers_come_as_soon_as_they_are_there(tmp_path: Path) -> None:
    runs = batch(tmp_path, 2, lambda i: ANSWERING if i == 0 else "time.sleep(60)")
    begun = time.monotonic()
    assert next(runs).status is Status.RAN
    runs.close()  # type: ignore[attr-defined]  # it is a generator; closing ends the program
    assert time.monotonic() - begun < 10


def test_when_a_program_dies_the_ask_in_flight_fails_and_the_rest_run_alone(
    tmp_path: Path,
) -> None:
    dying = "print('\\nno such stone'); import sys; sys.stdout.flush(); os._exit(3)"
    runs = list(batch(tmp_path, 5, lambda i: dying if i == 2 else ANSWERING))
    assert [run.status for run in runs] == [Status.RAN] * 2 + [Status.ERROR] + [Status.RAN] * 2
    assert "exit code 3" in runs[2].reason
    assert "no such stone" in runs[2].reason
    assert launches(tmp_path) == 3


def test_each_of_several_deaths_costs_one_ask(tmp_path: Path) -> None:
    runs = list(batch(tmp_path, 4, lambda i: "os.abort()" if i % 2 else ANSWERING))
    assert [run.status is Status.RAN for run in runs] == [True, False, True, False]
    assert "SIGABRT" in runs[1].reason


def test_a_program_that_ends_well_without_an_answer_has_failed(tmp_path: Path) -> None:
    (run,) = batch(tmp_path, 1, lambda i: "pass")
    assert run.status is Status.ERROR
    assert "exit code 0; no output" in run.reason


def test_half_an_answer_is_none(tmp_path: Path) -> None:
    (run,) = batch(tmp_path, 1, lambda i: "open('{i}.half', 'w').write('{i}'); os._exit(0)")
    assert run.status is Status.ERROR


def test_a_program_that_cannot_start_is_an_error_with_its_name(tmp_path: Path) -> None:
    def launch(indices: Sequence[int]) -> Process:
        return start([str(tmp_path / "nowhere")], tmp_path)

    runs = list(run_batch(2, launch, lambda index, program: None))
    assert [run.status for run in runs] == [Status.ERROR] * 2
    assert "nowhere" in runs[0].reason


def test_an_empty_batch_starts_nothing(tmp_path: Path) -> None:
    assert list(batch(tmp_path, 0, lambda i: ANSWERING)) == []
    assert launches(tmp_path) == 0


def test_a_program_lives_in_its_folder_and_in_our_process_group(tmp_path: Path) -> None:
    text = "import os; print(os.getcwd(), os.environ['HOME'], os.environ['TMPDIR'], os.getpgid(0))"
    program = start([sys.executable, "-c", text], tmp_path)
    stop(program, patience=10.0)
    assert program.log.read_text().split() == [str(tmp_path)] * 3 + [str(os.getpgid(0))]


def test_a_program_that_will_not_end_is_ended(tmp_path: Path) -> None:
    program = start([sys.executable, "-c", "import time; time.sleep(60)"], tmp_path)
    stop(program)
    assert how_it_ended(program) == "signal SIGKILL; no output"


def test_a_program_that_says_too_much_is_ended_and_the_reason_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(external, "LARGEST_LOG", 1_000_000)
    talking = "while True: print('x' * 10_000)"
    runs = list(batch(tmp_path, 3, lambda i: talking if i == 1 else ANSWERING))
    assert [run.status for run in runs] == [Status.RAN, Status.ERROR, Status.RAN]
    assert "it wrote over 1e+06 bytes of output" in runs[1].reason
    assert max(log.stat().st_size for log in tmp_path.glob("*.log")) <= external.TAIL


def test_a_long_line_of_a_log_is_quoted_by_its_beginning(tmp_path: Path) -> None:
    log = tmp_path / "log"
    for length, quoted in ((300, 300 * "x"), (301, 300 * "x" + "...")):
        log.write_text(length * "x")
        assert external.last_line(log) == quoted

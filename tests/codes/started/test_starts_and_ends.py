"""Claims about a program's surroundings, its time to end, and what of its output is quoted."""

from __future__ import annotations

import os
import signal
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import pytest

from vv.ask import Run, Status
from vv.codes import external
from vv.codes.external import Process, how_it_ended, run_batch, start, stop

NAMELESS = signal.SIGRTMIN + 6


def ended(folder: Path, text: str, errors: str = "") -> Process:
    """A shell script that has ended; errors: the file that takes its standard error."""
    program = start(["sh", "-c", text], folder, errors=folder / errors if errors else None)
    stop(program, patience=20.0)
    return program


def answered(folder: Path, text: str, count: int = 1) -> list[Run]:
    """What a shell script says that leaves the file `answer` where it has answered."""

    def launch(indices: Sequence[int]) -> Process:
        return start(["sh", "-c", text], folder)

    def collect(index: int, program: Process) -> Run | None:
        return Run(Status.RAN) if (folder / "answer").exists() else None

    return list(run_batch(count, launch, collect))


def test_a_program_has_our_environment_one_thread_and_what_it_is_given_last(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("OURS", "kept")
    monkeypatch.setenv("OMP_NUM_THREADS", "7")
    shown = ["sh", "-c", "echo $OURS $OMP_NUM_THREADS $GIVEN $(basename $HOME)"]
    given = start(shown, tmp_path, {"GIVEN": "more", "HOME": "/elsewhere"})
    stop(given, patience=20.0)
    assert given.log.read_text() == "kept 1 more elsewhere\n"


def test_a_program_that_asks_for_input_finds_its_end(tmp_path: Path) -> None:
    """Its input is not that of `vv`, here a pipe into which nobody writes."""
    reading, writing = os.pipe()
    before = os.dup(0)
    os.dup2(reading, 0)
    try:
        program = start(["cat"], tmp_path)
        stop(program, patience=20.0)
    finally:
        os.dup2(before, 0)
        for handle in (reading, writing, before):
            os.close(handle)
    assert program.process.returncode == 0


def test_of_a_log_the_last_lines_are_quoted_each_up_to_a_length(tmp_path: Path) -> None:
    whole, long = "w" * external.LONGEST, "l" * (external.LONGEST + 1)
    (tmp_path / "said").write_text(f"first\n\n{whole}\n{long}\n  last  \n\n")
    program = ended(tmp_path, "cat said; exit 1")
    assert how_it_ended(program, 3) == f"exit code 1; last output: {whole} | {long[:-1]}... | last"
    assert how_it_ended(program, 1) == "exit code 1; last output: last"
    assert external.last_line(program.log) == "last"


def test_of_a_program_that_complains_the_complaint_is_quoted_else_its_output(
    tmp_path: Path,
) -> None:
    says = ended(tmp_path, "echo out; exit 1", "silent.log")
    assert how_it_ended(says) == "exit code 1; last output: out"
    complains = ended(tmp_path, "echo out; echo no >&2; exit 1", "stderr.log")
    assert how_it_ended(complains) == "exit code 1; last output: no"


def test_a_signal_without_a_name_is_told_by_its_number(tmp_path: Path) -> None:
    assert how_it_ended(ended(tmp_path, f"kill -{NAMELESS} $$")) == f"signal {NAMELESS}; no output"


def test_one_that_has_answered_all_may_end_by_itself_and_is_ended_if_it_does_not(
    tmp_path: Path,
) -> None:
    begun = time.monotonic()
    answered(tmp_path, "touch answer; sleep 0.3; touch cleared; sleep 60")
    assert (tmp_path / "cleared").exists()
    assert time.monotonic() - begun < 15.0


def test_one_whose_answers_are_not_awaited_gets_no_time_to_end(tmp_path: Path) -> None:
    def launch(indices: Sequence[int]) -> Process:
        return start(["sh", "-c", "sleep 1; touch cleared; sleep 60"], tmp_path)

    runs = run_batch(2, launch, lambda index, program: None if index else Run(Status.RAN))
    next(runs)
    runs.close()  # type: ignore[attr-defined]  # it is a generator
    assert not (tmp_path / "cleared").exists()


def test_what_a_program_started_is_ended_with_it(tmp_path: Path) -> None:
    program = start(["sh", "-c", "(sleep 1; touch late) & touch begun; wait"], tmp_path)
    while not (tmp_path / "begun").exists():
        time.sleep(0.01)
    stop(program)
    time.sleep(1.2)
    assert not (tmp_path / "late").exists()


def test_an_answer_that_comes_with_the_end_of_a_program_counts(tmp_path: Path) -> None:
    """It is looked for once more after the end: here the program ends during the first look."""
    looks: list[int] = []

    def collect(index: int, program: Process) -> Run | None:
        looks.append(index)
        stop(program)
        return Run(Status.RAN) if len(looks) > 1 else None

    launched = [sys.executable, "-c", "import time; time.sleep(60)"]
    (run,) = run_batch(1, lambda indices: start(launched, tmp_path), collect)
    assert run.status is Status.RAN


@pytest.mark.parametrize(("size", "ran"), [(60, True), (70, False)])
def test_a_program_may_say_as_many_megabytes_as_the_page_on_programs_promises(
    tmp_path: Path, size: int, ran: bool
) -> None:
    wait = 0.1 if ran else 30.0  # s, in which it is seen that the log is too large
    (run,) = answered(tmp_path, f"truncate -s {size}M program-0.log; sleep {wait}; touch answer")
    assert (run.status is Status.RAN) is ran
    assert ran or "over 6.4e+07 bytes" in run.reason


def test_of_a_program_that_says_little_and_dies_all_of_its_log_stays(tmp_path: Path) -> None:
    size = external.TAIL + 1
    (run,) = answered(tmp_path, f"head -c {size} /dev/zero; exit 2")
    assert run.reason.startswith("the program ended early: exit code 2; ")
    assert (tmp_path / "program-0.log").stat().st_size == size


def test_of_one_that_wrote_too_much_the_complaint_is_quoted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(external, "LARGEST_LOG", 1_000_000)
    script = "echo out; echo no room >&2; truncate -s 1500000 big; sleep 60"
    program = start(["sh", "-c", script], tmp_path, errors=tmp_path / "stderr.log")
    reason = external.await_end(program, tmp_path)
    assert reason == (
        "the program was stopped because it wrote more than 1 MB of output; last output: no room"
    )

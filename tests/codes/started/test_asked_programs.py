"""Claims about one question to a declared program: its end, its costs, what stays of it."""

from __future__ import annotations

import os
import time
from pathlib import Path

import pytest

from tests.codes.test_program import GOOD, WRITE, answer
from vv.ask import Status
from vv.codes import external


def test_the_time_that_the_system_works_for_a_program_is_its_time_too(tmp_path: Path) -> None:
    """The clock of `os.times` is the other route; random bytes are work of the system."""
    before = os.times()
    run = answer(tmp_path, "head -c 200000000 /dev/urandom > /dev/null\n" + WRITE(GOOD))
    after = os.times()
    system = after.children_system - before.children_system
    user = after.children_user - before.children_user
    assert system > 0.06
    assert run.cost.solve_cpu == pytest.approx(system + user, abs=0.05)


def test_a_stated_cost_may_exceed_what_was_spent_by_the_jitter_of_clocks_alone(
    tmp_path: Path,
) -> None:
    """A shell takes some milliseconds; 0.1 s more than that is no jitter."""
    run = answer(tmp_path, WRITE(GOOD) + """echo '{"solve_cpu": 0.1}' > result.json""")
    assert run.status is Status.ERROR
    assert "result.json: solve_cpu = 0.1 s; the whole process took 0.0" in run.reason


def test_one_that_refuses_leaves_its_folder_to_look_at(tmp_path: Path) -> None:
    run = answer(tmp_path, "echo seen > notes; echo no >&2; exit 3")
    assert (run.status, run.reason) == (Status.REFUSED, "no")
    assert [notes.read_text() for notes in tmp_path.glob("scratch-0/*/notes")] == ["seen\n"]


def test_the_beginning_of_what_was_too_long_stays(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(external, "LARGEST_LOG", 1_000_000)
    answer(tmp_path, "echo head > big; truncate -s 1500000 big; sleep 60")
    (big,) = tmp_path.glob("scratch-0/*/big")
    assert big.stat().st_size == external.TAIL
    assert big.read_bytes().startswith(b"head\n")


def test_a_program_cannot_raise_the_limit_of_its_files(tmp_path: Path) -> None:
    """The hard limit is lowered once it runs; a shell tells it in blocks of 512 bytes."""
    answer(tmp_path, "sleep 0.3; ulimit -H -f > limit; exit 1")
    (limit,) = tmp_path.glob("scratch-0/*/limit")
    assert int(limit.read_text()) * 512 == 2 * external.LARGEST_LOG


def test_when_the_wait_for_a_program_is_broken_off_it_ends_with_what_it_started(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(program: external.Process, folder: Path) -> str | None:
        while not (folder / "begun").exists():
            time.sleep(0.01)
        raise KeyboardInterrupt

    monkeypatch.setattr(external, "await_end", broken)
    with pytest.raises(KeyboardInterrupt):
        answer(tmp_path, f"(sleep 1; touch {tmp_path}/late) & touch begun; wait")
    time.sleep(1.2)
    assert not (tmp_path / "late").exists()

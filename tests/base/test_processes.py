"""Claims about ending processes: what they started is ended too, whatever group it went to."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from vv.base import processes

pytestmark = pytest.mark.skipif(not processes.PROC.is_dir(), reason="the system has no /proc")
LEAVES = "sleep 61 & setsid sleep 62 & (setsid sleep 63 &) ; {}"


def started(folder: Path, then: str) -> subprocess.Popen[bytes]:
    """A shell that has started a child, one in a session of its own, and one that left it."""
    words = ["sh", "-c", LEAVES.format(then)]
    program = subprocess.Popen(
        words, cwd=folder, stdout=subprocess.DEVNULL, env={**os.environ, "HOME": str(folder)}
    )
    within(lambda: sum(map(sleeps, running_in(folder))) == 3)
    return program


def sleeps(pid: int) -> bool:
    return (processes.PROC / str(pid) / "comm").read_text() == "sleep\n"


def running_in(folder: Path) -> list[int]:
    """The processes that work in a folder."""
    return [pid for pid in processes._pids() if processes._is_in(pid, folder)]


def within(is_so: Callable[[], bool]) -> None:
    """Wait until something is so, for half a minute at most: the machine may be busy."""
    for _ in range(1500):
        if is_so():
            return
        time.sleep(0.02)
    raise AssertionError("it did not come to be")


def test_a_process_is_ended_with_its_descendants_in_any_session(tmp_path: Path) -> None:
    program = started(tmp_path, "wait")
    processes.end_with_descendants(program.pid)
    assert program.wait(5) == -9
    within(lambda: len(running_in(tmp_path)) <= 1)  # only an orphan that nobody adopted may stay
    processes.end_those_in(tmp_path)


def test_what_works_in_a_folder_is_ended_though_its_starter_is_gone(tmp_path: Path) -> None:
    program = started(tmp_path, "exit")
    program.wait(5)
    assert len(running_in(tmp_path)) == 3
    processes.end_those_in(tmp_path)
    within(lambda: not running_in(tmp_path))


def test_a_process_that_adopts_orphans_ends_them_and_then_has_no_child(tmp_path: Path) -> None:
    own = "from vv.base import processes; processes.adopt_orphans()\n"
    own += f"import subprocess; subprocess.run(['sh', '-c', {LEAVES.format('exit')!r}])\n"
    own += "processes.end_children()\n"
    own += "try:\n    import os; os.wait()\nexcept ChildProcessError:\n    print('alone')"
    environment = {**os.environ, "HOME": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", own], cwd=tmp_path, env=environment, capture_output=True, check=True,
        timeout=40,  # they sleep for a minute, and are not waited for
    )  # fmt: skip
    assert done.stdout == b"alone\n"
    assert not running_in(tmp_path)


def test_a_folder_whose_name_begins_alike_is_another(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "ab").mkdir()
    program = subprocess.Popen(["sleep", "64"], cwd=tmp_path / "ab", env={"HOME": "/"})
    processes.end_those_in(tmp_path / "a")
    assert program.poll() is None
    processes.end_those_in(tmp_path / "ab")
    assert program.wait(5) == -9


def test_a_process_is_ended_though_a_second_signal_comes_while_it_is_stopped(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def interrupted(pid: int) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(processes, "end_descendants", interrupted)
    sleeper = subprocess.Popen(["sleep", "60"])
    with pytest.raises(KeyboardInterrupt):
        processes.end_with_descendants(sleeper.pid)
    assert sleeper.wait(5) == -9


def test_a_process_whose_home_is_a_folder_is_ended_though_it_works_elsewhere(
    tmp_path: Path,
) -> None:
    (tmp_path / "home").mkdir()
    home = {"HOME": str(tmp_path / "home")}
    program = subprocess.Popen(["sleep", "65"], cwd=tmp_path, env=home)
    within(lambda: sleeps(program.pid))
    processes.end_those_in(tmp_path / "home")
    assert program.wait(5) == -9


def test_children_of_children_are_found_and_those_that_have_ended_are_not(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A made-up /proc, in which names of programs hold blanks and brackets."""
    table = {2: ("(sh)", "S", 1), 3: ("(a) b 1)", "R", 2), 4: ("(sleep)", "S", 3),
             5: ("(ended)", "Z", 2), 6: ("(other)", "S", 1)}  # fmt: skip
    for pid, (name, state, parent) in table.items():
        (tmp_path / str(pid)).mkdir()
        (tmp_path / str(pid) / "stat").write_text(f"{pid} {name} {state} {parent} 0 0 0\n")
    monkeypatch.setattr(processes, "PROC", tmp_path)
    assert processes._descendants(2) == [3, 4]
    assert processes._descendants(1) == [2, 6, 3, 4]

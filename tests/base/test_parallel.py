"""Claims about work that is shared out: the same results as on one core, whatever is lost."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests import ROOT
from vv.base import parallel
from vv.base.parallel import parallel_map

HERE = 0


@pytest.fixture(autouse=True)
def here(monkeypatch: pytest.MonkeyPatch) -> None:
    """This process, which need not be the one that imported this file."""
    monkeypatch.setattr(f"{__name__}.HERE", os.getpid())


@pytest.fixture
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Shared out from the second item on, whatever the first takes."""
    clock = iter(range(10**6))
    monkeypatch.setattr(parallel, "ALONE", 1.5)
    monkeypatch.setattr(time, "process_time", lambda: float(next(clock)))


def who(item: int) -> tuple[int, int]:
    return item, os.getpid()


def dies_elsewhere(item: int) -> tuple[int, int]:
    if os.getpid() != HERE:
        os._exit(1)
    return who(item)


def fails_elsewhere(item: int) -> tuple[int, int]:
    if os.getpid() != HERE and item > 6:
        raise ValueError(item)
    return who(item)


@pytest.mark.usefixtures("at_once")
@pytest.mark.parametrize("processes", [2, 3])
def test_items_are_dealt_to_processes_and_results_are_in_order(processes: int) -> None:
    found = parallel_map(who, range(10), processes)
    assert [item for item, _ in found] == [*range(10)]
    assert len({pid for _, pid in found}) == processes
    assert found[0][1] == found[1][1] == HERE


@pytest.mark.usefixtures("at_once")
def test_what_a_process_was_lost_with_or_failed_at_is_done_here() -> None:
    assert parallel_map(dies_elsewhere, range(10), 3) == [(item, HERE) for item in range(10)]
    found = parallel_map(fails_elsewhere, range(10), 2)
    assert [item for item, _ in found] == [*range(10)]
    assert {pid != HERE for _, pid in found[:7]} == {True, False}
    assert {pid for _, pid in found[7:]} == {HERE}


@pytest.mark.usefixtures("at_once")
def test_what_fails_here_too_is_told() -> None:
    with pytest.raises(ZeroDivisionError):
        parallel_map(lambda item: 1 // (item - 7), range(10), 2)


def test_what_takes_little_and_what_one_process_does_is_done_here(tmp_path: Path) -> None:
    def noted(item: int) -> int:
        (tmp_path / f"{os.getpid()}-{item}").touch()
        return item

    assert parallel_map(noted, range(5), 3) == [*range(5)]
    assert parallel_map(noted, [], 3) == []
    processes = {path.name.split("-")[0] for path in tmp_path.iterdir()}
    assert processes == {str(HERE)}


@pytest.mark.usefixtures("at_once")
def test_one_process_is_enough() -> None:
    assert {pid for _, pid in parallel_map(who, range(5), 1)} == {HERE}


def burns(item: int) -> tuple[int, int]:
    """Keep the processor busy for 0.15 s."""
    begun = time.process_time()
    while time.process_time() - begun < 0.15:
        pass
    return who(item)


def test_what_takes_a_third_of_a_second_is_shared_out() -> None:
    found = parallel_map(burns, range(6), 2)
    assert {pid for _, pid in found[:3]} == {HERE}
    assert len({pid for _, pid in found[3:]}) == 2


def interrupted_elsewhere(item: int) -> tuple[int, int]:
    """As Ctrl-C does, which goes to all processes of a terminal."""
    if os.getpid() != HERE:
        os.kill(os.getpid(), signal.SIGINT)
    return who(item)


def ended_elsewhere(item: int) -> tuple[int, int]:
    if os.getpid() != HERE:
        os.kill(os.getpid(), signal.SIGTERM)
    return who(item)


@pytest.mark.usefixtures("at_once")
def test_ctrl_c_does_not_end_the_helpers_of_a_process_that_goes_on() -> None:
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell may ignore it
    try:
        found = parallel_map(interrupted_elsewhere, range(10), 2)
    finally:
        signal.signal(signal.SIGINT, before)
    assert len({pid for _, pid in found}) == 2


@pytest.mark.usefixtures("at_once")
def test_a_helper_that_is_told_to_end_ends_whatever_its_parent_does_then() -> None:
    before = signal.signal(signal.SIGTERM, lambda *_: None)
    try:
        found = parallel_map(ended_elsewhere, range(10), 2)
    finally:
        signal.signal(signal.SIGTERM, before)
    assert found == [(item, HERE) for item in range(10)]


@pytest.mark.usefixtures("at_once")
def test_no_helper_is_left_once_the_results_are_there() -> None:
    for pid in {pid for _, pid in parallel_map(who, range(10), 3)} - {HERE}:
        with pytest.raises(ProcessLookupError):
            os.kill(pid, 0)


def test_a_process_that_fails_does_not_wait_for_its_helpers() -> None:
    """The helpers of the one here would sleep for a minute."""
    text = (
        "import os, time\nfrom vv.base import parallel\nhere, parallel.ALONE = os.getpid(), -1.0\n"
        "def work(item):\n    if os.getpid() != here: time.sleep(60)\n    raise SystemExit(7)\n"
        "parallel.parallel_map(work, range(4), 2)\n"
    )
    done = subprocess.run([sys.executable, "-c", text], cwd=ROOT, check=False, timeout=30)
    assert done.returncode == 7

"""What survives a kill: finished results, and no worker."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

from tests.conftest import Tiny

SELECTION = ("run", "fall:up", "--codes", "fake/good")


def runs(tiny: Tiny, *words: str) -> int:
    """How many asks the code really answered during an invocation."""
    log = tiny.root / "log"
    log.write_text("")
    done = tiny.vv(*(words or SELECTION), FAKE_LOG=str(log))
    assert done.returncode == 0, done.stderr
    return len(log.read_text().splitlines())


def test_two_invocations_at_once_do_not_disturb_each_other(tiny: Tiny) -> None:
    words = [sys.executable, "-m", "vv", "run", "fall", "--codes", "fake/good"]
    both = [
        subprocess.Popen(
            [*words, *anew, "--json", f"{i}.json"], cwd=tiny.root, stdout=subprocess.DEVNULL
        )
        for i, anew in enumerate(([], ["--fresh"]))  # one that begins late would else just stand
    ]
    assert [process.wait(30) for process in both] == [0, 0]
    first, second = (json.loads((tiny.root / f"{i}.json").read_text())["records"] for i in range(2))
    assert [r["quantities"] for r in first] == [r["quantities"] for r in second]
    assert len(list((tiny.root / ".vv" / "manifests").iterdir())) == 2


def test_a_killed_invocation_leaves_its_finished_results_usable(tiny: Tiny) -> None:
    log = tiny.root / "log"
    tiny.edit("adapters/fake.py", 'if scheme == "hangs":', "if ask.knobs.dt == 0.025:")
    process = subprocess.Popen(
        [sys.executable, "-m", "vv", *SELECTION],
        cwd=tiny.root,
        env={**os.environ, "FAKE_LOG": str(log)},
    )
    _wait_until(lambda: log.exists() and len(log.read_text().splitlines()) >= 3)
    kept, records = tiny.root / ".vv" / "runs", tiny.root / ".vv" / "records"
    # the third ask hangs, so that nothing is written once two records are
    _wait_until(lambda: len(list(kept.rglob("*.npz"))) >= 2)
    _wait_until(lambda: len(list(records.rglob("[!.]*.json"))) >= 2)
    _wait_until(lambda: not list((tiny.root / ".vv").rglob(".part-*")))
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert not list((tiny.root / ".vv").rglob(".part-*"))
    words = ("run", "fall:up", "--codes", "fake/good", "--rung", "dt=0.1", "--rung", "dt=0.05")
    assert runs(tiny, *words) == 0


def test_a_worker_does_not_outlive_a_killed_invocation(tiny: Tiny) -> None:
    marker = f"fall:up --codes fake/hangs --timeout {50 + os.getpid() % 7}.25"
    process = subprocess.Popen([sys.executable, "-m", "vv", "run", *marker.split()], cwd=tiny.root)
    _wait_until(lambda: len(_processes(marker)) >= 2)
    process.send_signal(signal.SIGKILL)
    process.wait()
    _wait_until(lambda: not _processes(marker))


def test_terminating_an_invocation_ends_a_worker_that_hears_nothing(tiny: Tiny) -> None:
    """As one in a kernel, during which Python handles no signals."""
    tiny.edit(
        "adapters/fake.py", "time.sleep(60)", "__import__('signal').signal(15, 1); time.sleep(60)"
    )
    marker = f"fall:up --codes fake/hangs --timeout {60 + os.getpid() % 7}.25"
    process = subprocess.Popen(
        [sys.executable, "-m", "vv", "run", *marker.split()], cwd=tiny.root, stderr=subprocess.PIPE
    )
    _wait_until(lambda: len(_processes(marker)) >= 2)
    time.sleep(1.0)  # for the worker to go deaf
    process.send_signal(signal.SIGTERM)
    _, said = process.communicate(timeout=20)
    assert (process.returncode, said) == (130, b"vv: interrupted; finished results are stored\n")
    _wait_until(lambda: not _processes(marker))


BORN_AN_ORPHAN = """
import multiprocessing, os, time
from vv.run import process

def child(parent):
    os.setpgid(0, 0)
    while os.getppid() == parent:
        time.sleep(0.001)
    process.die_with_parent()
    print("alive", flush=True)

multiprocessing.get_context("fork").Process(target=child, args=(os.getpid(),)).start()
os._exit(0)
"""


def test_a_worker_whose_parent_is_gone_before_it_could_ask_dies_too() -> None:
    words = [sys.executable, "-c", BORN_AN_ORPHAN]
    done = subprocess.run(words, stdout=subprocess.PIPE, timeout=20, check=True)
    assert done.stdout == b""


def _wait_until(true: Callable[[], bool]) -> None:
    """Wait for a condition, 20 s at most."""
    until = time.monotonic() + 20
    while not true():
        assert time.monotonic() < until, "it did not come about"
        time.sleep(0.01)


def _processes(marker: str) -> list[int]:
    """Processes whose command line ends in the marker."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            command = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode().strip()
            state = (folder / "stat").read_text().rpartition(")")[2].split()[0]
        except OSError:
            continue
        if command.endswith(marker) and state != "Z":
            found.append(int(folder.name))
    return found

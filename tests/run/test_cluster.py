"""Claims about a dask cluster in place of local processes: the same results, and deaths apart.

What needs no cluster is claimed in test_batching.py.
"""

from __future__ import annotations

import importlib.util
import json
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.conftest import Tiny, tiny_project

pytestmark = pytest.mark.skipif(
    importlib.util.find_spec("distributed") is None, reason="dask.distributed is not installed"
)
CLUSTER = """
import sys
import dask
from distributed import LocalCluster

if __name__ == "__main__":
    settings = {"distributed.worker.daemon": sys.argv[1] == "daemons",
                "distributed.scheduler.allowed-failures": 0}
    with dask.config.set(settings), LocalCluster(
        n_workers=int(sys.argv[2]), threads_per_worker=1, dashboard_address=None,
        resources={"timing": 1},
    ) as cluster:
        print(cluster.scheduler_address.replace("tcp://", "dask://"), flush=True)
        sys.stdin.read()
"""
KILLER = """
command = "sh killer.sh"
[scheme.default]
method = "first-order"
terms = ["sphere", "gravity"]
"""
CODES = "fake/good,fake/raises,fake/hangs,fake/killed,fake/refuses,killer.toml"


def cluster(folder: Path, how: str, workers: int = 1) -> subprocess.Popen[str]:
    """A cluster, which ends when its input is closed; it prints its address."""
    (folder / "cluster.py").write_text(CLUSTER)
    return subprocess.Popen(
        [sys.executable, "cluster.py", how, str(workers)],
        cwd=folder,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    program = cluster(tmp_path_factory.mktemp("cluster"), "free", workers=2)
    assert program.stdout is not None
    yield program.stdout.readline().strip()
    program.communicate(timeout=30)


@pytest.fixture
def records(tmp_path: Path, address: str) -> dict[str, dict[str, object]]:
    """What comes of good and bad codes on the cluster: CODE/SCHEME -> its record."""
    tiny = tiny_project(tmp_path)
    (tmp_path / "killer.toml").write_text(KILLER)
    (tmp_path / "killer.sh").write_text("kill -9 $(awk '{print $4}' /proc/$PPID/stat); sleep 9")
    limits = ("--level", "quick", "--timeout", "1", "--json", "all.json")
    tiny.vv("run", "fall:up", *limits, "--codes", CODES, "--executor", address)
    found = json.loads((tmp_path / "all.json").read_text())["records"]
    return {f"{one['code']}/{one['scheme']}": one for one in found}


def test_a_cluster_answers_as_this_machine_does_and_a_death_costs_its_own_batch(
    records: dict[str, dict[str, object]],
) -> None:
    told = {name: f"{one['status']}: {one['reason']}" for name, one in records.items()}
    assert told["fake/good"] == "ran: "
    assert told["fake/refuses"] == "refused: it does not feel like it"
    assert told["fake/raises"].startswith("error: RuntimeError: a bug in the code")
    assert (
        told["fake/hangs"]
        == "timeout: no answer in time, --timeout 1 s for 10 steps of 0.1 s; no output"
    )
    assert told["fake/killed"].startswith("error: the worker was killed by SIGKILL; ")
    assert told["killer/default"].startswith("error: the worker failed: KilledWorker")


def test_results_that_came_stand_when_the_scheduler_goes(tiny: Tiny) -> None:
    program = cluster(tiny.root, "free")
    assert program.stdout is not None
    there = ("--executor", program.stdout.readline().strip())
    words = ("run", "fall:up", "--level", "quick", "--codes", "fake/good,fake/hangs")
    threading.Timer(8.0, program.kill).start()
    done = tiny.vv(*words, "--timeout", "50", *there)
    program.communicate(timeout=30)
    assert done.returncode & 8
    assert "Traceback" not in done.stderr
    assert "the scheduler is gone" in done.stderr


def test_workers_that_may_start_no_process_say_how_they_could(tiny: Tiny) -> None:
    program = cluster(tiny.root, "daemons")
    assert program.stdout is not None
    there = ("--codes", "fake/good", "--executor", program.stdout.readline().strip())
    answered = tiny.vv("run", "fall", *there)
    assert tiny.vv("run", "fall", "--codes", "fake/good").returncode == 0
    timed = tiny.vv("run", "--all", *there)  # the results stand: only the session is due, there
    program.communicate(timeout=30)
    assert "set distributed.worker.daemon to False" in answered.stderr
    assert "not timed: " in timed.stderr
    assert "set distributed.worker.daemon to False" in timed.stderr


def test_a_worker_that_may_time_holds_the_session(tiny: Tiny) -> None:
    program = cluster(tiny.root, "free")
    assert program.stdout is not None
    there = ("--executor", program.stdout.readline().strip())
    done = tiny.vv("run", "--all", "--codes", "fake/good", *there, "--json", "all.json")
    program.communicate(timeout=30)
    assert done.returncode == 0
    records = json.loads((tiny.root / "all.json").read_text())["records"]
    assert {one["cost"]["kind"] for one in records} >= {"timed"}


def test_a_worker_with_other_sources_is_refused(tiny: Tiny) -> None:
    program = cluster(tiny.root, "free")
    assert program.stdout is not None
    words = ("run", "fall", "--codes", "fake/good", "--executor", program.stdout.readline().strip())
    assert tiny.vv(*words).returncode == 0
    tiny.edit("adapters/fake.py", "FACTOR = 1.0", "FACTOR = 1.00001")
    done = tiny.vv(*words)
    program.communicate(timeout=30)
    assert done.returncode == 8 + 32
    assert "are not those of the head; if they were changed, restart the workers" in done.stderr

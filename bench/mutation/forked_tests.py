"""Runs pytest on a copy of the project, in forks of a process that has loaded the libraries."""

from __future__ import annotations

import functools
import itertools
import os
import signal
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import pytest

from bench.mutation.cpu_time import Allowance
from bench.mutation.mutants import ROOT

PROCESSES = {
    "tiny",
    "copy",
    "accepted",
    "first",
    "project",
    "kept",
}  # fixtures with processes
REWRITTEN = "ignore:Module already imported:pytest.PytestAssertRewriteWarning"
LIMIT = 600  # s after which a run counts as hung, and therefore as red
SPENT = 240.0  # s of CPU time after which it does so too
READ = ("tests", "docs", "examples", ".ci")
BESIDE = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "Makefile", "requirements.lock")
LATER = itertools.count(int(time.time()))  # each rewritten file gets a modification time of its own
OWN = ("vv", "tests", "bench", "reports", "cases", "adapters", "reference_solutions")


class _Selected:
    """A plug-in of pytest that selects the tests that start no processes, or those that do."""

    def __init__(self, processes: bool) -> None:
        self.processes = processes

    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        """Keep the tests of one kind."""
        items[:] = [i for i in items if self.processes == bool(_fixtures(i) & PROCESSES)]


def _fixtures(item: pytest.Item) -> set[str]:
    return set(getattr(item, "fixturenames", ()))


def passes(project: Path, *tests: str, processes: bool | None = None) -> bool:
    """Whether all tests in folders, files or of given names pass; they run in their own process.

    processes: True for tests that start processes, False for the others, None for all.
    """
    return _status(project, tests, processes) == 0


def _status(project: Path, tests: Sequence[str], processes: bool | None) -> int:
    """The status of the process that runs the tests; a signal ends it if they take too long."""
    child = os.fork()
    if child == 0:
        try:
            os._exit(_tested(project, tests, processes))
        finally:
            os._exit(2)
    return Allowance(SPENT).waited(child)


@functools.cache
def green(project: Path, tests: str, processes: bool) -> bool:
    """Whether tests pass in an unchanged copy.

    Raises TimeoutError if they take too long, as on a busy machine: then nobody knows.
    """
    status = _status(project, (tests,), processes)
    if os.WIFSIGNALED(status):
        told = f"{LIMIT} s, or {SPENT:g} s of CPU time"
        raise TimeoutError(f"{tests} did not end within {told}, in an unchanged copy")
    return status == 0


def _tested(project: Path, tests: Sequence[str], processes: bool | None) -> int:
    signal.alarm(LIMIT)
    sys.dont_write_bytecode = False  # so that the next process reads it
    os.chdir(project)
    os.environ["PYTHONPATH"] = str(project)
    sys.path.insert(0, str(project))
    for name in [n for n in sys.modules if n.partition(".")[0] in OWN]:
        del sys.modules[name]
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    os.dup2(1, 2)
    words = ["-x", "-q", "-p", "no:cacheprovider", "-W", REWRITTEN, *tests]
    chosen = [] if processes is None else [_Selected(processes)]
    status = pytest.main(words, plugins=chosen)
    return 0 if status in (pytest.ExitCode.OK, pytest.ExitCode.NO_TESTS_COLLECTED) else 1


@functools.cache
def with_tests() -> dict[str, bytes]:
    """The additional files that a copy of the project needs: the tests, and what they read."""
    found = [path for folder in READ for path in (ROOT / folder).rglob("*")]
    found += [ROOT / name for name in BESIDE]
    wanted = [p for p in found if p.is_file() and p.suffix not in (".pyc", ".svg")]
    return {path.relative_to(ROOT).as_posix(): path.read_bytes() for path in wanted}


def rewrite(path: Path, text: str) -> None:
    """Replace a source so that Python notices: bytecode is identified by whole seconds and size."""
    path.write_text(text)
    then = next(LATER)
    os.utime(path, (then, then))

"""Runs tests of a copy of the project: they are collected once, and run in forks.

A fork starts with all modules loaded and all caches as collection left them. A mutant inside a
function replaces the code of the loaded function, so that nothing is imported again.
"""

import functools
import gc
import os
import signal
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from types import CodeType, FunctionType, MappingProxyType

import pytest

from bench.mutation.cpu_time import Allowance
from bench.mutation.forked_tests import LIMIT, OWN, REWRITTEN
from bench.mutation.framework_sites import Mutant

SLOW = 20.0  # a process may take this many times its CPU time on a busy machine
_ALLOWED: list[Allowance] = []  # in a fork, its own


class Collected:
    """A plug-in of pytest that hands the collected tests to a function."""

    def __init__(self, project: Path, work: Callable[["Collected"], None]) -> None:
        self.project, self._work = project, work
        self.tests: dict[str, pytest.Item] = {}
        self.red: list[str] = []
        self._functions: dict[str, list[FunctionType]] = {}

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        """Call the function instead of running all tests."""
        self.tests = {item.nodeid: item for item in session.items}
        for one in gc.get_objects():
            if type(one) is FunctionType:  # isinstance would raise for a dead proxy
                self._functions.setdefault(one.__code__.co_filename, []).append(one)
        gc.freeze()  # so that forks share the memory of these objects
        self._work(self)
        return True

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Record the tests that fail."""
        if report.failed:
            self.red.append(report.nodeid)

    def run(
        self, names: Sequence[str], limits: Mapping[str, float] = MappingProxyType({})
    ) -> Iterator[tuple[str, bool]]:
        """Run tests in this process; yield the name of each, and whether it passes.

        limits: the CPU time [s] of a test after which this process, a fork, is ended.
        """
        for name, after in zip(names, [*names[1:], None], strict=True):
            if name in limits:
                _ALLOWED[0].renew(limits[name])
            item, following = self.tests[name], after and self.tests[after]
            item.config.hook.pytest_runtest_protocol(item=item, nextitem=following or None)
            yield name, name not in self.red

    def red_of(self, limits: Mapping[str, float], mutant: Mutant | None) -> str | None:
        """The first test that fails with a mutant in a fork, or how the fork ended; else None."""
        change = functools.partial(self._put_in, mutant) if mutant is not None else _nothing
        return self.red_with(limits, change)

    def red_with(self, limits: Mapping[str, float], change: Callable[[], None]) -> str | None:
        """The first test that fails after a change in a fork, or how the fork ended; else None.

        limits: the tests, and the CPU time [s] after which each counts as hung.
        """
        reading, writing = os.pipe()

        def ask() -> None:
            change()
            for name, fine in self.run([*limits], limits):
                if not fine:
                    os.write(writing, name.encode())
                    return

        status = forked(ask, sum(limits.values()))
        os.close(writing)
        with os.fdopen(reading, "rb") as told:
            return told.read().decode() or (f"ends with {status}" if status else None)

    def _put_in(self, mutant: Mutant) -> None:
        """Replace the code of all loaded functions of a file by that of the mutant."""
        path = str(self.project / mutant.file)
        made = {_place(code): code for code in _codes(compile(mutant.tree(), path, "exec"))}
        for function in self._functions.get(path, ()):
            if (code := made.get(_place(function.__code__))) is not None:
                function.__code__ = code


def fitting(ordered: Iterable[str], seconds: Mapping[str, float], longest: float) -> list[str]:
    """The tests, taken in order, that together fit into a time; longer ones are skipped."""
    left, chosen = longest, list[str]()
    for one in ordered:
        if seconds[one] <= left:
            left -= seconds[one]
            chosen.append(one)
    return chosen


def _nothing() -> None:
    """Change nothing."""


def collected(project: Path, tests: Iterable[str], work: Callable[[Collected], None]) -> None:
    """Let pytest collect the tests of a copy in a fork, and call `work` with them there."""

    def start() -> None:
        os.chdir(project)
        os.environ["PYTHONPATH"] = str(project)
        sys.path.insert(0, str(project))
        for name in [n for n in sys.modules if n.partition(".")[0] in OWN]:
            del sys.modules[name]
        words = ["-q", "-s", "-p", "no:cacheprovider", "-W", REWRITTEN, *tests]
        status = pytest.main(words, plugins=[Collected(project, work)])
        assert status in (pytest.ExitCode.OK, pytest.ExitCode.NO_TESTS_COLLECTED), status

    child = os.fork()
    if child == 0:
        _ended(start)
    if os.waitpid(child, 0)[1]:
        raise RuntimeError("the tests cannot be collected")


def forked(work: Callable[[], None], seconds: float) -> int:
    """Call `work` in a silent fork with a limit of CPU time; its children are ended afterwards."""
    sys.stdout.flush()
    allowed = Allowance(seconds)
    child = os.fork()
    if child == 0:
        os.setsid()
        signal.alarm(max(LIMIT, int(SLOW * seconds)))  # for processes that wait and use no CPU time
        _ALLOWED[:] = [allowed]
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        os.dup2(1, 2)
        _ended(work)
    status = allowed.waited(child)
    try:
        os.killpg(child, signal.SIGKILL)
    except ProcessLookupError:  # it has no processes left
        time.sleep(0)
    return status


def _ended(work: Callable[[], None]) -> None:
    try:
        work()
        sys.stdout.flush()
        os._exit(0)
    except BaseException:
        sys.excepthook(*sys.exc_info())
        os._exit(2)


def _codes(code: CodeType) -> Iterator[CodeType]:
    yield code
    for one in code.co_consts:
        if isinstance(one, CodeType):
            yield from _codes(one)


def _place(code: CodeType) -> tuple[str, int, tuple[str, ...]]:
    return code.co_qualname, code.co_firstlineno, code.co_freevars

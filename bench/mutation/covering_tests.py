"""Records which tests run which lines, in this process or in those that they start.

A record of a file of tests is valid until the file, or a source that it runs, changes.
"""

import hashlib
import json
import os
import re
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from coverage import Coverage, CoverageData

from bench.mutation.collected_tests import Collected, forked
from bench.mutation.mutants import ROOT
from vv.base.files import write_whole

SETTINGS = """[run]
parallel = true
sigterm = true
data_file = {folder}/part
context = ${{PYTEST_CURRENT_TEST}}
source = {sources}
omit = */vv/engines/*
"""
HOOK = "import coverage\ncoverage.process_startup()\n"
SOURCES = ("vv", "adapters", "reports", "reference_solutions")
KEPT = ROOT / ".vv" / "mutants" / "covering"
LONGEST = 300.0  # the limit of CPU time [s] for a file of tests


class Record(NamedTuple):
    """The record of a file of tests: seconds of each passing test, lines, digests of sources."""

    seconds: dict[str, float]
    lines: dict[str, dict[str, list[str]]]  # file -> line -> tests
    digests: dict[str, str]

    @property
    def holds(self) -> bool:
        """Whether a test passed, and the file and all sources that it ran are unchanged.

        Where none passed something was wrong with the machine or the copy, which may be over.
        """
        unchanged = all(digest(file) == then for file, then in self.digests.items())
        return bool(self.seconds) and unchanged


def digest(file: str, root: Path = ROOT) -> str:
    """The digest of a file of the project, or of a copy of it; '' if it does not exist."""
    path = root / file
    return hashlib.sha256(path.read_bytes()).hexdigest()[:16] if path.is_file() else ""


def records(collected: Collected) -> Iterator[Record]:
    """The records of all collected files of tests, made now or earlier."""
    files: dict[str, list[str]] = {}
    for name in collected.tests:
        files.setdefault(name.partition("::")[0], []).append(name)
    for file, names in files.items():
        place = KEPT / f"{file.replace('/', '.')}.json"
        known = Record(**json.loads(place.read_text())) if place.is_file() else None
        if known is None or not known.holds or not known.digests.keys() >= {file}:
            _record(collected, file, names, place)
            known = Record(**json.loads(place.read_text()))
            spent = sum(known.seconds.values())
            print(
                f"recorded {file}: {len(known.seconds)} of {len(names)}, {spent:.1f} s", flush=True
            )
        yield known


def _record(collected: Collected, file: str, names: Sequence[str], place: Path) -> None:
    """Write the record of a file of tests; it is empty for one that hangs or crashes."""
    write_whole(
        place,
        json.dumps(Record({}, {}, {file: digest(file, collected.project)})._asdict()).encode(),
    )
    with tempfile.TemporaryDirectory() as folder:
        forked(lambda: _traced(collected, file, names, place, Path(folder)), LONGEST)


def _traced(
    collected: Collected, file: str, names: Sequence[str], place: Path, folder: Path
) -> None:
    sources = [str(collected.project / one) for one in SOURCES]
    (folder / "settings").write_text(SETTINGS.format(folder=folder, sources=", ".join(sources)))
    (folder / "sitecustomize.py").write_text(HOOK)
    os.environ["COVERAGE_PROCESS_START"] = str(folder / "settings")
    os.environ["PYTHONPATH"] += os.pathsep + str(folder)
    coverage = Coverage(data_file=None, config_file=False, source=sources, omit=["*/vv/engines/*"])
    coverage.set_option("run:disable_warnings", ["no-data-collected"])  # children may run all
    coverage.start()
    seconds = dict(_timed(collected, names, coverage))
    coverage.stop()
    lines: dict[str, dict[str, list[str]]] = {}
    parts = [CoverageData(str(part)) for part in folder.glob("part.*")]
    for part in parts:
        part.read()
    for data in (coverage.get_data(), *parts):
        _gather(lines, data, collected.project, seconds)
    digests = {one: digest(one, collected.project) for one in (file, *lines)}
    known = Record(seconds, lines, digests)
    write_whole(place, json.dumps(known._asdict()).encode())


def _timed(
    collected: Collected, names: Sequence[str], coverage: Coverage
) -> Iterator[tuple[str, float]]:
    """The passing tests with their CPU time [s], child processes included."""
    for name in names:
        coverage.switch_context(name)
        before = sum(os.times()[:4])
        if all(fine for _, fine in collected.run([name])):
            yield name, sum(os.times()[:4]) - before


def _gather(
    lines: dict[str, dict[str, list[str]]], data: CoverageData, project: Path,
    green: Iterable[str],
) -> None:  # fmt: skip
    for path in (one for one in data.measured_files() if one.endswith(".py")):
        file = Path(path).relative_to(project).as_posix()
        for line, contexts in data.contexts_by_lineno(path).items():
            tests = {re.sub(r" \((setup|call|teardown)\)$", "", one) for one in contexts}
            here = lines.setdefault(file, {}).setdefault(str(line), [])
            here += sorted(tests & {*green} - {*here})


def told_of(every: Iterable[Record]) -> tuple[dict[str, float], dict[str, Any]]:
    """All records merged: seconds of each test, and file -> line -> tests."""
    seconds: dict[str, float] = {}
    lines: dict[str, dict[int, list[str]]] = {}
    for one in every:
        seconds |= one.seconds
        for file, found in one.lines.items():
            for line, tests in found.items():
                lines.setdefault(file, {}).setdefault(int(line), []).extend(tests)
    return seconds, lines

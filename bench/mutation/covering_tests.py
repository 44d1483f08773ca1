"""Which tests run which lines, in this process or in those they start; recorded once a file.

A record of a file of tests holds until the file changes, or one of the sources that it runs.
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
LONGEST = 300.0  # s of CPU time in a process that a file of tests may take


class Record(NamedTuple):
    """What is known of a file of tests: seconds of each that is green, lines, what it hangs on."""

    seconds: dict[str, float]
    lines: dict[str, dict[str, list[str]]]  # file -> line -> tests
    digests: dict[str, str]

    @property
    def holds(self) -> bool:
        """Whether it and all that it ran is what it was."""
        return all(digest(file) == then for file, then in self.digests.items())


def digest(file: str, root: Path = ROOT) -> str:
    """Digest of a file of the project, or of a copy of it; '' if it is not there."""
    path = root / file
    return hashlib.sha256(path.read_bytes()).hexdigest()[:16] if path.is_file() else ""


def records(collected: Collected) -> Iterator[Record]:
    """Of every file of tests that was collected, recorded now or before."""
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
    """Write the record of a file of tests; of one that hangs or crashes, an empty one."""
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
    coverage.set_option("run:disable_warnings", ["no-data-collected"])  # by processes alone
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
    """The tests that are green, and the CPU time of each [s], that of its processes too."""
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
    """Seconds of each test, and file -> line -> tests, of all records together."""
    seconds: dict[str, float] = {}
    lines: dict[str, dict[int, list[str]]] = {}
    for one in every:
        seconds |= one.seconds
        for file, found in one.lines.items():
            for line, tests in found.items():
                lines.setdefault(file, {}).setdefault(int(line), []).extend(tests)
    return seconds, lines

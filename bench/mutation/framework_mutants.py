"""Mutates one operator of the framework at a time; counts mutants that its tests miss.

`python -m bench.mutation.framework_mutants` takes every place outside the engines that can be
mutated; `--files 'vv/gate/*'` selects files, `--each N` takes at most N per file, `--sample N`
takes N in all, if possible the same number in every layer, by a fixed random choice. With `--seed
K` they are drawn from all places with equal probability, so that the surviving share estimates that
of all mutants, with a confidence interval. `--part references` mutates the reference solutions, and
runs the tests of references, and those of cases that compare one with its second route. For a
mutant the tests that run its line are run, those of its own folder first, then the fastest, until
one fails that passes without it; then the other tests of their files. A mutant in code that runs
at import, or that none of these detects, is put to the tests that run any line of the file, and to
the others of their files, with the file imported anew.
`equivalent.txt` names mutants that behave like the original; they do not count.
"""

import argparse
import importlib
import json
import os
import tempfile
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from scipy.stats import binomtest

from bench.evidence import conclude
from bench.mutation.collected_tests import Collected, collected, fitting
from bench.mutation.covering_tests import records, told_of
from bench.mutation.forked_tests import passes, rewrite, with_tests
from bench.mutation.framework_sites import EVERY, PARTS, Mutant, drawn, uniform
from bench.mutation.mutants import ROOT
from bench.mutation.schemata import copied

APART = {"engines", "references", "cases", "bench", "support", "scenes", "__pycache__"}
NEEDS = ("numpy", "scipy.optimize", "hypothesis.strategies", "jsonschema", "tomllib")
LONGEST = 120.0  # s for the tests of one mutant, as timed without it
SPARE, HANGING = 30.0, 5.0  # a test hangs after HANGING times its usual CPU time and SPARE s


class Asked:
    """Runs the recorded tests of the lines of mutants."""

    def __init__(
        self, project: Path, seconds: dict[str, float], lines: dict[str, Any], longest: float
    ) -> None:
        self.project, self.seconds, self.lines = project, seconds, lines
        self.longest = longest
        self._green: dict[str, bool] = {}
        self._green_on_import: dict[tuple[str, ...], bool] = {}

    def when_called(self, mutant: Mutant) -> bool:
        """Whether tests run a mutant inside a function that is not only called at import."""
        return mutant.when_called and bool(self._running(mutant))

    def _running(self, mutant: Mutant) -> set[str]:
        here = self.lines.get(mutant.file, {})
        return {one for line in mutant.lines for one in here.get(line, ())}

    def tests(self, mutant: Mutant) -> list[str]:
        """The tests that run its statement, then others of their files."""
        return self._and_beside(mutant, self._running(mutant))

    def tests_of_file(self, mutant: Mutant) -> list[str]:
        """The tests that run any line of its file, then others of their files."""
        here = self.lines.get(mutant.file, {})
        return self._and_beside(mutant, {one for tests in here.values() for one in tests})

    def _and_beside(self, mutant: Mutant, running: set[str]) -> list[str]:
        files = {one.partition("::")[0] for one in running}
        beside = {one for one in self.seconds if one.partition("::")[0] in files}
        return self._first(mutant, running) + self._first(mutant, beside - running)

    def _first(self, mutant: Mutant, tests: Iterable[str]) -> list[str]:
        """As many tests as fit into the time: those of its own folder first, then the fastest."""
        own = f"tests/{Path(mutant.file.removeprefix('vv/')).parts[0]}/"
        ordered = sorted(tests, key=lambda one: (not one.startswith(own), self.seconds[one], one))
        return fitting(ordered, self.seconds, self.longest)

    def red_of(self, collected: Collected, mutant: Mutant) -> str | None:
        """The test that detects a mutant in loaded functions; None if none does."""
        tests = self.tests(mutant)
        place = self.project / mutant.file
        try:
            rewrite(place, mutant.text())
            while tests:
                red = collected.red_of(self._limits(tests), mutant)
                if red not in self.seconds:
                    return red
                rewrite(place, (ROOT / mutant.file).read_text())
                if self.green(collected, red):
                    return red
                rewrite(place, mutant.text())
                tests = [one for one in tests if one != red]
            return None
        finally:
            rewrite(place, (ROOT / mutant.file).read_text())

    def green(self, collected: Collected, test: str) -> bool:
        """Whether a test still passes without a mutant."""
        if test not in self._green:
            self._green[test] = collected.red_of(self._limits([test]), None) is None
        return self._green[test]

    def red_on_import(self, mutant: Mutant) -> str | None:
        """Whether tests that import the mutated file again detect the mutant, and pass without.

        If one of them is red without it, as on a busy machine, those of each file are asked alone.
        """
        tests = self.tests_of_file(mutant)
        if not tests or not self._red_with(mutant, tests):  # pytest would run all there are
            return None
        files = dict.fromkeys(one.partition("::")[0] for one in tests)
        seen = self._pass_on_import(tests) or any(
            self._pass_on_import(own) and self._red_with(mutant, own)
            for own in ([one for one in tests if one.startswith(f"{file}::")] for file in files)
        )
        return "when imported" if seen else None

    def _red_with(self, mutant: Mutant, tests: Sequence[str]) -> bool:
        """Whether a test is red in a process that imports the mutated file anew."""
        place = self.project / mutant.file
        try:
            rewrite(place, mutant.text())
            return not passes(self.project, *tests)
        finally:
            rewrite(place, (ROOT / mutant.file).read_text())

    def _pass_on_import(self, tests: Sequence[str]) -> bool:
        """Whether tests pass without a mutant in a process that imports everything anew."""
        key = tuple(tests)
        if key not in self._green_on_import:
            self._green_on_import[key] = passes(self.project, *tests)
        return self._green_on_import[key]

    def _limits(self, tests: Sequence[str]) -> dict[str, float]:
        return {one: SPARE + HANGING * self.seconds[one] for one in tests}


def seen(
    mutants: Sequence[Mutant], project: Path, tests: Sequence[str], longest: float
) -> dict[Mutant, str]:
    """Mutant -> the test that detects it; '' if none does."""
    told: dict[Mutant, str] = {}
    map_of_tests = project / "told.json"

    def put(collected: Collected) -> None:
        seconds, lines = told_of(records(collected))
        asked = Asked(project, seconds, lines, longest)
        for one in filter(asked.when_called, mutants):
            if by := asked.red_of(collected, one):
                told[one] = _said(one, by)
        kept = [[one.file, one.place, by] for one, by in told.items()]
        map_of_tests.write_text(json.dumps([seconds, lines, kept]))

    collected(project, tests, put)
    seconds, lines, kept = json.loads(map_of_tests.read_text())
    numbered = {file: {int(k): v for k, v in found.items()} for file, found in lines.items()}
    asked = Asked(project, seconds, numbered, longest)
    told |= {Mutant(file, place): by for file, place, by in kept}
    for one in (one for one in mutants if one not in told):
        told[one] = _said(one, asked.red_on_import(one))
    return told


def _said(mutant: Mutant, by: str | None) -> str:
    print(f"{by or 'UNSEEN':<60} {mutant.what}", flush=True)
    return by or ""


def folders(part: str) -> list[str]:
    """The tests to run: of the framework, or those that ask for a second route to a reference."""
    if part == "references":
        files = sorted((ROOT / "tests" / "cases").rglob("test_*.py"))
        own = [path for path in files if "reference_solutions.checks" in path.read_text()]
        return ["tests/references", *(path.relative_to(ROOT).as_posix() for path in own)]
    paths = sorted(path for path in (ROOT / "tests").iterdir() if path.is_dir())
    return [f"tests/{path.name}" for path in paths if path.name not in APART]


def survival(left: int, of: int) -> dict[str, Any]:
    """The share of surviving mutants, with its confidence interval."""
    low, high = binomtest(left, of).proportion_ci(method="wilson")
    return {"mutants": of, "rate": left / of, "at 95 %": [low, high]}


def main() -> None:
    """Mutate, test, count the survivors and judge."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--part", default="framework", choices=PARTS, help="what is turned")
    parser.add_argument("--files", default="*", help="such as 'vv/gate/*'")
    parser.add_argument("--only", default="", help="words in what is turned")
    parser.add_argument("--each", type=int, default=1000, help="mutants a file")
    parser.add_argument("--sample", type=int, default=EVERY, help="mutants in all")
    parser.add_argument("--seed", type=int, help="drawn from all places alike, with this seed")
    parser.add_argument("--tests", nargs="+", help="folders of tests, in place of a part's own")
    parser.add_argument("--longest", type=float, default=LONGEST, help="s of tests a mutant")
    options = parser.parse_args()
    os.nice(10)
    for name in NEEDS:
        importlib.import_module(name)
    every = (
        drawn(options.files, options.each, options.sample, options.part)
        if options.seed is None
        else uniform(options.files, options.sample, options.seed, options.part)
    )
    every = [one for one in every if options.only in one.what]
    with tempfile.TemporaryDirectory() as folder:
        copied(Path(folder), with_tests())
        tests = options.tests or folders(options.part)
        told = seen(every, Path(folder), tests, options.longest)
    left = [one for one, by in told.items() if not by]
    layers = Counter(Path(one.file).parent.as_posix() for one in told)
    figures = {
        **survival(len(left), len(told)),
        "not seen": [one.key for one in left],
        "of each folder": {
            layer: survival(sum(Path(one.file).parent.as_posix() == layer for one in left), n)
            for layer, n in sorted(layers.items())
        },
    }
    conclude(f"{options.part}_mutants", figures, {"5 % at most": figures["rate"] <= 0.05})


if __name__ == "__main__":
    main()

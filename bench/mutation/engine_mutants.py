"""Mutates one operator of the engines at a time; counts mutants that tests and gate miss.

`python -m bench.mutation.engine_mutants --sample N --seed K` draws from all places in the engines
with equal probability, compiled or not; `--files 'vv/engines/dem/*'` from some. A copy contains all
drawn mutants; its tests are collected once, and each mutant is switched on in a fork of that
process, so that kernels are compiled once. Hangs are detected by CPU time, which does not depend on
the load of the machine. Mutants that the tests of the engines do not detect are run in the quick
gates of the codes that contain them; those that the gates do not detect, on the tests that the
branches between mutants turn red, see `left_out`. If a gate is red without a mutant, or more tests
fail than the branches explain, the bench ends without a judgement.
"""

import argparse
import ast
import functools
import importlib
import itertools
import json
import os
import random
import re
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from fnmatch import fnmatch
from pathlib import Path

from bench.evidence import conclude
from bench.mutation import engine_gate, left_out
from bench.mutation.collected_tests import Collected, collected, fitting, forked
from bench.mutation.forked_tests import with_tests
from bench.mutation.framework_mutants import NEEDS, survival
from bench.mutation.framework_sites import is_equivalent, named
from bench.mutation.in_copy.switch import NUMBER
from bench.mutation.mutants import ROOT, Mutant, all_places, parsed, turned
from bench.mutation.schemata import as_in_copy, build, switchable
from vv.base.closure import import_closure
from vv.base.files import write_whole
from vv.plan.keys import roots
from vv.plan.project import find

CODES = ("exact", "dem", "dda", "rigid")
TESTS = ("tests/engines",)
LONGEST = 60.0  # s of CPU time for the tests of one mutant
SPARE, HANGING = 10.0, 3.0  # a test hangs after HANGING times its usual CPU time and SPARE s
AMISS = 0.05  # fraction of tests that may fail: some count sweeps or steps, which rounding changes
COMPILING = 1200.0  # s of CPU time for all tests once, with every kernel compiled


def drawn(files: str, sample: int, seed: int) -> list[Mutant]:
    """A random sample of switchable mutants, drawn from all places with equal probability.

    Mutants that `equivalent.txt` names are not drawn.
    """
    paths = sorted((ROOT / "vv" / "engines").rglob("*.py"))
    names = (path.relative_to(ROOT).as_posix() for path in paths)
    every = [*all_places(name for name in names if fnmatch(name, files))]
    shuffled = random.Random(seed).sample(every, len(every))
    differing = (one for one in shuffled if not is_equivalent(_key(one)))
    return [*itertools.islice(filter(switchable, differing), sample)]


def _key(mutant: Mutant) -> str:
    node = [*ast.walk(parsed(mutant.file))][mutant.place]
    return named(mutant.file, node, turned(node))


class Asked:
    """Runs collected tests on mutants: those that import its file, then its engine's, then others.

    Of each of these the fastest are run first.
    """

    def __init__(self, collected: Collected, seconds: dict[str, float], longest: float) -> None:
        self.collected, self.seconds, self.longest = collected, seconds, longest

    def tests(self, mutant: Mutant) -> list[str]:
        """The tests for a mutant: as many as fit into the time."""
        own, near = f"tests/engines/{Path(mutant.file).parts[2]}/", importing(mutant.file)

        def rank(one: str) -> tuple[bool, bool, float]:
            there = one.partition("::")[0] in near
            return not there, not one.startswith(own), self.seconds[one]

        return fitting(sorted(self.seconds, key=rank), self.seconds, self.longest)

    def red_of(self, mutant: Mutant, number: int) -> str | None:
        """The test that detects a mutant; None if none does."""
        limits = {one: SPARE + HANGING * self.seconds[one] for one in self.tests(mutant)}
        return self.collected.red_with(limits, functools.partial(switch_on, number))


@functools.cache
def importing(file: str) -> frozenset[str]:
    """The files of tests that import a file."""
    name = file.removesuffix(".py").replace("/", ".")
    line = re.compile(rf"^from {re.escape(name)} import", re.MULTILINE)
    tests = (ROOT / "tests").rglob("test_*.py")
    found = (path for path in tests if line.search(path.read_text()))
    return frozenset(path.relative_to(ROOT).as_posix() for path in found)


def switch_on(number: int) -> None:
    """Switch a mutant on, in this process and in those that it starts."""
    os.environ[NUMBER] = str(number)
    importlib.import_module("vv.switch").ON = number  # type: ignore[attr-defined]
    importlib.import_module("vv.switch_compiled").WORD.value = number


def green(collected: Collected, kept: Path) -> dict[str, float]:
    """CPU seconds of each test that passes without a mutant, with kernels compiled before.

    Tests that did not finish within the total time are missing.
    """

    def timed() -> None:
        seconds, before = {}, sum(os.times()[:4])
        for name, fine in collected.run([*collected.tests]):
            now = sum(os.times()[:4])
            seconds[name] = now - before if fine else float("inf")
            before = now
            kept.write_text(json.dumps(seconds))  # also in a run that was cut off

    for _ in ("compiles", "is timed"):
        forked(timed, COMPILING)
    known: dict[str, float] = json.loads(kept.read_text())
    return those_green(known)


def those_green(seconds: dict[str, float]) -> dict[str, float]:
    """The tests that pass without a mutant; ends the bench if too many fail."""
    red = [name for name, spent in seconds.items() if spent == float("inf")]
    engine_gate.require_green(red if len(red) > AMISS * len(seconds) else [])
    print(f"red by the branches, asked last: {', '.join(red) or 'none'}", flush=True)
    return {name: spent for name, spent in seconds.items() if name not in red}


def by_tests(
    project: Path, tests: Iterable[str], numbers: dict[Mutant, int], longest: float
) -> tuple[dict[str, str], list[str]]:
    """Mutant -> the test that detects it, '' if none does; and the tests that were not run."""
    kept = project / "told.json"

    def put(collected: Collected) -> None:
        asked, told = Asked(collected, green(collected, kept), longest), {}
        left = [one for one in collected.tests if one not in asked.seconds]
        spent = sum(asked.seconds.values())
        print(f"{len(asked.seconds)} tests in {spent:.0f} s, {len(left)} left out", flush=True)
        for one, number in numbers.items():
            told[one.what] = asked.red_of(one, number) or ""
            print(f"{told[one.what] or 'no test':<60} {one.what}", flush=True)
        kept.write_text(json.dumps([told, left]))

    collected(project, tests, put)
    told, left = json.loads(kept.read_text())
    return told, left


def codes_of(mutant: Mutant) -> Iterator[str]:
    """The codes whose adapters import the file of a mutant, by name."""
    project = find(ROOT)
    for code in CODES:
        if ROOT / mutant.file in import_closure(project.adapter_files(code), roots(project)):
            yield code


def told_of(chosen: Sequence[Mutant], tests: Iterable[str], longest: float) -> dict[str, str]:
    """Mutant -> the test or gate that detects it."""
    with tempfile.TemporaryDirectory() as folder:
        project = Path(folder)
        numbers = build(project, chosen)
        for name, content in with_tests().items():
            write_whole(project / name, as_in_copy(name, content))
        own = {one: numbers[one.what] for one in chosen}
        told, left = by_tests(project, tests, own, longest)
        for one in (one for one in chosen if not told[one.what]):
            told[one.what] = engine_gate.seeing(project, codes_of(one), own[one])
            print(f"{told[one.what] or 'no gate':<60} {one.what}", flush=True)
    for what, by in left_out.seeing(left, [one for one in chosen if not told[one.what]]).items():
        told[what] = by
        print(f"{by or 'UNSEEN':<60} {what}", flush=True)
    return told


def main() -> None:
    """Draw mutants, test them, count the survivors and judge."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--files", default="*", help="such as 'vv/engines/dem/*'")
    parser.add_argument("--sample", type=int, default=60, help="mutants in all")
    parser.add_argument("--seed", type=int, default=1, help="of the draw")
    parser.add_argument("--tests", nargs="+", default=[*TESTS], help="folders of tests")
    parser.add_argument("--longest", type=float, default=LONGEST, help="s of tests a mutant")
    options = parser.parse_args()
    os.nice(10)
    for name in NEEDS:
        importlib.import_module(name)
    chosen = drawn(options.files, options.sample, options.seed)
    told = told_of(chosen, options.tests, options.longest)
    left = [what for what, by in told.items() if not by]
    figures = {**survival(len(left), len(told)), "not seen": left}
    conclude("engine_mutants", figures, {"5 % at most": figures["rate"] <= 0.05})


if __name__ == "__main__":
    main()

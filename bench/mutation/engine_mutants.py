"""Turns one operator of the engines at a time, and counts what their tests and the gate miss.

`python -m bench.mutation.engine_mutants --sample N --seed K` draws from all places in the engines
alike, compiled or not; `--files 'vv/engines/dem/*'` from some. A copy holds all that were drawn;
its tests are collected once, and each mutant is switched on in a fork of that process, so that
kernels are compiled once. What hangs is told by CPU time, which a busy machine does not change.
What the tests of the engines do not see is put to the quick gate of the codes it is part of. Where
a test or a gate is red with no mutant on the bench ends and judges nothing.
"""

import argparse
import functools
import importlib
import itertools
import json
import os
import random
import resource
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from fnmatch import fnmatch
from pathlib import Path

from bench.evidence import conclude
from bench.mutation.collected_tests import Collected, collected, fitting, forked
from bench.mutation.forked_tests import with_tests
from bench.mutation.framework_mutants import NEEDS, survival
from bench.mutation.mutants import ROOT, Mutant, all_places
from bench.mutation.schemata import build, switchable
from bench.mutation.switch import NUMBER
from vv.base.closure import import_closure
from vv.base.files import write_whole
from vv.plan.keys import roots
from vv.plan.project import find
from vv.records.finding import Bit

CODES = ("exact", "dem", "dda", "rigid")
TESTS = ("tests/engines",)
LONGEST = 60.0  # s of CPU time that the tests may take which one mutant is put to
SPARE, HANGING = 10.0, 3.0  # s and times of what tests take without a mutant: it hangs
COMPILING = 1200.0  # s of CPU time for all tests once, with every kernel compiled
SPENT = 200.0  # s of CPU time after which a process of the gate hangs, many times what it takes
WRONG = Bit.ACCURACY | Bit.CONSERVATION | Bit.CRASH | Bit.TIMEOUT


def drawn(files: str, sample: int, seed: int) -> list[Mutant]:
    """So many mutants that a process can switch on, every place being as likely as any other."""
    paths = sorted((ROOT / "vv" / "engines").rglob("*.py"))
    names = (path.relative_to(ROOT).as_posix() for path in paths)
    every = [*all_places(name for name in names if fnmatch(name, files))]
    shuffled = random.Random(seed).sample(every, len(every))
    return [*itertools.islice(filter(switchable, shuffled), sample)]


class Asked:
    """Puts mutants to collected tests: those of the mutant's engine first, then the quickest."""

    def __init__(self, collected: Collected, seconds: dict[str, float], longest: float) -> None:
        self.collected, self.seconds, self.longest = collected, seconds, longest

    def tests(self, mutant: Mutant) -> list[str]:
        """As many as fit in the time."""
        own = f"tests/engines/{Path(mutant.file).parts[2]}/"
        ordered = sorted(self.seconds, key=lambda one: (not one.startswith(own), self.seconds[one]))
        return fitting(ordered, self.seconds, self.longest)

    def red_of(self, mutant: Mutant, number: int) -> str | None:
        """The test that sees it, if any."""
        tests = self.tests(mutant)
        limit = SPARE + HANGING * sum(self.seconds[one] for one in tests)
        return self.collected.red_with(tests, limit, functools.partial(switch_on, number))


def switch_on(number: int) -> None:
    """Switch a mutant on in this process and those it starts."""
    os.environ[NUMBER] = str(number)
    importlib.import_module("vv.switch").ON = number  # type: ignore[attr-defined]
    importlib.import_module("vv.switch_compiled").WORD.value = number


def green(collected: Collected, kept: Path) -> dict[str, float]:
    """CPU seconds of each test with no mutant on, all of them green; compiling makes some long.

    Those that do not end within the time for all are not there.
    """

    def timed() -> None:
        seconds, before = {}, sum(os.times()[:4])
        for name, fine in collected.run([*collected.tests]):
            now = sum(os.times()[:4])
            seconds[name] = now - before if fine else float("inf")
            before = now
            kept.write_text(json.dumps(seconds))  # also of a run that was cut

    forked(timed, COMPILING)
    known: dict[str, float] = json.loads(kept.read_text())
    require_green([name for name, spent in known.items() if spent == float("inf")])
    return known


def require_green(red: Sequence[str]) -> None:
    """End the bench where something is red with no mutant on: it would see any mutant."""
    if red:
        raise SystemExit("red without a mutant, so that nothing is judged: " + ", ".join(red))


def by_tests(
    project: Path, tests: Iterable[str], numbers: dict[Mutant, int], longest: float
) -> dict[str, str]:
    """What sees each mutant -> the test; '' for those that no test sees."""
    kept = project / "told.json"

    def put(collected: Collected) -> None:
        asked, told = Asked(collected, green(collected, kept), longest), {}
        left = len(collected.tests) - len(asked.seconds)
        spent = sum(asked.seconds.values())
        print(f"{len(asked.seconds)} tests in {spent:.0f} s, {left} left out", flush=True)
        for one, number in numbers.items():
            told[one.what] = asked.red_of(one, number) or ""
            print(f"{told[one.what] or 'no test':<60} {one.what}", flush=True)
        kept.write_text(json.dumps(told))

    collected(project, tests, put)
    told: dict[str, str] = json.loads(kept.read_text())
    return told


def by_gate(project: Path, codes: Iterable[str], number: int) -> str:
    """The code whose quick gate sees a mutant, or none, 0; '' if there is none."""
    return next((f"gate of {code}" for code in codes if not _fine(project, code, number)), "")


def _fine(project: Path, code: str, number: int) -> bool:
    words = ["gate", "--codes", code, "--require", code, "--jobs", "1", "--timeout", "36000"]
    with tempfile.TemporaryDirectory() as data:
        env = {**os.environ, "PYTHONPATH": str(project), "VV_DATA": data, NUMBER: str(number)}
        command = [sys.executable, "-m", "vv", *words, "--against", "cases/baselines"]
        done = subprocess.run(
            command, cwd=project, env=env, capture_output=True, check=False, preexec_fn=_limited
        )
    return done.returncode >= 0 and not done.returncode & WRONG


def _limited() -> None:
    resource.setrlimit(resource.RLIMIT_CPU, (int(SPENT), int(SPENT)))


def codes_of(mutant: Mutant) -> Iterator[str]:
    """The codes whose adapters import the file of a mutant."""
    project = find(ROOT)
    for code in CODES:
        if ROOT / mutant.file in import_closure(project.adapter_files(code), roots(project)):
            yield code


def told_of(chosen: Sequence[Mutant], tests: Iterable[str], longest: float) -> dict[str, str]:
    """What sees each mutant."""
    with tempfile.TemporaryDirectory() as folder:
        project = Path(folder)
        numbers = build(project, chosen)
        for name, content in with_tests().items():
            write_whole(project / name, content)
        own = {one: numbers[one.what] for one in chosen}
        told = by_tests(project, tests, own, longest)
        for one in (one for one in chosen if not told[one.what]):
            codes = [*codes_of(one)]
            require_green([f"gate of {code}" for code in codes if not _sound(project, code)])
            told[one.what] = by_gate(project, codes, own[one])
            print(f"{told[one.what] or 'UNSEEN':<60} {one.what}", flush=True)
    return told


@functools.cache
def _sound(project: Path, code: str) -> bool:
    """Whether the gate is green in the copy with no mutant on."""
    return _fine(project, code, 0)


def main() -> None:
    """Draw, ask, count and judge."""
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

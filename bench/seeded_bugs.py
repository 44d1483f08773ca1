"""Seeds plausible bugs one at a time and says what sees each: the gate, the tests, or nothing.

`python -m bench.seeded_bugs` takes all; `--kind solvers,run` some kinds, `--each N` so many of
each kind, a fixed random choice, `--only WORDS` those whose names hold these words. A bug in a
solver or an adapter is put to the gate at its quick level, in the cases that are named with it.
What no gate can see is put to the tests that are named; first to all that start no process, then
to the others. What survives is with `--rest` put to all cases, and to all tests of its folder.
"""

import argparse
import functools
import importlib
import os
import random
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from bench.evidence import conclude
from bench.forked_tests import passes, rewrite, with_tests
from bench.mutants import ROOT
from bench.schemata import copied
from bench.seeded import adapters, judgement, kept, run, shown, solvers
from bench.seeded.bug import Bug
from vv.records.finding import Bit

KINDS: Mapping[str, tuple[Bug, ...]] = {
    "judgement": judgement.BUGS,
    "shown": shown.BUGS,
    "solvers": solvers.BUGS,
    "adapters": adapters.BUGS,
    "kept": kept.BUGS,
    "run": run.BUGS,
}
SEEN = Bit.ACCURACY | Bit.CONSERVATION | Bit.CRASH | Bit.TIMEOUT
HASTILY = {"NUMBA_OPT": "1"}  # compiles in two thirds of the time; the solves are short
LIMIT = 1200.0  # s after which a gate hangs, many times what it takes where others work too
TIMEOUT = 300  # s for a job of it


def changed(bug: Bug) -> str:
    """The text of its file with the bug; raises ValueError where the file has moved on."""
    text = (ROOT / bug.file).read_text()
    if bug.old not in text:
        raise ValueError(f"{bug.what}: {bug.file} no longer holds {bug.old!r}")
    return text.replace(bug.old, bug.new, 1)


def chosen(kinds: Sequence[str], each: int, words: str) -> Iterator[tuple[str, Bug]]:
    """(kind, bug): at most so many of every kind whose names hold these words."""
    for kind in kinds:
        bugs = [bug for bug in KINDS[kind] if words in bug.what]
        yield from ((kind, one) for one in random.Random(kind).sample(bugs, min(each, len(bugs))))


def caught_by(project: Path, bug: Bug, rest: bool) -> str:
    """What sees a bug: 'gate', 'tests', or 'unseen'; project: a copy that has the tests too.

    Raises ValueError where tests are red without it.
    """
    place = project / bug.file
    rewrite(place, changed(bug))
    try:
        if bug.code and any(_gate(project, bug.code, cases) for cases in _selections(bug, rest)):
            return "gate"
        asked = [(one, starts) for starts in (False, True) for one in _tests(bug, rest)]
        red = next((one for one in asked if not passes(project, *one)), None)
    finally:
        rewrite(place, (ROOT / bug.file).read_text())
    if red is not None and not green(project, *red):
        raise ValueError(f"{bug.what}: {red[0]} is red without it")
    return "unseen" if red is None else "tests"


@functools.cache
def green(project: Path, tests: str, processes: bool) -> bool:
    """Whether tests pass where nothing is changed."""
    return passes(project, tests, processes)


def _selections(bug: Bug, rest: bool) -> Iterator[tuple[str, ...]]:
    """The cases to ask: those named with it, then all."""
    yield tuple(bug.cases.split())
    if rest and bug.cases:
        yield ()


def _tests(bug: Bug, rest: bool) -> Iterator[str]:
    """The tests to ask: those named with it, then those of the folder that mirrors its own."""
    yield from bug.tests.split()
    if rest:
        parts = Path(bug.file).parts[:-1]
        own = Path("tests", *(parts[1:] if parts[0] == "vv" else parts))
        while not (ROOT / own).is_dir():
            own = own.parent
        yield own.as_posix()


def _gate(project: Path, code: str, selection: tuple[str, ...]) -> bool:
    """Whether the gate of a project, whose store is empty, sees that something is wrong."""
    words = ["gate", *selection, "--codes", code, "--level", "quick", "--require", code]
    more = ["--timeout", str(TIMEOUT), "--jobs", "1"]
    cache = ROOT / ".vv" / "mutants" / "kernels"
    with tempfile.TemporaryDirectory() as data:
        env = {**os.environ, "PYTHONPATH": str(project), "VV_DATA": data, "VV_CACHE": str(cache)}
        try:
            done = subprocess.run(
                [sys.executable, "-m", "vv", *words, *more], cwd=project, env={**env, **HASTILY},
                capture_output=True, check=False, timeout=LIMIT,
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            return True
    return bool(done.returncode & SEEN)


def main() -> None:
    """Seed, ask, count and judge."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--kind", default=",".join(KINDS), help="such as solvers,run")
    parser.add_argument("--each", type=int, default=1000, help="bugs of each kind")
    parser.add_argument("--only", default="", help="words in the name of a bug")
    parser.add_argument("--rest", action="store_true", help="the tests of its folder too")
    options = parser.parse_args()
    for name in ("numpy", "scipy.optimize", "hypothesis.strategies", "jsonschema", "tomllib"):
        importlib.import_module(name)
    told: dict[str, dict[str, str]] = {}
    with tempfile.TemporaryDirectory() as folder:
        project = Path(folder)
        copied(project, with_tests())
        for kind, bug in chosen(options.kind.split(","), options.each, options.only):
            answer = caught_by(project, bug, options.rest)
            told.setdefault(kind, {})[bug.what] = answer
            print(f"{answer:<7} {kind:<10} {bug.what}", flush=True)
    every = [answer for answers in told.values() for answer in answers.values()]
    past_gate = [bug.what for kind in ("solvers", "adapters") for bug in KINDS[kind]
                 if told.get(kind, {}).get(bug.what, "gate") != "gate"]  # fmt: skip
    unseen = [
        what for answers in told.values() for what, seen in answers.items() if seen == "unseen"
    ]
    figures = {
        "bugs": len(every),
        "by": {seen: every.count(seen) for seen in ("gate", "tests", "unseen")},
        "unseen": unseen,
        "of solvers and adapters, not seen by the gate": past_gate,
    }
    conclude("seeded_bugs", figures, {"5 % unseen at most": 20 * len(unseen) <= len(every)})


if __name__ == "__main__":
    main()

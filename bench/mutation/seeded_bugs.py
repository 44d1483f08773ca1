"""Seeds plausible bugs one at a time and says what sees each: the gate, the tests, or nothing.

`python -m bench.mutation.seeded_bugs` takes all; `--kind solvers,run` some kinds, `--each N` so
many of each kind, a fixed random choice, `--only WORDS` those whose names hold these words. A bug
in a solver or an adapter is put to the gate at its quick level, in the cases that are named with
it. What no gate can see is put to the tests that are named; first to all that start no process,
then to the others. What survives is with `--rest` put to all cases, and to all tests of its folder.
A gate that is red counts if it is green without the bug; of the same sources nothing is asked
twice, so that a run that was cut goes on. What only hangs is counted apart.
"""

import argparse
import functools
import hashlib
import importlib
import os
import random
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from bench.evidence import conclude
from bench.mutation.forked_tests import green, passes, rewrite, with_tests
from bench.mutation.mutants import ROOT
from bench.mutation.mutations import HANGS, KEPT, sources_digest
from bench.mutation.schemata import copied
from bench.mutation.seeded import adapters, judgement, kept, run, shown, solvers
from bench.mutation.seeded.bug import Bug
from vv.base.files import write_whole
from vv.records.finding import Bit

KINDS: Mapping[str, tuple[Bug, ...]] = {
    "judgement": judgement.BUGS,
    "shown": shown.BUGS,
    "solvers": solvers.BUGS,
    "adapters": adapters.BUGS,
    "kept": kept.BUGS,
    "run": run.BUGS,
}
SEEN = Bit.ACCURACY | Bit.CONSERVATION | Bit.CRASH
GATE, TESTS, UNSEEN, SPOILT = "gate", "tests", "unseen", "red without it"
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


def asked_once(project: Path, bug: Bug, rest: bool) -> str:
    """What sees a bug, now or before; a hang may be a busy machine's fault."""
    by_gate, by_tests = (_place(repr((how, bug, rest))) for how in (sources_digest(), _tests_too()))
    for told in (by_gate, by_tests):
        if told.is_file():
            return told.read_text()
    answer = caught_by(project, bug, rest)
    if answer not in (HANGS, SPOILT):
        write_whole(by_gate if answer == GATE else by_tests, answer.encode())
    return answer


def _place(whole: str) -> Path:
    return KEPT / "seeded" / hashlib.sha256(whole.encode()).hexdigest()


@functools.cache
def _tests_too() -> str:
    """Digest of all that an answer of the tests hangs on."""
    return hashlib.sha256(
        repr((sources_digest(), sorted(with_tests().items()))).encode()
    ).hexdigest()


def caught_by(project: Path, bug: Bug, rest: bool) -> str:
    """What sees a bug: GATE, HANGS, TESTS, UNSEEN, or SPOILT if what is red is red without it.

    project: a copy that has the tests too.
    """
    place = project / bug.file
    rewrite(place, changed(bug))
    try:
        for cases in _selections(bug, rest) if bug.code else ():
            if answer := _gate(project, bug.code, cases):
                rewrite(place, (ROOT / bug.file).read_text())
                return SPOILT if unharmed(project, bug.code, cases) else answer
        asked = [(one, starts) for starts in (False, True) for one in _tests(bug, rest)]
        red = next((one for one in asked if not passes(project, one[0], processes=one[1])), None)
    finally:
        rewrite(place, (ROOT / bug.file).read_text())
    if red is None:
        return UNSEEN
    return TESTS if green(project, *red) else SPOILT


@functools.cache
def unharmed(project: Path, code: str, cases: tuple[str, ...]) -> str:
    """What the gate says where nothing is changed: '' if it is green."""
    return _gate(project, code, cases)


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


def _gate(project: Path, code: str, selection: tuple[str, ...]) -> str:
    """What the gate of a project, whose store is empty, says: GATE, HANGS or nothing."""
    words = ["gate", *selection, "--codes", code, "--level", "quick", "--require", code]
    more = ["--timeout", str(TIMEOUT), "--jobs", "1"]
    cache = KEPT / "kernels"
    with tempfile.TemporaryDirectory() as data:
        env = {**os.environ, "PYTHONPATH": str(project), "VV_DATA": data, "VV_CACHE": str(cache)}
        try:
            done = subprocess.run(
                [sys.executable, "-m", "vv", *words, *more], cwd=project, env={**env, **HASTILY},
                capture_output=True, check=False, timeout=LIMIT,
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            return HANGS
    if done.returncode & SEEN:
        return GATE
    return HANGS if done.returncode & Bit.TIMEOUT else ""


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
            answer = asked_once(project, bug, options.rest)
            told.setdefault(kind, {})[bug.what] = answer
            print(f"{answer:<14} {kind:<10} {bug.what}", flush=True)
    every = [answer for answers in told.values() for answer in answers.values()]
    past_gate = [bug.what for kind in ("solvers", "adapters") for bug in KINDS[kind]
                 if told.get(kind, {}).get(bug.what, GATE) not in (GATE, HANGS)]  # fmt: skip
    unseen = [what for answers in told.values() for what, seen in answers.items() if seen == UNSEEN]
    figures = {
        "bugs": len(every),
        "by": {seen: every.count(seen) for seen in (GATE, HANGS, TESTS, UNSEEN, SPOILT)},
        "unseen": unseen,
        "of solvers and adapters, not seen by the gate": past_gate,
    }
    conclude("seeded_bugs", figures, {
        "5 % unseen at most": 20 * len(unseen) <= len(every),
        "green without": SPOILT not in every,
    })  # fmt: skip


if __name__ == "__main__":
    main()

"""Mutates one operator or constant of the cases at a time, and counts undetected mutants.

`python -m bench.mutation.case_mutants --sample N --seed K` draws from all places in cases/ with
equal probability. A mutant is checked by everything that should detect a wrong number in a case:
the gallery page of the case, which a test compares with its declaration; the record of what it
declares at other parameters, and measures of made-up runs; the tests that import the file; the
quick gate of the case with the codes that come with vv, against the accepted results; and the tests
that name the case. For a file that several cases share only a few cases are checked, first those
that name it. Hangs are detected by CPU time. If a check is red without a mutant, the bench ends
without a judgement.
"""

import argparse
import functools
import importlib
import itertools
import os
import random
import re
import resource
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from fnmatch import fnmatch
from pathlib import Path

from bench.evidence import conclude
from bench.mutation.collected_tests import forked
from bench.mutation.forked_tests import OWN, passes, rewrite, with_tests
from bench.mutation.framework_mutants import NEEDS, survival
from bench.mutation.framework_sites import Mutant, is_equivalent, turnable
from bench.mutation.mutants import ROOT
from bench.mutation.schemata import copied
from vv.base.closure import import_closure
from vv.case import Level
from vv.plan.keys import roots
from vv.plan.project import find

ASKED = 5  # the most cases that are checked for a shared file
CODES = "exact,dem,dda,rigid"
PAPERS = ("tests/case/test_published.py", "tests/insight/test_papers.py")
RECORD = "tests/cases/test_declarations.py"
SPENT = 120.0  # s of CPU time, many times the usual, after which a process counts as hung
GALLERY = ROOT / "docs" / "gallery"


def drawn(files: str, sample: int, seed: int) -> list[Mutant]:
    """A random sample of mutants, drawn from all places with equal probability."""
    paths = sorted((ROOT / "cases").rglob("*.py"))
    names = [path.relative_to(ROOT).as_posix() for path in paths]
    every = [one for name in names if fnmatch(name, files) for one in turnable(name)]
    shuffled = random.Random(seed).sample(every, len(every))
    differing = (one for one in shuffled if not is_equivalent(one.key))
    return [*itertools.islice(differing, sample)]


@functools.cache
def cases_of(file: str) -> list[str]:
    """The cases that depend on a file: its own case, then those that name it, then others."""
    project = find(ROOT)
    own, places, here = project.case_files(), roots(project), ROOT / file
    found = [name for name, path in own.items() if here in import_closure([path], places)]
    word = re.compile(rf"\b{here.stem}\b")
    return sorted(found, key=lambda n: (own[n] != here, not word.search(own[n].read_text())))


@functools.cache
def tests_of(what: str) -> tuple[str, ...]:
    """The files of tests that name a case or import a file of cases/, or read what papers do."""
    name = what.removesuffix(".py").replace("/", ".")
    folder, _, stem = name.rpartition(".")
    imported = rf"from {re.escape(name)} import|from {re.escape(folder)} import .*\b{stem}\b"
    own = _naming(rf"""["']{re.escape(what)}["':]|{imported}""", ROOT / "tests" / "cases", "test_*")
    stated = what.startswith("cases/papers/") or _naming(imported, ROOT / "cases" / "papers", "*")
    return (*PAPERS, *own) if stated else own


def _naming(pattern: str, folder: Path, names: str) -> tuple[str, ...]:
    word, files = re.compile(pattern), sorted(folder.rglob(f"{names}.py"))
    return tuple(
        path.relative_to(ROOT).as_posix() for path in files if word.search(path.read_text())
    )


def changed_page(project: Path, case: str) -> bool:
    """Whether the pages of a case differ from the gallery, or cannot be written."""

    def ask() -> None:
        os.chdir(project)
        sys.path.insert(0, str(project))
        for name in [n for n in sys.modules if n.partition(".")[0] in OWN]:
            del sys.modules[name]
        command = importlib.import_module("vv.cli.docs_command")
        made = importlib.import_module("vv.plan.project").Project(project)
        for place, text in command.case_pages(made, [case]).items():
            if (GALLERY / place).read_text() != text:
                raise AssertionError(place)

    return forked(ask, SPENT) != 0


def red_gate(project: Path, case: str) -> bool:
    """Whether the quick gate of a case is red against the accepted results, with an empty store."""
    words = ["gate", case, "--codes", CODES, "--against", "cases/baselines"]
    with tempfile.TemporaryDirectory() as data:
        env = {**os.environ, "PYTHONPATH": str(project), "VV_DATA": data}
        done = subprocess.run(
            [sys.executable, "-m", "vv", *words, "--jobs", "1", "--timeout", "36000"],
            cwd=project, env=env, capture_output=True, check=False, preexec_fn=_limited,
        )  # fmt: skip
    return done.returncode != 0


def other_record(project: Path, case: str) -> bool:
    """Whether a case declares or measures other than recorded."""
    return not passes(
        project, f"{RECORD}::test_a_case_declares_and_measures_what_was_recorded[{case}]"
    )


def red_tests(project: Path, what: str) -> bool:
    """Whether a test that names a case, or imports a file, is red."""
    return bool(tests_of(what)) and not passes(project, *tests_of(what))


def _limited() -> None:
    resource.setrlimit(resource.RLIMIT_CPU, (int(SPENT), int(SPENT)))


WAYS: dict[str, Callable[[Path, str], bool]] = {
    "page": changed_page, "record": other_record, "gate": red_gate, "tests": red_tests
}  # fmt: skip


@functools.cache
def require_sound(project: Path, way: str, case: str) -> None:
    """End the bench if a check is red without a mutant, since it would detect any mutant."""
    if WAYS[way](project, case):
        raise SystemExit(f"{way} of {case}: red without a mutant, so that it can judge nothing")


def questions(mutant: Mutant) -> Iterator[tuple[str, str]]:
    """The checks of a mutant as (way, case or file), the cheapest first."""
    cases = cases_of(mutant.file)[:ASKED]
    yield from (("page", case) for case in cases)
    yield from (("record", case) for case in cases)
    yield "tests", mutant.file
    yield from (("gate", case) for case in cases if is_quick(case))
    yield from (("tests", case) for case in cases)


@functools.cache
def is_quick(case: str) -> bool:
    """Whether a case has variants at level quick."""
    return any(one.runs_at(Level.QUICK) for one in find(ROOT).load_case(case).variants)


def seen_by(project: Path, mutant: Mutant) -> str:
    """The check that detects a mutant; '' if none does."""
    place = project / mutant.file
    for way, case in questions(mutant):
        require_sound(project, way, case)
        try:
            rewrite(place, mutant.text())
            if WAYS[way](project, case):
                return f"{way} of {case}"
        finally:
            rewrite(place, (ROOT / mutant.file).read_text())
    return ""


def told_of(chosen: Sequence[Mutant]) -> dict[Mutant, str]:
    """Mutant -> the check that detects it; '' if none does."""
    told = {}
    with tempfile.TemporaryDirectory() as folder:
        project = Path(folder).resolve()
        copied(project, with_tests())
        for one in chosen:
            told[one] = seen_by(project, one)
            print(f"{told[one] or 'UNSEEN':<40} {one.what}", flush=True)
    return told


def main() -> None:
    """Draw mutants, check them, count the survivors and judge."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--files", default="*", help="such as 'cases/hard/*'")
    parser.add_argument("--sample", type=int, default=100, help="mutants in all")
    parser.add_argument("--seed", type=int, default=1, help="of the draw")
    options = parser.parse_args()
    os.nice(10)
    for name in NEEDS:
        importlib.import_module(name)
    told = told_of(drawn(options.files, options.sample, options.seed))
    left = [one for one, by in told.items() if not by]
    by_way = Counter(by.partition(" ")[0] or "nothing" for by in told.values())
    figures = {
        **survival(len(left), len(told)),
        "seen by": dict(by_way),
        "not seen": [one.key for one in left],
    }
    conclude("case_mutants", figures, {"5 % at most": figures["rate"] <= 0.05})


if __name__ == "__main__":
    main()

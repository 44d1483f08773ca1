"""Mutates operators of the kernels one at a time, and counts the mutants that the gate detects.

`python -m bench.mutation.mutations` runs all; `--each N` sets the number per kernel; `--files
PATTERN` selects kernels. A mutant is detected if the gate is red for an answer that is wrong, gains
energy, crashes or hangs; hangs are counted separately. The bar: at most one in twenty survives, and
the gate is green for every code if the copy contains all mutants and none is on. Verdicts are
stored by the digest of the sources, so that an interrupted run can continue.
"""

import argparse
import concurrent.futures
import functools
import hashlib
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from fnmatch import fnmatch
from pathlib import Path
from typing import NamedTuple

from bench.evidence import conclude
from bench.mutation.in_copy.switch import NUMBER
from bench.mutation.mutants import ROOT, mechanical
from bench.mutation.schemata import build, copied, sources
from vv.base.closure import source_digest
from vv.base.files import write_whole
from vv.records.finding import Bit

HANGS = "hangs"
SPHERES, BLOCKS = ("single-contact",), ("responding-block:1d", "wedge:xi-1", "painleve")
SHORTEST = {"exact": SPHERES, "dem": SPHERES, "rigid": BLOCKS, "dda": BLOCKS}
HASTILY = {"NUMBA_OPT": "1"}  # compiling takes two thirds of the time; the solves are short
COMPILING, SOLVING = 600.0, 60.0  # s, many times the usual, after which the gate counts as hung
KEPT = ROOT / ".vv" / "mutants"  # stored verdicts, and the copy with all mutants


class Question(NamedTuple):
    """A question to the gates of codes: all that its answer depends on beside the sources."""

    what: str
    codes: tuple[str, ...]
    changed: str
    ask: Callable[[], str]


def alone(file: str, codes: Sequence[str], text: str) -> str:
    """The verdict of the gate on a copy of the project with a changed file; '' if green.

    The gates of the codes are run in turn, until one of them is red.
    """
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder)
        copied(copy, {file: text.encode()})
        seen = (_gate(copy, code, *stage) for code in codes for stage in _stages(code))
        return next(filter(None, seen), "")


def _stages(code: str) -> Iterator[tuple[float, tuple[str, ...], dict[str, str]]]:
    """The selections of cases with their time limits [s]: the shortest cases first, then all."""
    yield COMPILING, SHORTEST[code], HASTILY
    yield COMPILING, (), HASTILY


def switched(project: Path, codes: Sequence[str], number: int) -> str:
    """The verdict of the gate on the copy with all mutants, with one of them on, or none (0).

    Most are detected by the shortest cases of the first code.
    """
    limit = SOLVING if number else COMPILING  # compiled once for all later runs
    seen = (
        _gate(project, code, limit, stage, {NUMBER: str(number)})
        for code in codes
        for stage in (SHORTEST[code], ())
    )
    return next(filter(None, seen), "")


def _gate(
    project: Path, code: str, limit: float, selection: tuple[str, ...], settings: dict[str, str]
) -> str:
    """The verdict of the gate on a project, with an empty store."""
    words = ["gate", *selection, "--codes", code, "--level", "quick", "--require", code]
    with tempfile.TemporaryDirectory() as data:
        env = {**os.environ, "PYTHONPATH": str(project), "VV_DATA": data, **settings}
        try:
            done = subprocess.run(
                [sys.executable, "-m", "vv", *words, "--timeout", str(limit / 4), "--jobs", "1"],
                cwd=project, env=env, capture_output=True, check=False, timeout=limit,
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            return HANGS
    if done.returncode & (Bit.ACCURACY | Bit.CONSERVATION | Bit.CRASH):
        return f"exit {done.returncode}"
    return HANGS if done.returncode & Bit.TIMEOUT else ""


def mutated(each: int, files: str, project: Path) -> list[Question]:
    """The questions for mechanical mutants: in the copy with all of them if possible, or alone."""
    every = list(mechanical(each))
    numbers = build(project, every)
    asked = []
    for one in (mutant for mutant in every if fnmatch(mutant.file, files)):
        text, number = one.text(), numbers.get(one.what)
        ask = (
            _later(switched, project, one.codes, number)
            if number
            else _later(alone, one.file, one.codes, text)
        )
        asked.append(Question(one.what, one.codes, one.file + text, ask))
    return asked


def unharmed(project: Path) -> list[Question]:
    """The questions that must be green for every code: nothing changed, and no mutant on."""
    every = list(mechanical(1))
    codes = sorted({code for mutant in every for code in mutant.codes})
    first = {m.codes[0]: m.file for m in every}
    own = [
        Question(
            f"nothing, {code}", (code,), "", _later(alone, file, (code,), (ROOT / file).read_text())
        )
        for code, file in first.items()
    ]
    none = [
        Question(f"no mutant on, {code}", (code,), "", _later(switched, project, (code,), 0))
        for code in codes
    ]
    return own + none


def _later(ask: Callable[..., str], *given: object) -> Callable[[], str]:
    return functools.partial(ask, *given)


def answers(questions: Sequence[Question]) -> dict[str, str]:
    """The verdicts of the gate, with as many runs at a time as there are cores."""
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        told = {}
        for one, answer in zip(questions, pool.map(_asked_once, questions), strict=True):
            print(f"{answer or '-':<9} {' '.join(one.codes):<13} {one.what}", flush=True)
            told[one.what] = answer
    return told


def _asked_once(question: Question) -> str:
    """The verdict of the gate, new or stored; hangs, which load may cause, are not stored."""
    whole = f"{sources_digest()}{question.what}{question.changed}"
    kept = KEPT / "told" / hashlib.sha256(whole.encode()).hexdigest()
    if kept.is_file():
        return kept.read_text()
    answer = question.ask()
    if answer != HANGS:
        write_whole(kept, answer.encode())
    return answer


@functools.cache
def sources_digest() -> str:
    """The digest of all sources that a verdict depends on."""
    return source_digest([*sources(), *Path(__file__).parent.glob("*.py")])


def main() -> None:
    """Make mutants, run the gates, count the survivors and judge."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--each", type=int, default=10, help="mechanical mutants a kernel")
    parser.add_argument("--files", default="*", help="kernels, such as 'vv/engines/dem/*'")
    options = parser.parse_args()
    project = KEPT / "project"
    asked = mutated(options.each, options.files, project)
    red = [what for what, answer in answers(unharmed(project)).items() if answer]
    told = answers(asked)
    left = [what for what, answer in told.items() if not answer]
    figures = {
        "red without a mutant": red,
        "mechanical": len(told),
        "not caught": left,
        "hang": [what for what, answer in told.items() if answer == HANGS],
        "survival rate": len(left) / max(1, len(told)),
    }
    bars = {"5 % at most survive": 20 * len(left) <= len(told), "green without": not red}
    conclude("mutations", figures, bars)


if __name__ == "__main__":
    main()

"""Runs the quick gate of a code on a copy that contains mutants of the engines.

Branches between mutants keep the compiler from fusing products and sums, so that the last bits of
results differ from those of the project. Where impacts amplify this, results leave their accepted
bands even without a mutant. Such results are ignored; if a result is wrong or a law violated
without a mutant, the bench ends.
"""

import functools
import os
import resource
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as Xml
from collections.abc import Iterable
from pathlib import Path

from bench.mutation.in_copy.switch import NUMBER

SPENT = 200.0  # s of CPU time, many times the usual, after which a gate counts as hung
HANGS = "ends without a verdict"
MOVED = {
    "regression: moved",
    "regression: worse",
}  # kinds of changes since results were accepted

Red = tuple[str, str, str]  # case, judged quantity, kind of finding


def seeing(project: Path, codes: Iterable[str], number: int) -> str:
    """The code whose quick gate detects a mutant; '' if none does."""
    found = (f"gate of {code}" for code in codes if new_reds(project, code, number))
    return next(found, "")


def new_reds(project: Path, code: str, number: int) -> set[Red]:
    """The red findings at the gate of a code that appear only with a mutant."""
    return reds(project, code, number) - without_mutant(project, code)


@functools.cache
def without_mutant(project: Path, code: str) -> set[Red]:
    """The results that move without a mutant; ends the bench if any of them is wrong."""
    found = reds(project, code, 0)
    require_green([" ".join(red) for red in found if red[2] not in MOVED])
    print(f"gate of {code}: {len(found)} results that moved without a mutant are ignored")
    return found


def require_green(red: Iterable[str]) -> None:
    """End the bench if something is red without a mutant, since it would detect any mutant."""
    if named := ", ".join(red):
        raise SystemExit(f"red without a mutant, so that nothing can be judged: {named}")


def reds(project: Path, code: str, number: int) -> set[Red]:
    """All red findings at the quick gate of a code, with an empty store."""
    words = ["gate", "--codes", code, "--require", code, "--jobs", "1", "--timeout", "36000"]
    with tempfile.TemporaryDirectory() as data:
        junit = Path(data) / "gate.xml"
        env = {**os.environ, "PYTHONPATH": str(project), "VV_DATA": data, NUMBER: str(number)}
        subprocess.run(
            [sys.executable, "-m", "vv", *words, "--against", "cases/baselines", "--junit", junit],
            cwd=project, env=env, capture_output=True, check=False, preexec_fn=_limited,
        )  # fmt: skip
        return told(junit.read_text()) if junit.exists() else {("", "", HANGS)}


def told(junit: str) -> set[Red]:
    """The failures and errors in the JUnit file of the gate."""
    return {
        (test.get("classname", ""), test.get("name", ""), one.get("type", ""))
        for test in Xml.fromstring(junit).iter("testcase")
        for one in test
        if one.tag in ("failure", "error")
    }


def _limited() -> None:
    resource.setrlimit(resource.RLIMIT_CPU, (int(SPENT), int(SPENT)))

"""Puts a copy that holds mutants of the engines to the quick gate of a code.

Choices between mutants keep the compiler from joining products and sums to one instruction, so that
the last bits of a copy are not those of the project. Where impacts make that grow, results move
from what was accepted with no mutant on. Those that do say nothing of a mutant and are passed over;
that a result is wrong, or a law broken, without a mutant ends the bench.
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

from bench.mutation.switch import NUMBER

SPENT = 200.0  # s of CPU time after which a process of the gate hangs, many times what it takes
HANGS = "ends without a verdict"
MOVED = {"regression: moved", "regression: worse"}  # kinds of what differs from what was accepted

Red = tuple[str, str, str]  # case, what was judged of it, kind of finding


def seeing(project: Path, codes: Iterable[str], number: int) -> str:
    """The code whose quick gate sees a mutant; '' if there is none."""
    found = (f"gate of {code}" for code in codes if new_reds(project, code, number))
    return next(found, "")


def new_reds(project: Path, code: str, number: int) -> set[Red]:
    """What is red at the gate of a code with a mutant, and is not without."""
    return reds(project, code, number) - without_mutant(project, code)


@functools.cache
def without_mutant(project: Path, code: str) -> set[Red]:
    """What moved at the gate with no mutant on; ends the bench if anything is wrong there."""
    found = reds(project, code, 0)
    require_green([" ".join(red) for red in found if red[2] not in MOVED])
    print(f"gate of {code}: {len(found)} results moved by choices alone are passed over")
    return found


def require_green(red: Iterable[str]) -> None:
    """End the bench where something is red with no mutant on: it would see any mutant."""
    if named := ", ".join(red):
        raise SystemExit(f"red without a mutant, so that nothing is judged: {named}")


def reds(project: Path, code: str, number: int) -> set[Red]:
    """All that is red at the quick gate of a code, with an empty store."""
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
    """What the gate's JUnit file calls a failure or an error."""
    return {
        (test.get("classname", ""), test.get("name", ""), one.get("type", ""))
        for test in Xml.fromstring(junit).iter("testcase")
        for one in test
        if one.tag in ("failure", "error")
    }


def _limited() -> None:
    resource.setrlimit(resource.RLIMIT_CPU, (int(SPENT), int(SPENT)))

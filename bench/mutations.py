"""Seeds bugs one at a time and counts which the gate catches: plausible ones, then mechanical ones.

`python -m bench.mutations` runs all; `--seeded` the plausible bugs only; `--each N` sets how many
mechanical mutants a kernel gets; `--files PATTERN` which kernels. A bug is caught if the gate is
red for an answer that is wrong, gains energy, crashes or hangs; hangs are counted apart. The bar
is that the gate catches every seeded bug, and is green for every code without one. A whole run
takes hours: what the gate said is kept, and not asked again of the same sources.
"""

import argparse
import concurrent.futures
import functools
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from fnmatch import fnmatch
from pathlib import Path

from bench.evidence import conclude
from bench.mutants import ROOT, mechanical
from bench.seeded_bugs import BUGS, Bug
from vv.closure import source_digest
from vv.files import write
from vv.finding import Bit

CONTENT = ("vv", "adapters", "cases", "reference_solutions", "reports", "pyproject.toml")
HANGS = "hangs"
SPHERES, BLOCKS = ("single-contact",), ("responding-block:1d", "wedge:xi-1", "painleve")
SHORTEST = {"exact": SPHERES, "dem": SPHERES, "rigid": BLOCKS, "dda": BLOCKS}
QUICK = (
    "single-contact",
    "incline:newmark-35",
    "incline:two-directions",
    "responding-block:1d",
    "responding-block:3d",
    "bounce:again",
)
LONGER = {  # what else a code runs in less time uncompiled than all its kernels take to compile
    "dem": ("dashpot", "stable-bonds", "tetrahedral-path"),
    "rigid": ("at-yield", "implicit-swing", "standing"),
    "dda": ("at-yield", "implicit-swing", "shaken-fast"),
}
UNCOMPILED = {"NUMBA_DISABLE_JIT": "1"}
HASTILY = {"NUMBA_OPT": "1"}  # compiles in two thirds of the time; the solves are short
KEPT = ROOT / ".vv" / "mutants"  # what the gate said, a mutant a file


def caught(bug: Bug, text: str) -> str:
    """How the gate answers a copy of the project with a file changed: '' if it sees nothing."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder)
        for name in CONTENT:
            source = ROOT / name
            if source.is_dir():
                shutil.copytree(source, copy / name)
            else:
                shutil.copy(source, copy / name)
        (copy / bug.file).write_text(text)
        seen = (_gate(copy, bug.code, number, *s) for number, s in enumerate(_stages(bug.code)))
        return next(filter(None, seen), "")


def _stages(code: str) -> Iterator[tuple[tuple[str, ...], dict[str, str], float]]:
    """The shortest cases first, whose kernels need no compiling; for what survives them, all.

    With each the seconds after which it hangs: many times what it takes without a bug.
    """
    if code in SHORTEST:
        yield SHORTEST[code], UNCOMPILED, 60.0
    yield QUICK, UNCOMPILED, 120.0
    if code in LONGER:
        yield LONGER[code], UNCOMPILED, 240.0
    yield (), HASTILY, 120.0 if code == "exact" else 600.0


def _gate(
    copy: Path,
    code: str,
    number: int,
    selection: tuple[str, ...],
    settings: dict[str, str],
    limit: float,
) -> str:
    """What the gate says of the copy at a stage; a stage does not see what one before it kept."""
    words = ["gate", *selection, "--codes", code, "--level", "quick", "--require", code]
    data = str(copy / f"data-{number}")
    env = {**os.environ, "PYTHONPATH": str(copy), "VV_DATA": data, **settings}
    try:
        done = subprocess.run(
            [sys.executable, "-m", "vv", *words, "--timeout", str(limit / 4)],
            cwd=copy, env=env, capture_output=True, check=False, timeout=limit,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return HANGS
    if done.returncode & (Bit.ACCURACY | Bit.CONSERVATION | Bit.CRASH):
        return f"exit {done.returncode}"
    return HANGS if done.returncode & Bit.TIMEOUT else ""


def seeded() -> Iterator[tuple[Bug, str]]:
    """The plausible bugs with the changed text of their files."""
    for bug in BUGS:
        text = (ROOT / bug.file).read_text()
        if bug.old not in text:
            raise ValueError(f"{bug.what}: {bug.file} no longer holds {bug.old!r}")
        yield bug, text.replace(bug.old, bug.new, 1)


def answers(mutants: list[tuple[Bug, str]]) -> dict[str, str]:
    """What the gate says of each mutant, as many at a time as there are cores."""
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        told = {}
        for (bug, _), answer in zip(mutants, pool.map(_asked_once, mutants), strict=True):
            print(f"{answer or 'SURVIVES':<9} {bug.code:<9} {bug.what}", flush=True)
            told[bug.what] = answer
    return told


def _asked_once(mutant: tuple[Bug, str]) -> str:
    """What the gate says of a mutant, now or before; a hang may be a busy machine's fault."""
    bug, text = mutant
    kept = KEPT / hashlib.sha256(f"{_sources()}{bug.file}{text}".encode()).hexdigest()
    if kept.is_file():
        return kept.read_text()
    answer = caught(bug, text)
    if answer != HANGS:
        write(kept, answer.encode())
    return answer


@functools.cache
def _sources() -> str:
    """Digest of all that a verdict hangs on, and of how the gate is asked."""
    parts = [path for name in CONTENT for path in (ROOT / name, *(ROOT / name).rglob("*"))]
    kept = [path for path in parts if path.is_file() and path.suffix != ".pyc"]
    return source_digest([*kept, Path(__file__)])


def unharmed() -> list[tuple[Bug, str]]:
    """For every code a kernel as it is: what the gate must not see."""
    first = {bug.code: bug for bug in (*BUGS, *(bug for bug, _ in mechanical(1)))}
    return [
        (Bug(f"nothing, {code}", bug.file, code, "", ""), (ROOT / bug.file).read_text())
        for code, bug in first.items()
    ]


def main() -> None:
    """Seed, count and judge."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seeded", action="store_true", help="the plausible bugs only")
    parser.add_argument("--each", type=int, default=10, help="mechanical mutants a kernel")
    parser.add_argument("--files", default="*", help="kernels to mutate, such as 'vv/dem/*'")
    options = parser.parse_args()
    figures: dict[str, object] = {}
    control = {bug.what: caught(bug, text) for bug, text in unharmed()}
    plausible = answers(list(seeded()))
    escaped = [what for what, answer in plausible.items() if answer in ("", HANGS)]
    red = [what for what, answer in control.items() if answer]
    figures |= {"seeded": len(plausible), "seeded, not caught": escaped, "red without a bug": red}
    if not options.seeded:
        wanted = [m for m in mechanical(options.each) if fnmatch(m[0].file, options.files)]
        told = answers(wanted)
        left = [what for what, answer in told.items() if not answer]
        figures |= {
            "mechanical": len(told),
            "mechanical, not caught": left,
            "mechanical, hang": [what for what, answer in told.items() if answer == HANGS],
            "survival rate": len(left) / len(told),
        }
    bars = {"the gate catches every seeded bug": not escaped, "and is green without": not red}
    conclude("mutations", figures, bars)


if __name__ == "__main__":
    main()

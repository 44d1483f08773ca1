"""Seeds bugs one at a time and counts which the gate catches: plausible ones, then mechanical ones.

`python -m bench.mutations` runs all; `--seeded` the plausible bugs only; `--each N` sets how many
mechanical mutants a kernel gets; `--files PATTERN` which kernels. A bug is caught if the gate is
red for an answer that is wrong, gains energy, crashes or hangs; hangs are counted apart. The bar
is that the gate catches every seeded bug, and is green for every code without one.
"""

import argparse
import ast
import concurrent.futures
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from fnmatch import fnmatch
from pathlib import Path

from bench.evidence import conclude
from bench.seeded_bugs import BUGS, Bug
from vv.closure import closure
from vv.finding import Bit
from vv.keys import roots
from vv.project import find

ROOT = Path(__file__).resolve().parents[1]
CONTENT = ("vv", "adapters", "cases", "reference_solutions", "reports", "pyproject.toml")
COMPILED = re.compile(r"^@(?:compiled|called|inlined)\b", re.MULTILINE)
BY_EVENTS = (  # the kernels of `exact`, which compiles none
    "bonds", "clock", "flow", "ledger", "modes", "path", "roots", "slide", "slide_ledger",
    "slide_path", "slider", "system",
)  # fmt: skip
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
UNCOMPILED = {"NUMBA_DISABLE_JIT": "1"}
SWAPS: dict[type, type] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.Lt: ast.GtE,
    ast.LtE: ast.Gt,
    ast.Gt: ast.LtE,
    ast.GtE: ast.Lt,
    ast.And: ast.Or,
    ast.Or: ast.And,
    ast.USub: ast.UAdd,
}  # fmt: skip
SYMBOLS = {
    ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Lt: "<", ast.LtE: "<=",
    ast.Gt: ">", ast.GtE: ">=", ast.And: "and", ast.Or: "or", ast.USub: "-", ast.UAdd: "+",
}  # fmt: skip


def caught(bug: Bug, text: str) -> str:
    """How the gate answers a copy of the project with a file changed: '' if it sees nothing."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder)
        for name in CONTENT:
            source = ROOT / name
            if source.is_dir():
                shutil.copytree(source, copy / name, ignore=shutil.ignore_patterns("__pycache__"))
            else:
                shutil.copy(source, copy / name)
        (copy / bug.file).write_text(text)
        seen = (_gate(copy, bug.code, number, *s) for number, s in enumerate(_stages(bug.code)))
        return next(filter(None, seen), "")


def _stages(code: str) -> Iterator[tuple[tuple[str, ...], dict[str, str]]]:
    """The shortest cases first, whose kernels need no compiling; for what survives them, all."""
    yield SHORTEST.get(code, QUICK), UNCOMPILED
    yield QUICK, UNCOMPILED
    yield (), {}


def _gate(
    copy: Path, code: str, number: int, selection: tuple[str, ...], settings: dict[str, str]
) -> str:
    """What the gate says of the copy at a stage; a stage does not see what one before it kept."""
    words = ["gate", *selection, "--codes", code, "--level", "quick", "--require", code]
    data = str(copy / f"data-{number}")
    env = {**os.environ, "PYTHONPATH": str(copy), "VV_DATA": data, **settings}
    try:
        done = subprocess.run(
            [sys.executable, "-m", "vv", *words, "--timeout", "60"],
            cwd=copy, env=env, capture_output=True, check=False, timeout=300,
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


def kernels() -> dict[str, str]:
    """File -> code: all that is compiled, with the first code that it is part of."""
    project = find(ROOT)
    found = {f"vv/exact/{name}.py": "exact" for name in BY_EVENTS}
    for code in ("dem", "rigid", "dda"):
        for path in closure(project.adapter_files(code), roots(project)):
            if path.suffix == ".py" and COMPILED.search(path.read_text()):
                found.setdefault(path.relative_to(ROOT).as_posix(), code)
    return found


def mechanical(each: int) -> Iterator[tuple[Bug, str]]:
    """Operators turned and constants moved, a fixed random choice of `each` in every kernel."""
    for file, code in kernels().items():
        tree = ast.parse((ROOT / file).read_text())
        sites = [node for node in ast.walk(tree) if _turnable(node)]
        for node in random.Random(file).sample(sites, min(each, len(sites))):
            yield _turned(tree, node, file, code)


def _turnable(node: ast.AST) -> bool:
    if isinstance(node, ast.Constant):
        return isinstance(node.value, float) and node.value != 0.0
    if isinstance(node, ast.Compare):
        return type(node.ops[0]) in SWAPS
    return isinstance(node, ast.BinOp | ast.BoolOp | ast.UnaryOp) and type(node.op) in SWAPS


def _turned(tree: ast.Module, node: ast.AST, file: str, code: str) -> tuple[Bug, str]:
    """The file's text with one node changed; the tree is left as it was."""
    where = f"{file}:{getattr(node, 'lineno', 0)}:{getattr(node, 'col_offset', 0)}"
    if isinstance(node, ast.Constant):
        value = node.value
        assert isinstance(value, float)
        node.value = 1.1 * value
        text, what = ast.unparse(tree), f"{where} {value} -> {node.value}"
        node.value = value
    elif isinstance(node, ast.Compare):
        kept = node.ops[0]
        node.ops[0] = SWAPS[type(kept)]()
        text, what = ast.unparse(tree), f"{where} {_arrow(kept, node.ops[0])}"
        node.ops[0] = kept
    else:
        assert isinstance(node, ast.BinOp | ast.BoolOp | ast.UnaryOp)
        old = node.op
        node.op = SWAPS[type(old)]()
        text, what = ast.unparse(tree), f"{where} {_arrow(old, node.op)}"
        node.op = old
    return Bug(what, file, code, "", ""), text


def _arrow(old: ast.AST, new: ast.AST) -> str:
    return f"{SYMBOLS[type(old)]} -> {SYMBOLS[type(new)]}"


def answers(mutants: list[tuple[Bug, str]]) -> dict[str, str]:
    """What the gate says of each mutant, two at a time."""
    told = {}
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        every = pool.map(lambda mutant: caught(*mutant), mutants)
        for (bug, _), answer in zip(mutants, every, strict=True):
            print(f"{answer or 'SURVIVES':<9} {bug.code:<9} {bug.what}", flush=True)
            told[bug.what] = answer
    return told


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
    control, plausible = answers(unharmed()), answers(list(seeded()))
    escaped = [what for what, answer in plausible.items() if not answer]
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

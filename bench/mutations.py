"""Seeds bugs one at a time and counts which the gate catches: plausible ones, then mechanical ones.

`python -m bench.mutations` runs all; `--seeded` the plausible bugs only; `--each N` sets how many
mechanical mutants a kernel gets. The bar is that the gate catches every seeded bug.
"""

import argparse
import ast
import concurrent.futures
import os
import random
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from bench.evidence import conclude
from bench.seeded_bugs import BUGS, Bug

ROOT = Path(__file__).parents[1]
CONTENT = ("vv", "adapters", "cases", "reference_solutions", "reports", "pyproject.toml")
KERNELS = {  # code: folder, files
    "dem": (
        "vv/dem",
        ("line_kernel", "space_kernel", "pressed_kernel", "driven", "contact_law", "friction",
         "advance"),
    ),
    "exact": (
        "vv/exact",
        ("flow", "modes", "roots", "path", "clock", "slide", "slide_path", "slider"),
    ),
    "dda": ("vv/blocks", ("dda_point_kernel", "dda_law")),
    "rigid": ("vv/blocks", ("point_kernel", "point_trial", "slip")),
}  # fmt: skip
QUICKEST = (
    "single-contact",
    "incline:newmark-35",
    "incline:two-directions",
    "responding-block:1d",
    "responding-block:3d",
    "bounce:again",
)
# First the short cases, where kernels need no compiling; then, for what survives that, all.
STAGES: tuple[tuple[tuple[str, ...], dict[str, str]], ...] = (
    (QUICKEST, {"NUMBA_DISABLE_JIT": "1"}),
    ((), {}),
)
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
        return next((seen for stage in STAGES if (seen := _gate(copy, bug.code, *stage))), "")


def _gate(copy: Path, code: str, selection: tuple[str, ...], settings: dict[str, str]) -> str:
    words = ["gate", *selection, "--codes", code, "--level", "quick", "--require", code]
    env = {**os.environ, "PYTHONPATH": str(copy), "VV_DATA": str(copy / "data"), **settings}
    try:
        done = subprocess.run(
            [sys.executable, "-m", "vv", *words, "--timeout", "60"],
            cwd=copy, env=env, capture_output=True, check=False, timeout=300,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return "hangs"
    return f"exit {done.returncode}" if done.returncode else ""


def seeded() -> Iterator[tuple[Bug, str]]:
    """The plausible bugs with the changed text of their files."""
    for bug in BUGS:
        text = (ROOT / bug.file).read_text()
        if bug.old not in text:
            raise ValueError(f"{bug.what}: {bug.file} no longer holds {bug.old!r}")
        yield bug, text.replace(bug.old, bug.new, 1)


def mechanical(each: int) -> Iterator[tuple[Bug, str]]:
    """Operators turned and constants moved, a fixed random choice of `each` in every kernel."""
    for code, (folder, names) in KERNELS.items():
        for name in names:
            file = f"{folder}/{name}.py"
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
    where = f"{file}:{getattr(node, 'lineno', 0)}"
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


def survivors(mutants: list[tuple[Bug, str]]) -> list[str]:
    """What the gate does not see, of a list of mutants, two at a time."""
    left = []
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        answers = pool.map(lambda mutant: caught(*mutant), mutants)
        for (bug, _), answer in zip(mutants, answers, strict=True):
            print(f"{answer or 'SURVIVES':<9} {bug.code:<9} {bug.what}", flush=True)
            left += [] if answer else [bug.what]
    return left


def main() -> None:
    """Seed, count and judge."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seeded", action="store_true", help="the plausible bugs only")
    parser.add_argument("--each", type=int, default=10, help="mechanical mutants a kernel")
    options = parser.parse_args()
    plausible = list(seeded())
    plain = caught(
        Bug("nothing", "vv/dem/line_kernel.py", "dem", "", ""),
        (ROOT / "vv/dem/line_kernel.py").read_text(),
    )
    escaped = survivors(plausible)
    figures = {"seeded": len(plausible), "seeded, not caught": escaped, "without a bug": plain}
    if not options.seeded:
        mutants = list(mechanical(options.each))
        left = survivors(mutants)
        figures["mechanical"] = len(mutants)
        figures["mechanical, not caught"] = left
        figures["survival rate"] = len(left) / len(mutants)
    bars = {"the gate catches every seeded bug": not escaped, "and is green without": not plain}
    conclude("mutations", figures, bars)


if __name__ == "__main__":
    main()

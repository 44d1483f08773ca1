"""Mechanical mutants of the kernels: operators turned, constants moved, one at a time."""

import ast
import random
import re
from collections.abc import Iterator
from pathlib import Path

from bench.seeded_bugs import Bug
from vv.closure import closure
from vv.keys import roots
from vv.project import find

ROOT = Path(__file__).resolve().parents[1]
COMPILED = re.compile(r"^@(?:compiled|called|inlined)\b", re.MULTILINE)
BY_EVENTS = (  # the kernels of `exact`, which compiles none
    "bonds", "clock", "flow", "ledger", "modes", "path", "roots", "slide", "slide_ledger",
    "slide_path", "slider", "system",
)  # fmt: skip
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
    """Operators turned and constants moved, a fixed random choice of `each` in every kernel.

    The first of every kernel comes before the second of any: a run that is cut tells of all.
    """
    found = kernels()
    trees = {file: ast.parse((ROOT / file).read_text()) for file in found}
    chosen = {file: _chosen(file, tree)[:each] for file, tree in trees.items()}
    for turn in range(each):
        for file, nodes in chosen.items():
            if turn < len(nodes):
                yield _turned(trees[file], nodes[turn], file, found[file])


def _chosen(file: str, tree: ast.Module) -> list[ast.AST]:
    """All that can be turned in a file, in a random order of its own."""
    sites = [node for node in ast.walk(tree) if _turnable(node)]
    return random.Random(file).sample(sites, len(sites))


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

"""Makes mechanical mutants of the kernels: one changed operator or constant each."""

import ast
import copy
import functools
import random
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

from vv.base.closure import import_closure
from vv.plan.keys import roots
from vv.plan.project import find

ROOT = Path(__file__).resolve().parents[2]
KINDS = "compiled(?:_to_branch|_to_join)?|called|inlined|inlined_called|lent|shared"
COMPILED = re.compile(rf"^@(?:{KINDS})\b", re.MULTILINE)
BESIDE = (  # computations of `exact` outside its kernels
    "bonds", "flow", "ledger", "path", "system",
    "slide/clock", "slide/flow", "slide/ledger", "slide/path", "slide/system",
    "turn/ledger", "turn/path",
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


class Mutant(NamedTuple):
    """A mutant of a kernel: the change in words, its file, its codes, the index in ast.walk."""

    what: str
    file: str
    codes: tuple[str, ...]
    place: int

    def text(self) -> str:
        """The text of the mutated file."""
        tree = copy.deepcopy(parsed(self.file))
        node = list(ast.walk(tree))[self.place]
        changed = turned(node)
        for name, value in vars(changed).items():
            setattr(node, name, value)
        return ast.unparse(tree)


@functools.cache
def kernels() -> dict[str, tuple[str, ...]]:
    """File -> codes: all compiled files, with the codes that contain them."""
    project = find(ROOT)
    exact = [f"vv/engines/exact/{name}.py" for name in BESIDE]
    found: dict[str, tuple[str, ...]] = dict.fromkeys(exact, ("exact",))
    for code in ("dem", "rigid", "dda", "exact"):
        for path in import_closure(project.adapter_files(code), roots(project)):
            if path.suffix == ".py" and COMPILED.search(path.read_text()):
                name = path.relative_to(ROOT).as_posix()
                found[name] = (*found.get(name, ()), code)
    return found


@functools.cache
def parsed(file: str) -> ast.Module:
    """The syntax tree of a file, which must not be changed."""
    return ast.parse((ROOT / file).read_text())


def mechanical(each: int) -> Iterator[Mutant]:
    """A fixed random choice of `each` mutants in every kernel.

    The first mutants of all kernels precede the second ones, so that a partial run covers all.
    """
    chosen = {file: _chosen(file)[:each] for file in kernels()}
    for turn in range(each):
        for file, places in chosen.items():
            if turn < len(places):
                node = list(ast.walk(parsed(file)))[places[turn]]
                yield Mutant(_what(file, node), file, kernels()[file], places[turn])


def all_places(files: Iterable[str]) -> Iterator[Mutant]:
    """All mutants in files, compiled or not, in the order of files and places."""
    for file in files:
        nodes = list(ast.walk(parsed(file)))
        for place in sorted(_chosen(file)):
            yield Mutant(_what(file, nodes[place]), file, (), place)


def _chosen(file: str) -> list[int]:
    """The indices of all nodes of a file that can be mutated, in a random order."""
    sites = [place for place, node in enumerate(ast.walk(parsed(file))) if _turnable(node)]
    return random.Random(file).sample(sites, len(sites))


def _turnable(node: ast.AST) -> bool:
    if isinstance(node, ast.Constant):
        return isinstance(node.value, float) and node.value != 0.0
    if isinstance(node, ast.Compare):
        return type(node.ops[0]) in SWAPS
    return isinstance(node, ast.BinOp | ast.BoolOp | ast.UnaryOp) and type(node.op) in SWAPS


def turned(node: ast.AST) -> ast.expr:
    """A mutated copy of a node."""
    made = copy.deepcopy(node)
    if isinstance(made, ast.Constant):
        assert isinstance(made.value, float)
        made.value = 1.1 * made.value
    elif isinstance(made, ast.Compare):
        made.ops[0] = SWAPS[type(made.ops[0])]()
    else:
        assert isinstance(made, ast.BinOp | ast.BoolOp | ast.UnaryOp)
        made.op = SWAPS[type(made.op)]()
    return made


def _what(file: str, node: ast.AST) -> str:
    """The place of a node, from its start to its end, and its change.

    The end is needed, since in a * b * c two products start at one place.
    """
    columns = f"{getattr(node, 'col_offset', 0)}-{getattr(node, 'end_col_offset', 0)}"
    where = f"{file}:{getattr(node, 'lineno', 0)}:{columns}"
    return f"{where} {_word(node)} -> {_word(turned(node))}"


def _word(node: ast.AST) -> str:
    if isinstance(node, ast.Constant):
        return str(node.value)
    if isinstance(node, ast.Compare):
        return SYMBOLS[type(node.ops[0])]
    assert isinstance(node, ast.BinOp | ast.BoolOp | ast.UnaryOp)
    return SYMBOLS[type(node.op)]

"""What can be turned outside the engines: one operator, constant or call of a file at a time."""

import ast
import copy
import functools
import itertools
import random
from collections.abc import Iterator
from fnmatch import fnmatch
from pathlib import Path
from typing import NamedTuple

from bench.mutation.mutants import ROOT, parsed

LAYERS = (
    "vv/ask", "vv/base", "vv/case", "vv/cli", "vv/codes", "vv/gate", "vv/scaling", "vv/insight",
    "vv/output", "vv/plan", "vv/records", "vv/run", "vv/scene", "vv/standins", "vv/store",
    "adapters", "reports",
)  # fmt: skip
PARTS = {"framework": LAYERS, "references": ("reference_solutions",)}
EVERY = 10**6  # more than there are
SWAPS: dict[type, type] = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult,
    ast.Lt: ast.GtE, ast.LtE: ast.Gt, ast.Gt: ast.LtE, ast.GtE: ast.Lt,
    ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
    ast.In: ast.NotIn, ast.NotIn: ast.In, ast.And: ast.Or, ast.Or: ast.And,
}  # fmt: skip
NAMES = {"min": "max", "max": "min", "any": "all", "all": "any"}
EQUIVALENT = Path(__file__).parent / "equivalent.txt"
Function = ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda


class Mutant(NamedTuple):
    """A node of a file, by its place in ast.walk."""

    file: str
    place: int

    @property
    def what(self) -> str:
        """Where it is, and what it is."""
        return f"{self.file}:{self.node.lineno} {self.change}"

    @property
    def key(self) -> str:
        """What it is, by names instead of lines, which other changes move."""
        return named(self.file, self.node, _turned(self.node))

    @property
    def change(self) -> str:
        """What is there, and what becomes of it."""
        return _change(self.node, _turned(self.node))

    @property
    def node(self) -> ast.expr:
        """What is turned."""
        return _sites(self.file)[self.place]

    @property
    def lines(self) -> range:
        """All lines of the statement that it is part of, without the statements inside that."""
        first, last = _statement(self.file, self.node)
        return range(first, last + 1)

    @property
    def when_called(self) -> bool:
        """Whether it runs when a function is called, and not when the file is imported."""
        return any(self.node in body for body in _bodies(self.file))

    def tree(self) -> ast.Module:
        """The file with this node turned, every line where it was."""
        tree = copy.deepcopy(parsed(self.file))
        node = list(ast.walk(tree))[self.place]
        vars(node).update(vars(_turned(node)))
        return ast.fix_missing_locations(tree)

    def text(self) -> str:
        """The file with this node turned."""
        return ast.unparse(self.tree())


def mutants(layer: str, files: str, each: int) -> Iterator[Mutant]:
    """At most so many of every file of a layer that the pattern names, none known as equivalent."""
    for path in sorted((ROOT / layer).rglob("*.py")):
        file = path.relative_to(ROOT).as_posix()
        if fnmatch(file, files):
            sites = [one for one in turnable(file) if one.key not in equivalents()]
            yield from sorted(random.Random(file).sample(sites, min(each, len(sites))))


def turnable(file: str) -> list[Mutant]:
    """All that can be turned in a file, with what is known as equivalent."""
    return [Mutant(file, place) for place in _sites(file)]


def drawn(files: str, each: int, sample: int, part: str = "framework") -> list[Mutant]:
    """Mutants in a random order that goes through the layers in turn, at most so many."""
    piles = [list(mutants(layer, files, each)) for layer in PARTS[part]]
    for layer, pile in zip(PARTS[part], piles, strict=True):
        random.Random(layer).shuffle(pile)
    turns = itertools.zip_longest(*piles)
    return [one for turn in turns for one in turn if one is not None][:sample]


def uniform(files: str, sample: int, seed: int, part: str = "framework") -> list[Mutant]:
    """So many mutants, each place of a part that can be turned being as likely as any other."""
    every = [one for layer in PARTS[part] for one in mutants(layer, files, EVERY)]
    return random.Random(seed).sample(every, min(sample, len(every)))


def named(file: str, node: ast.AST, made: ast.AST) -> str:
    """What becomes of a node of a file, by the functions that it is in instead of its line."""
    return f"{file} {_owner(file, node)}: {_change(node, made)}"


def _change(node: ast.AST, made: ast.AST) -> str:
    return f"{ast.unparse(node)[:90]}  ->  {ast.unparse(made)[:90]}"


@functools.cache
def equivalents() -> dict[str, str]:
    """Keys of mutants that no test can tell from the original -> why."""
    lines = [line for line in EQUIVALENT.read_text().splitlines() if line and line[0] != "#"]
    told = [line.split("  # ") for line in lines]
    return {key.rstrip(): why for key, why in told}


@functools.cache
def _sites(file: str) -> dict[int, ast.expr]:
    found = enumerate(ast.walk(parsed(file)))
    return {i: node for i, node in found if isinstance(node, ast.expr) and _turnable(node)}


@functools.cache
def _bodies(file: str) -> list[set[ast.AST]]:
    """All nodes in the body of each function, of which none is inside another in the list."""
    functions = [one for one in ast.walk(parsed(file)) if isinstance(one, Function)]
    return [{node for part in _body(one) for node in ast.walk(part)} for one in functions]


def _body(function: Function) -> list[ast.AST]:
    return [function.body] if isinstance(function, ast.Lambda) else [*function.body]


def _statement(file: str, node: ast.AST) -> tuple[int, int]:
    """First and last line of what runs with a node: its statement's, or the head of a compound."""
    holding = [one for one in ast.walk(parsed(file)) if isinstance(one, ast.stmt)
               and any(inner is node for inner in ast.walk(one))]  # fmt: skip
    own = holding[-1]  # ast.walk goes from the outside in
    inner = [one.lineno for one in ast.walk(own) if isinstance(one, ast.stmt) and one is not own]
    last = getattr(own, "end_lineno", own.lineno)
    return own.lineno, max(min([last, *(line - 1 for line in inner)]), own.lineno)


@functools.cache
def _owner(file: str, node: ast.AST) -> str:
    """The functions and classes that a node is in, from the outside."""
    kinds = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef
    around = [one.name for one in ast.walk(parsed(file)) if isinstance(one, kinds)
              and any(inner is node for inner in ast.walk(one))]  # fmt: skip
    return ".".join(around) or "-"


def _turnable(node: ast.AST) -> bool:
    if isinstance(node, ast.Compare):
        return type(node.ops[0]) in SWAPS
    if isinstance(node, ast.BinOp):
        words = any(isinstance(side, ast.Constant | ast.JoinedStr) and not _is_number(side)
                    for side in (node.left, node.right))  # fmt: skip
        return type(node.op) in SWAPS and not words
    if isinstance(node, ast.Constant):
        return isinstance(node.value, float) and node.value != 0.0
    if isinstance(node, ast.Call):
        return isinstance(node.func, ast.Name) and node.func.id in NAMES
    return isinstance(node, ast.BoolOp) or (
        isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not)
    )


def _is_number(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, int | float)


def _turned(node: ast.AST) -> ast.AST:
    made = copy.deepcopy(node)
    if isinstance(made, ast.Compare):
        made.ops[0] = SWAPS[type(made.ops[0])]()
    elif isinstance(made, ast.BinOp | ast.BoolOp):
        made.op = SWAPS[type(made.op)]()
    elif isinstance(made, ast.Constant):
        assert isinstance(made.value, float)
        made.value = 1.5 * made.value
    elif isinstance(made, ast.Call):
        assert isinstance(made.func, ast.Name)
        made.func.id = NAMES[made.func.id]
    elif isinstance(made, ast.UnaryOp):  # not x: x itself, as a truth
        made.op, made.operand = ast.Not(), ast.UnaryOp(ast.Not(), made.operand)
    return made

"""Finds the mutants outside the engines: one operator, constant or call of a file each."""

import ast
import copy
import functools
import itertools
import random
import re
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
EVERY = 10**6  # more than there are files
SWAPS: dict[type, type] = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult,
    ast.Lt: ast.GtE, ast.LtE: ast.Gt, ast.Gt: ast.LtE, ast.GtE: ast.Lt,
    ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
    ast.In: ast.NotIn, ast.NotIn: ast.In, ast.And: ast.Or, ast.Or: ast.And,
}  # fmt: skip
NAMES = {"min": "max", "max": "min", "any": "all", "all": "any"}
EQUIVALENT = Path(__file__).parent / "equivalent.txt"
KIND = "~"  # begins a line that names all mutants whose keys match a regular expression
Function = ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda


class Mutant(NamedTuple):
    """A mutant: a node of a file, by its index in ast.walk."""

    file: str
    place: int

    @property
    def what(self) -> str:
        """The place and the change, in words."""
        return f"{self.file}:{self.node.lineno} {self.change}"

    @property
    def key(self) -> str:
        """A key made of names instead of line numbers, which other changes would move."""
        return named(self.file, self.node, _turned(self.node))

    @property
    def change(self) -> str:
        """The original and the mutated expression."""
        return _change(self.node, _turned(self.node))

    @property
    def node(self) -> ast.expr:
        """The node that is mutated."""
        return _sites(self.file)[self.place]

    @property
    def lines(self) -> range:
        """The lines of its statement, without those of nested statements."""
        first, last = _statement(self.file, self.node)
        return range(first, last + 1)

    @property
    def when_called(self) -> bool:
        """Whether it runs when a function is called, and not at import."""
        return any(self.node in body for body in _bodies(self.file))

    def tree(self) -> ast.Module:
        """The syntax tree of the mutated file, with unchanged line numbers."""
        tree = copy.deepcopy(parsed(self.file))
        node = list(ast.walk(tree))[self.place]
        vars(node).update(vars(_turned(node)))
        return ast.fix_missing_locations(tree)

    def text(self) -> str:
        """The text of the mutated file."""
        return ast.unparse(self.tree())


def mutants(layer: str, files: str, each: int) -> Iterator[Mutant]:
    """The mutants of matching files, at most `each` per file, without equivalent ones."""
    for path in sorted((ROOT / layer).rglob("*.py")):
        file = path.relative_to(ROOT).as_posix()
        if fnmatch(file, files):
            sites = [one for one in turnable(file) if not is_equivalent(one.key)]
            yield from sorted(random.Random(file).sample(sites, min(each, len(sites))))


def turnable(file: str) -> list[Mutant]:
    """All mutants of a file, equivalent ones included."""
    return [Mutant(file, place) for place in _sites(file)]


def drawn(files: str, each: int, sample: int, part: str = "framework") -> list[Mutant]:
    """At most so many mutants, in a random order that takes the layers in turn."""
    piles = [list(mutants(layer, files, each)) for layer in PARTS[part]]
    for layer, pile in zip(PARTS[part], piles, strict=True):
        random.Random(layer).shuffle(pile)
    turns = itertools.zip_longest(*piles)
    return [one for turn in turns for one in turn if one is not None][:sample]


def uniform(files: str, sample: int, seed: int, part: str = "framework") -> list[Mutant]:
    """A random sample of mutants, drawn from all places of a part with equal probability."""
    every = [one for layer in PARTS[part] for one in mutants(layer, files, EVERY)]
    return random.Random(seed).sample(every, min(sample, len(every)))


def named(file: str, node: ast.AST, made: ast.AST) -> str:
    """The change of a node, with the enclosing functions in place of its line."""
    return f"{file} {_owner(file, node)}: {_change(node, made)}"


def _change(node: ast.AST, made: ast.AST) -> str:
    return f"{ast.unparse(node)[:90]}  ->  {ast.unparse(made)[:90]}"


def is_equivalent(key: str) -> bool:
    """Whether a mutant is known to behave like the original, by itself or by its kind."""
    return key in equivalents() or any(re.fullmatch(kind, key) for kind in equivalent_kinds())


@functools.cache
def equivalents() -> dict[str, str]:
    """Key of a mutant that behaves like the original -> the reason."""
    return {key: why for key, why in _told() if key[0] != KIND}


@functools.cache
def equivalent_kinds() -> dict[str, str]:
    """Pattern of the keys of mutants that behave like the original -> the reason."""
    return {key[1:].lstrip(): why for key, why in _told() if key[0] == KIND}


def _told() -> Iterator[tuple[str, str]]:
    lines = [line for line in EQUIVALENT.read_text().splitlines() if line and line[0] != "#"]
    for key, why in (line.split("  # ") for line in lines):
        yield key.rstrip(), why


@functools.cache
def _sites(file: str) -> dict[int, ast.expr]:
    found = enumerate(ast.walk(parsed(file)))
    return {i: node for i, node in found if isinstance(node, ast.expr) and _turnable(node)}


@functools.cache
def _bodies(file: str) -> list[set[ast.AST]]:
    """The nodes in the body of each function."""
    functions = [one for one in ast.walk(parsed(file)) if isinstance(one, Function)]
    return [{node for part in _body(one) for node in ast.walk(part)} for one in functions]


def _body(function: Function) -> list[ast.AST]:
    return [function.body] if isinstance(function, ast.Lambda) else [*function.body]


def _statement(file: str, node: ast.AST) -> tuple[int, int]:
    """The first and last line of the statement of a node, or of the head of a compound one."""
    holding = [one for one in ast.walk(parsed(file)) if isinstance(one, ast.stmt)
               and any(inner is node for inner in ast.walk(one))]  # fmt: skip
    own = holding[-1]  # ast.walk visits outer nodes first
    inner = [one.lineno for one in ast.walk(own) if isinstance(one, ast.stmt) and one is not own]
    last = getattr(own, "end_lineno", own.lineno)
    return own.lineno, max(min([last, *(line - 1 for line in inner)]), own.lineno)


@functools.cache
def _owner(file: str, node: ast.AST) -> str:
    """The enclosing functions and classes of a node, outermost first."""
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
    elif isinstance(made, ast.UnaryOp):  # `not x` becomes the truth value of x
        made.op, made.operand = ast.Not(), ast.UnaryOp(ast.Not(), made.operand)
    return made

"""Turns one operator of the framework at a time, and counts what its own tests do not see.

`python -m bench.mutation.framework_mutants` takes every place that can be turned outside the
engines; `--files 'vv/gate/*'` some, `--each N` at most N a file, `--sample N` so many of all, the
same number in every layer as far as it goes, fixed random choices; with `--seed K` they are drawn
from all places alike, so that what survives of them is an estimate for the whole, with its
confidence: `--all --sample 100 --seed 1`. A mutant is put to the tests of
its layer that start no process, first to the files that name its module, and, with `--all`, to the
others too if it survives those. What is red counts if it is green without the mutant. One process
is forked for each from one that has the libraries.
"""

import argparse
import ast
import copy
import importlib
import itertools
import random
import re
import tempfile
from collections.abc import Iterator
from fnmatch import fnmatch
from pathlib import Path
from typing import NamedTuple

from scipy.stats import binomtest

from bench.evidence import conclude
from bench.mutation.forked_tests import green, passes, rewrite, with_tests
from bench.mutation.mutants import ROOT, parsed
from bench.mutation.schemata import copied

LAYERS = (
    "vv/ask", "vv/base", "vv/case", "vv/cli", "vv/codes", "vv/gate", "vv/growth", "vv/insight",
    "vv/output", "vv/plan", "vv/records", "vv/run", "vv/scene", "vv/standins", "vv/store",
    "adapters", "reports",
)  # fmt: skip
EVERY = 10**6  # more than there are
MORE = {
    "cli": ("run",),
    "records": ("insight",),
    "case": ("records",),
    "ask": ("case", "records"),
}  # layers that test it
NEEDS = ("numpy", "scipy.optimize", "hypothesis.strategies", "jsonschema", "tomllib")
SWAPS: dict[type, type] = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult,
    ast.Lt: ast.GtE, ast.LtE: ast.Gt, ast.Gt: ast.LtE, ast.GtE: ast.Lt,
    ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
    ast.In: ast.NotIn, ast.NotIn: ast.In, ast.And: ast.Or, ast.Or: ast.And,
}  # fmt: skip
NAMES = {"min": "max", "max": "min", "any": "all", "all": "any"}


class Mutant(NamedTuple):
    """A node of a file, by its place in ast.walk."""

    file: str
    place: int

    @property
    def what(self) -> str:
        """Where it is, and what it is."""
        node = list(ast.walk(parsed(self.file)))[self.place]
        line = getattr(node, "lineno", 0)
        return f"{self.file}:{line} {ast.unparse(node)[:90]}  ->  {ast.unparse(_turned(node))[:90]}"

    def text(self) -> str:
        """The file with this node turned."""
        tree = copy.deepcopy(parsed(self.file))
        node = list(ast.walk(tree))[self.place]
        vars(node).update(vars(_turned(node)))
        return ast.unparse(tree)


def mutants(layer: str, files: str, each: int) -> Iterator[Mutant]:
    """At most so many of every file of a layer that the pattern names."""
    for path in sorted((ROOT / layer).rglob("*.py")):
        file = path.relative_to(ROOT).as_posix()
        if fnmatch(file, files):
            sites = [i for i, node in enumerate(ast.walk(parsed(file))) if _turnable(node)]
            chosen = random.Random(file).sample(sites, min(each, len(sites)))
            yield from (Mutant(file, place) for place in sorted(chosen))


def drawn(files: str, each: int, sample: int) -> list[Mutant]:
    """Mutants in a random order that goes through the layers in turn, at most so many."""
    piles = [list(mutants(layer, files, each)) for layer in LAYERS]
    for layer, pile in zip(LAYERS, piles, strict=True):
        random.Random(layer).shuffle(pile)
    turns = itertools.zip_longest(*piles)
    return [one for turn in turns for one in turn if one is not None][:sample]


def uniform(files: str, sample: int, seed: int) -> list[Mutant]:
    """So many mutants, each place that can be turned being as likely as any other."""
    every = [one for layer in LAYERS for one in mutants(layer, files, EVERY)]
    return random.Random(seed).sample(every, min(sample, len(every)))


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


def seen_by(project: Path, mutant: Mutant, stages: tuple[bool, ...]) -> tuple[str, bool] | None:
    """The tests that turn red, and whether they are those that start processes; None: no tests."""
    place = project / mutant.file
    rewrite(place, mutant.text())
    try:
        asked = ((one, processes) for processes in stages for one in asked_of(mutant.file))
        return next((one for one in asked if not passes(project, *one)), None)
    finally:
        rewrite(place, (ROOT / mutant.file).read_text())


def asked_of(file: str) -> tuple[str, ...]:
    """The tests of a file's layer, those that name its module first.

    They lie in the deepest folder below tests/ that mirrors its own, and in those of MORE.
    """
    parts = Path(file.removeprefix("vv/")).parts[:-1]
    own = Path("tests", *parts)
    while not (ROOT / own).is_dir():
        own = own.parent
    more = tuple(f"tests/{one}" for one in MORE.get(parts[0], ()))
    folders = more if own == Path("tests") else (own.as_posix(), *more)
    tests = [path for folder in folders for path in sorted((ROOT / folder).rglob("test_*.py"))]
    word = re.compile(rf"\b{Path(file).stem}\b")
    naming = [one.relative_to(ROOT).as_posix() for one in tests if word.search(one.read_text())]
    return (*naming, *folders)


def main() -> None:
    """Turn, ask, count and judge."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--files", default="*", help="such as 'vv/gate/*'")
    parser.add_argument("--each", type=int, default=1000, help="mutants a file")
    parser.add_argument("--sample", type=int, default=EVERY, help="mutants in all")
    parser.add_argument("--seed", type=int, help="drawn from all places alike, with this seed")
    parser.add_argument("--all", action="store_true", help="tests that start processes too")
    options = parser.parse_args()
    for name in NEEDS:
        importlib.import_module(name)
    stages = (False, True) if options.all else (False,)
    every = (
        drawn(options.files, options.each, options.sample)
        if options.seed is None
        else uniform(options.files, options.sample, options.seed)
    )
    left, red = list[str](), set[str]()
    with tempfile.TemporaryDirectory() as folder:
        project = Path(folder)
        copied(project, with_tests())
        for one in every:
            by = seen_by(project, one, stages)
            if by is None:
                left.append(one.what)
            elif not green(project, *by):
                red.add(by[0])
            print(f"{by[0] if by else 'unseen':<44} {one.what}", flush=True)
    rate = len(left) / max(1, len(every))
    low, high = binomtest(len(left), max(1, len(every))).proportion_ci(method="wilson")
    figures = {
        "mutants": len(every), "not seen": left, "rate": rate, "at 95 %": [low, high],
        "red without one": sorted(red),
    }  # fmt: skip
    conclude("framework_mutants", figures, {"green without": not red, "5 % at most": rate <= 0.05})


if __name__ == "__main__":
    main()

"""A copy of the project that holds many mutants at once, of which a process switches one on.

Where a mutant is stands a choice between what is there and what it becomes (mutant schemata,
Untch, Offutt and Harrold 1993), made by a number that the process is started with. So kernels are
compiled once for all mutants, and each costs no more than the cases it is put to.
"""

import ast
import copy
import functools
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from bench.mutation.mutants import COMPILED, ROOT, Mutant, parsed, turned
from vv.base.closure import source_digest
from vv.base.files import write_whole

CONTENT = ("vv", "adapters", "cases", "reference_solutions", "reports", "pyproject.toml")
KERNEL = ("compiled", "called", "inlined", "shared")
PURE = ("np", "math", "len", "abs", "min", "max", "float", "int", "dot", "at", "cross",
        "add_scaled")  # fmt: skip
SWITCHES = ("switch", "switch_compiled")  # beside this file, which the copy has in vv/


def build(folder: Path, mutants: Sequence[Mutant]) -> dict[str, int]:
    """Copy the project to a folder, with all mutants that can be switched; what -> its number.

    What lies there already as it should is left, so that kernels compiled before are still known.
    """
    numbers = {m.what: i for i, m in enumerate(mutants, 1) if switchable(m)}
    changed = {}
    for file in {m.file for m in mutants}:
        own = {m.place: numbers[m.what] for m in mutants if m.file == file and m.what in numbers}
        changed[file] = _switched(file, own).encode()
    here = Path(__file__).parent
    changed |= {f"vv/{name}.py": (here / f"{name}.py").read_bytes() for name in SWITCHES}
    copied(folder, changed)
    return numbers


def sources() -> list[Path]:
    """Every file of the project that an answer of the gate hangs on."""
    parts = [path for name in CONTENT for path in (ROOT / name, *(ROOT / name).rglob("*"))]
    return [path for path in parts if path.is_file() and path.suffix != ".pyc"]


def copied(folder: Path, changed: Mapping[str, bytes]) -> None:
    """Make a folder hold the project with some files changed, and nothing of one before."""
    own = {path.relative_to(ROOT).as_posix(): path.read_bytes() for path in sources()}
    wanted = {**own, **changed}
    for part in CONTENT:
        for path in (folder / part).rglob("*"):
            if path.is_file() and path.relative_to(folder).as_posix() not in wanted:
                path.unlink()
    for name, content in wanted.items():
        path = folder / name
        if not path.is_file() or path.read_bytes() != content:
            write_whole(path, content)


def switchable(mutant: Mutant) -> bool:
    """Whether a choice can stand for a node: where a function runs, not where it is defined.

    Of a condition on None the compiler must see which branch there is.
    """
    node = list(ast.walk(parsed(mutant.file)))[mutant.place]
    on_none = any(isinstance(one, ast.Is | ast.IsNot) for one in ast.walk(node))
    if isinstance(node, ast.BoolOp) and on_none:
        return False
    return any(node in inner for _, inner in _bodies(mutant.file))


def _bodies(file: str) -> Iterator[tuple[bool, set[ast.AST]]]:
    """For each function whether it is a kernel, and all nodes of its body."""
    for function in ast.walk(parsed(file)):
        if isinstance(function, ast.FunctionDef):
            named = [one.id for one in function.decorator_list if isinstance(one, ast.Name)]
            kernel = any(name in KERNEL for name in named)
            yield kernel, {node for part in function.body for node in ast.walk(part)}


def _switched(file: str, numbers: dict[int, int]) -> str:
    """A file's text with a choice at every place that has a number."""
    tree = parsed(file)
    nodes = list(ast.walk(tree))
    inside = {node for kernel, body in _bodies(file) if kernel for node in body}
    chosen = {nodes[place]: number for place, number in numbers.items()}
    made = _Switch(chosen, inside).visit(tree)
    compiled = COMPILED.search((ROOT / file).read_text())
    asks = (
        "from vv.switch_compiled import either as _either, on as _on"
        if compiled
        else "from vv.switch import on as _on"
    )
    lines = ast.unparse(ast.fix_missing_locations(made)).splitlines()
    last = max((i for i, line in enumerate(lines) if line.startswith("from __future__")), default=0)
    lines.insert(last + 1, f"{asks}  # as of {_version()}")
    return "\n".join(lines) + "\n"


@functools.cache
def _version() -> str:
    """Digest of how choices are made, by which kernels compiled otherwise are known as stale."""
    return source_digest([Path(__file__).parent / f"{name}.py" for name in SWITCHES])[:12]


class _Switch(ast.NodeTransformer):
    """Puts choices into a copy of a tree: of two values in a kernel, else of what is worked out."""

    def __init__(self, chosen: dict[ast.AST, int], kernel: set[ast.AST]) -> None:
        self.chosen, self.kernel = chosen, kernel

    def visit(self, node: ast.AST) -> ast.AST:
        fresh = copy.copy(node)
        for name, value in ast.iter_fields(node):
            setattr(fresh, name, self._within(value))
        number = self.chosen.get(node)
        if number is None:
            return fresh
        assert isinstance(fresh, ast.expr)
        if node in self.kernel and _plain(node):
            return _call("_either", ast.Constant(number), copy.deepcopy(fresh), turned(fresh))
        return ast.IfExp(_call("_on", ast.Constant(number)), turned(fresh), copy.deepcopy(fresh))

    def _within(self, value: object) -> object:
        if isinstance(value, list):
            return [self._within(one) for one in value]
        return self.visit(value) if isinstance(value, ast.AST) else value


def _call(name: str, *arguments: ast.expr) -> ast.Call:
    return ast.Call(ast.Name(name, ast.Load()), list(arguments), [])


def _plain(node: ast.AST) -> bool:
    """Whether both values of a choice can be worked out: nothing guards or changes anything."""
    calls = [one.func for one in ast.walk(node) if isinstance(one, ast.Call)]
    names = [next(n.id for n in ast.walk(f) if isinstance(n, ast.Name)) for f in calls]
    return not isinstance(node, ast.BoolOp) and all(name in PURE for name in names)

"""Builds a copy of the project with many mutants, one of which a process can switch on.

In place of a mutated expression the copy has a choice between the original and the mutated one
(mutant schemata, Untch, Offutt and Harrold 1993), made by a number in the environment of the
process. Kernels are therefore compiled once for all mutants.
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
KERNEL = (
    "compiled", "compiled_to_branch", "compiled_to_join", "called", "lent", "inlined",
    "inlined_called", "shared",
)  # fmt: skip
PURE = ("np", "math", "len", "abs", "min", "max", "float", "int", "dot", "at", "cross",
        "add_scaled")  # fmt: skip
# the copy has these files in vv/
HERE = Path(__file__).parent / "in_copy"
SWITCHES = ("switch", "switch_compiled", "switch_numba", "switch_plain")
AS_PYTHON = {  # what runs kernels as plain Python in tests, and what does so in the copy
    "tests/support/plain.py": (
        "FunctionType(function.__code__,", "FunctionType(lazily(function),",
    ),
    "tests/engines/conftest.py": (
        "kernel.__wrapped__(*arguments)", "plainly(kernel.__wrapped__)(*arguments)",
    ),
}  # fmt: skip


def build(folder: Path, mutants: Sequence[Mutant]) -> dict[str, int]:
    """Copy the project to a folder, with all switchable mutants; returns mutant -> number.

    Files that are already correct are left, so that compiled kernels stay valid.
    """
    numbers = {m.what: i for i, m in enumerate(mutants, 1) if switchable(m)}
    changed = {}
    for file in {m.file for m in mutants}:
        own = {m.place: numbers[m.what] for m in mutants if m.file == file and m.what in numbers}
        changed[file] = _switched(file, own).encode()
    changed |= {f"vv/{name}.py": (HERE / f"{name}.py").read_bytes() for name in SWITCHES}
    copied(folder, changed)
    return numbers


def sources() -> list[Path]:
    """All files of the project that a verdict of the gate depends on."""
    parts = [path for name in CONTENT for path in (ROOT / name, *(ROOT / name).rglob("*"))]
    return [path for path in parts if path.is_file() and path.suffix != ".pyc"]


def copied(folder: Path, changed: Mapping[str, bytes]) -> None:
    """Copy the project to a folder with some files changed; other files there are removed."""
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


def as_in_copy(name: str, content: bytes) -> bytes:
    """A file of tests as the copy has it: kernels in Python compute one side of a choice alone."""
    if name not in AS_PYTHON:
        return content
    (given, ours), text = AS_PYTHON[name], content.decode()
    assert given in text, f"{name} has changed"
    first, needs = "from vv.engines.kernels", "from vv.switch_plain import lazily, plainly\n"
    return text.replace(given, ours).replace(first, needs + first, 1).encode()


def switchable(mutant: Mutant) -> bool:
    """Whether a choice can replace a node: in the body of a function, not in its definition.

    For a condition on None the compiler must know the branch, so that it is excluded.
    """
    node = list(ast.walk(parsed(mutant.file)))[mutant.place]
    on_none = any(isinstance(one, ast.Is | ast.IsNot) for one in ast.walk(node))
    if isinstance(node, ast.BoolOp) and on_none:
        return False
    return any(node in inner for _, inner in _bodies(mutant.file))


def _bodies(file: str) -> Iterator[tuple[bool, set[ast.AST]]]:
    """For each function, whether it is a kernel, and all nodes of its body."""
    for function in ast.walk(parsed(file)):
        if isinstance(function, ast.FunctionDef):
            named = [one.id for one in function.decorator_list if isinstance(one, ast.Name)]
            kernel = any(name in KERNEL for name in named)
            yield kernel, {node for part in function.body for node in ast.walk(part)}


def _switched(file: str, numbers: dict[int, int]) -> str:
    """The text of a file with a choice at each numbered place."""
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
    """The digest of this generator, by which stale compiled kernels are recognised."""
    return source_digest([HERE / f"{name}.py" for name in SWITCHES])[:12]


class _Switch(ast.NodeTransformer):
    """Inserts choices into a syntax tree: both values are computed in kernels, one elsewhere."""

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
    """Whether both values of a choice can be computed: no side effects, and no guard needed."""
    calls = [one.func for one in ast.walk(node) if isinstance(one, ast.Call)]
    names = [next(n.id for n in ast.walk(f) if isinstance(n, ast.Name)) for f in calls]
    return not isinstance(node, ast.BoolOp) and all(name in PURE for name in names)

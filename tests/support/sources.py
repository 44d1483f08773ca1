"""The folders and modules of the project, and what they import, read from their sources."""

import ast
from functools import cache
from pathlib import Path

from tests import ROOT

OURS = ("vv", "adapters", "cases", "reports", "reference_solutions")


def _folders(top: str) -> list[Path]:
    return [path.parent for path in sorted((ROOT / top).rglob("__init__.py"))]


FOLDERS = [folder for top in OURS for folder in _folders(top)]
TESTS = _folders("tests")


def dotted(path: Path) -> str:
    """The name by which a file or folder is imported."""
    return ".".join(path.relative_to(ROOT).with_suffix("").parts)


@cache
def tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text())


def imported(path: Path, nodes: list[ast.AST]) -> set[str]:
    """What import statements name: modules, or what is taken from a package."""
    names = {a.name for node in nodes if isinstance(node, ast.Import) for a in node.names}
    taken = [node for node in nodes if isinstance(node, ast.ImportFrom) and node.module]
    return names | {f"{node.module}.{a.name}" for node in taken for a in node.names}

"""What a result depends on: the import closure of our sources and the versions they use."""

import ast
import functools
import hashlib
from collections.abc import Iterable, Iterator
from importlib import metadata
from pathlib import Path

CONTENT = ("adapters", "cases", "reference_solutions", "reports")  # the packages of a project
OURS = ("vv", *CONTENT)


def closure(files: Iterable[Path], roots: Iterable[Path]) -> tuple[Path, ...]:
    """The files, and every file of ours below `roots` that they import, however indirectly.

    Imports are read from the text, inside functions too; nothing is executed. Data files that
    lie in the folder of a package count with it.
    """
    places, seen = tuple(roots), set[Path]()
    waiting = [path.resolve() for path in files]
    while waiting:
        path = waiting.pop()
        if path in seen:
            continue
        seen.add(path)
        if path.suffix == ".py":
            ours = (name for name in _imports(path) if name.partition(".")[0] in OURS)
            waiting += [p for name in ours for p in _locate(name, places)]
    return tuple(sorted(seen))


def libraries(files: Iterable[Path]) -> dict[str, str]:
    """The third-party libraries that these sources import, with their installed versions."""
    tops = {
        name.partition(".")[0] for path in files if path.suffix == ".py" for name in _imports(path)
    }
    versions = {top: _version(top) for top in sorted(tops)}
    return {top: version for top, version in versions.items() if version}


def source_digest(files: Iterable[Path]) -> str:
    """SHA-256 of names and contents, independent of where the files lie."""
    sha = hashlib.sha256()
    for path in sorted(files, key=lambda p: (p.name, str(p))):
        sha.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return sha.hexdigest()


@functools.cache
def _imports(path: Path) -> tuple[str, ...]:
    tree = ast.parse(path.read_text(encoding="utf-8"), filename=str(path))
    return tuple(sorted(set(_names(tree))))


def _names(tree: ast.AST) -> Iterator[str]:
    """What the statements below a node import; expressions, which cannot, are not looked at."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.stmt | ast.excepthandler | ast.match_case):
            yield from _names(node)


@functools.cache
def _locate(name: str, roots: tuple[Path, ...]) -> list[Path]:
    """The files of a dotted module of ours: the module and its packages' __init__."""
    parts = name.split(".")
    for root in roots:
        base = root.joinpath(*parts)
        if base.with_suffix(".py").is_file():
            return [base.with_suffix(".py").resolve(), *_parents(root, parts[:-1])]
        if (base / "__init__.py").is_file():
            return [*(p.resolve() for p in _package_files(base)), *_parents(root, parts[:-1])]
    return []


def _package_files(folder: Path) -> list[Path]:
    data = [p for p in folder.iterdir() if p.is_file() and p.suffix not in (".py", ".pyc")]
    return [folder / "__init__.py", *data]


def _parents(root: Path, packages: list[str]) -> list[Path]:
    found = [root.joinpath(*packages[: i + 1], "__init__.py") for i in range(len(packages))]
    return [path.resolve() for path in found if path.is_file()]


@functools.cache
def _version(library: str) -> str:
    try:
        return metadata.version(library)
    except metadata.PackageNotFoundError:
        return ""

"""What a result depends on: the import closure of our sources and the versions they use."""

import ast
import functools
import hashlib
import os
import re
from collections.abc import Iterable, Iterator
from importlib import metadata
from pathlib import Path

CONTENT = ("adapters", "cases", "reference_solutions", "reports")  # the packages of a project
OURS = ("vv", *CONTENT)
WORD = re.compile(r"import\b")  # begins with plain letters: found ten times as fast
PLAIN = re.compile(  # on lines of their own, and without what may hide a name
    r"^[ \t]*(?:from[ \t]+([.\w]+)[ \t]+import[ \t]*(?:\(([^()#;\\]*)\)|([^()#;\\\n]+))"
    r"|import[ \t]+(?!.*(?:[ \t]\.|\.[ \t]))([^()#;\\\n]+))(?:#.*)?$",
    re.MULTILINE,
)


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
    ordered = sorted(files, key=lambda path: (path.name, str(path)))
    named = "".join(f"{path.name}\0{_content(path)}\0" for path in ordered)
    return hashlib.sha256(named.encode()).hexdigest()


@functools.cache
def _content(path: Path) -> str:
    """Digest of a file as it was when first asked for: most are part of many closures."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


@functools.cache
def _imports(path: Path) -> tuple[str, ...]:
    text = path.read_text(encoding="utf-8")
    return tuple(sorted(set(imported(text, str(path)))))


def imported(text: str, filename: str = "") -> list[str]:
    """What a source imports, at least: modules, and what it takes from them as if modules too.

    It is only parsed where the word stands anywhere but in plain import statements, since parsing
    takes ten times as long as looking for these.
    """
    plain = list(PLAIN.finditer(text))
    if len(plain) < len(WORD.findall(text)) or not text.isascii():
        return list(_names(ast.parse(text, filename)))
    return [name for statement in plain for name in _named(*statement.groups())]


def _named(module: str | None, *lists: str | None) -> Iterator[str]:
    """The names in the parts of a plain statement: what it takes from a module, or modules."""
    parts = ",".join(filter(None, lists)).split(",")
    names = [part.split()[0] for part in parts if part.strip()]
    if module is None:
        yield from names
    elif above := module.lstrip("."):
        yield above
        yield from (f"{above}.{name}" for name in names)


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
    package, _, last = name.rpartition(".")
    for root in roots:
        base = os.path.join(root, *package.split("."), last)
        if os.path.isfile(f"{base}.py"):
            return [Path(f"{base}.py").resolve(), *_packages(package, root)]
        if os.path.isfile(os.path.join(base, "__init__.py")):
            return [*_data(Path(base).resolve()), *_packages(name, root)]
    return []


@functools.cache
def _packages(name: str, root: Path) -> list[Path]:
    """The __init__ of a dotted package, where it has one, and of those it is in."""
    if not name:
        return []
    own = root.joinpath(*name.split("."), "__init__.py")
    return [*([own.resolve()] if own.is_file() else []), *_packages(name.rpartition(".")[0], root)]


def _data(folder: Path) -> list[Path]:
    return [p for p in folder.iterdir() if p.is_file() and p.suffix not in (".py", ".pyc")]


@functools.cache
def _version(library: str) -> str:
    try:
        return metadata.version(library)
    except metadata.PackageNotFoundError:
        return ""

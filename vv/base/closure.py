"""Finds the sources that a file imports, directly or not, and the versions of libraries."""

import ast
import functools
import hashlib
import os
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

CONTENT_PACKAGES = (
    "adapters",
    "cases",
    "reference_solutions",
    "reports",
)  # the packages of a project
OUR_PACKAGES = ("vv", *CONTENT_PACKAGES)
IMPORT_WORD = re.compile(r"import\b")  # no \b before it: the search is ten times as fast
PLAIN_IMPORT = re.compile(  # statements on lines of their own, in their simple forms
    r"^[ \t]*(?:from[ \t]+([.\w]+)[ \t]+import[ \t]*(?:\(([^()#;\\]*)\)|([^()#;\\\n]+))"
    r"|import[ \t]+(?!.*(?:[ \t]\.|\.[ \t]))([^()#;\\\n]+))(?:#.*)?$",
    re.MULTILINE,
)

_DIGESTS: dict[Path, str] = {}  # of the files read so far in this process


def import_closure(files: Iterable[Path], roots: Iterable[Path]) -> tuple[Path, ...]:
    """The files and all files of OUR_PACKAGES below `roots` that they import, also indirectly.

    Imports are read from the source text, also inside functions; nothing is executed. A package
    includes the data files of its folder. `vv` is in the last of the roots: a folder `vv` in a
    project is not the one that runs. Returns resolved paths, sorted.
    """
    places, seen = tuple(roots), set[Path]()
    waiting = [path.resolve() for path in files]
    while waiting:
        path = waiting.pop()
        if path in seen:
            continue
        seen.add(path)
        if path.suffix == ".py":
            ours = (name for name in _imports(path) if name.partition(".")[0] in OUR_PACKAGES)
            waiting += [p for name in ours for p in _module_files(name, places)]
    return tuple(sorted(seen))


def library_versions(files: Iterable[Path]) -> dict[str, str]:
    """Name -> installed version of the third-party libraries that these sources import."""
    tops = {
        name.partition(".")[0] for path in files if path.suffix == ".py" for name in _imports(path)
    }
    versions = {top: _version(top) for top in sorted(tops)}
    return {top: version for top, version in versions.items() if version}


def source_digest(files: Iterable[Path]) -> str:
    """SHA-256 of the files' names and contents, independent of the folders they lie in."""
    ordered = sorted(files, key=lambda path: (path.name, str(path)))
    named = "".join(f"{path.name}\0{_content_digest(path)}\0" for path in ordered)
    return hashlib.sha256(named.encode()).hexdigest()


def _content_digest(path: Path) -> str:
    """Digest of a file, read once a process: most files are part of many closures."""
    if path not in _DIGESTS:
        _DIGESTS[path] = hashlib.sha256(path.read_bytes()).hexdigest()
    return _DIGESTS[path]


def changed_files() -> list[Path]:
    """The files that differ from what they were when this process took their digests, sorted."""
    return sorted(path for path, known in _DIGESTS.items() if _digest_now(path) != known)


def _digest_now(path: Path) -> str:
    """Digest of a file as it is now; empty if it cannot be read."""
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError:
        return ""


@functools.cache
def _imports(path: Path) -> tuple[str, ...]:
    text = path.read_text(encoding="utf-8")
    return tuple(sorted(set(imported_names(text, str(path)))))


def imported_names(text: str, filename: str = "") -> list[str]:
    """Dotted names that a source imports: modules, and `module.name` for each imported name.

    Simple import statements are found by a regular expression, which is ten times as fast as
    parsing. The source is parsed if the word `import` also occurs elsewhere, as in a comment.
    """
    plain = list(PLAIN_IMPORT.finditer(text))
    if len(plain) < len(IMPORT_WORD.findall(text)) or not text.isascii():
        return list(_names_in_tree(ast.parse(text, filename)))
    return [name for statement in plain for name in _names_in_statement(*statement.groups())]


def _names_in_statement(module: str | None, *lists: str | None) -> Iterator[str]:
    """The dotted names in the groups of PLAIN_IMPORT: `from module import names`, or modules."""
    parts = ",".join(filter(None, lists)).split(",")
    names = [part.split()[0] for part in parts if part.strip()]
    if module is None:
        yield from names
    elif above := module.lstrip("."):
        yield above
        yield from (f"{above}.{name}" for name in names)


def _names_in_tree(tree: ast.AST) -> Iterator[str]:
    """The dotted names that the statements below a syntax node import."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.stmt | ast.excepthandler | ast.match_case):
            yield from _names_in_tree(node)


@functools.cache
def _module_files(name: str, roots: tuple[Path, ...]) -> list[Path]:
    """The files that importing a dotted name executes: the module and its packages' __init__."""
    package, _, last = name.rpartition(".")
    for root in roots[-1:] if name.partition(".")[0] == OUR_PACKAGES[0] else roots:
        base = os.path.join(root, *package.split("."), last)
        if os.path.isfile(f"{base}.py"):
            return [Path(f"{base}.py").resolve(), *_package_files(package, root)]
        if os.path.isfile(os.path.join(base, "__init__.py")):
            return [*_data_files(Path(base).resolve()), *_package_files(name, root)]
    return []


@functools.cache
def _package_files(name: str, root: Path) -> list[Path]:
    """The __init__ files of a dotted package and of the packages that contain it."""
    if not name:
        return []
    own = root.joinpath(*name.split("."), "__init__.py")
    return [
        *([own.resolve()] if own.is_file() else []),
        *_package_files(name.rpartition(".")[0], root),
    ]


def _data_files(folder: Path) -> list[Path]:
    return [p for p in folder.iterdir() if p.is_file() and p.suffix not in (".py", ".pyc")]


@functools.cache
def _version(library: str) -> str:
    from importlib import metadata  # imported here, since it loads the package email

    try:
        return metadata.version(library)
    except metadata.PackageNotFoundError:
        return ""

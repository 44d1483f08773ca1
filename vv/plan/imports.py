"""Imports a project's cases, codes and references; errors name the file."""

from __future__ import annotations

import importlib
import importlib.util
import sys
import traceback
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

import vv
from vv.base.closure import CONTENT_PACKAGES
from vv.plan.content import ProjectError, home, written

SOURCES = Path(vv.__file__).resolve().parents[1]  # the folder that holds the vv which is running
BUNDLE = SOURCES / "vv" / "_project"  # in an installed wheel
OWN = BUNDLE if BUNDLE.is_dir() else SOURCES  # the content that came with this vv
ADDED = ("adapters", "cases", "reference_solutions")  # packages that a project may extend


def activate(roots: Sequence[Path]) -> None:
    """Make the content of a project importable; what it lacks comes from this vv's own.

    Where there are two roots, a package of the first also holds what the second has, its own
    modules first. Raises ProjectError where another package has the name of one of its folders,
    or where both roots have a module of the same name.
    """
    if sys.path[0] != str(roots[0]):
        sys.path[:0] = dict.fromkeys((str(roots[0]), str(OWN)))
    for name in CONTENT_PACKAGES:
        places = [(root / name).resolve() for root in roots]
        folder = roots[0] / name
        if (folder / "__init__.py").is_file() and (origin := _origin(name)) not in places:
            raise ProjectError(
                f"{folder} cannot be imported: in this process '{name}' is "
                f"{origin or 'another module'}; run vv in an environment without it"
            )
    for folder in _shared(*roots) if len(roots) > 1 else ():
        _join(folder, roots)


def _shared(own: Path, added: Path) -> Iterator[Path]:
    """The packages that exist in both roots, as relative paths, outer ones first."""
    for name in ADDED:
        inner = [path for path in sorted((own / name).rglob("*")) if path.is_dir()]
        for path in ((own / name), *inner):
            folder = path.relative_to(own)
            packages = [root for root in (own, added) if (root / folder / "__init__.py").is_file()]
            if packages and path.is_dir() and (added / folder).is_dir():
                yield folder


def _join(folder: Path, roots: Sequence[Path]) -> None:
    """Merge a package of several roots; raises ProjectError if two roots have the same module."""
    package = _module(".".join(folder.parts), roots[0] / folder / "__init__.py")
    places = [str(root / folder) for root in roots]
    if list(package.__path__) != places:
        _require_apart(*(root / folder for root in roots))
        package.__path__ = places


def _require_apart(own: Path, added: Path) -> None:
    """Raise ProjectError, naming both files, where a module of a project hides one of vv's."""
    for file in sorted(own.glob("*.py")):
        if file.name != "__init__.py" and written(file, own) and (added / file.name).is_file():
            raise ProjectError(f"{file} and {added / file.name}: a module's name must be unique")


def attribute(roots: Sequence[Path], file: Path, name: str) -> Any:
    """The object called `name` in a file; raises ProjectError if it fails or has none."""
    activate(roots)
    parts = file.relative_to(home(file, roots)).with_suffix("").parts
    module = _module(".".join(p for p in parts if p != "__init__"), file)
    if not hasattr(module, name):
        raise ProjectError(f"{file} has no {name}; it must end in {name} = ...")
    return getattr(module, name)


def _module(dotted: str, file: Path) -> ModuleType:
    """A module by its name; raises ProjectError, naming its file, if that fails."""
    try:
        return importlib.import_module(dotted)
    except Exception as error:
        text = " ".join(str(error).split())
        raise ProjectError(f"{file}{_line(error, file)}: {type(error).__name__}: {text}") from error


def raised_within(error: Exception) -> str:
    """The calls in cases, adapters and answers that led to an error, and what it says.

    Empty if there are none: then the fault is not in the files of a project.
    """
    frames = [f for f in traceback.extract_tb(error.__traceback__) if _in_content(Path(f.filename))]
    text = f"{type(error).__name__}: {' '.join(str(error).split())}"
    return f"{text}\n{''.join(traceback.format_list(frames)).rstrip()}" if frames else ""


def _in_content(file: Path) -> bool:
    """Whether a file lies in a package of an active project."""
    active = [Path(entry) / name for entry in sys.path[:2] for name in CONTENT_PACKAGES]
    return any(folder in file.parents for folder in active)


def _line(error: Exception, file: Path) -> str:
    """The line of a file at which its import failed, as ':12'; empty if it is unknown."""
    if isinstance(error, SyntaxError) and error.filename == str(file):
        return f":{error.lineno}"
    lines = [f.lineno for f in traceback.extract_tb(error.__traceback__) if f.filename == str(file)]
    return f":{lines[-1]}" if lines else ""


def _origin(name: str) -> Path | None:
    """The folder that `import name` takes a package from; the package is not imported."""
    loaded = sys.modules.get(name)
    spec = None if loaded else importlib.util.find_spec(name)
    places = getattr(loaded, "__path__", None) or (spec and spec.submodule_search_locations)
    return Path(next(iter(places))).resolve() if places else None

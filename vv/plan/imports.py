"""Imports a project's content: one insertion in sys.path, and errors that name the file."""

from __future__ import annotations

import importlib
import importlib.util
import sys
import traceback
from pathlib import Path
from typing import Any

import vv
from vv.base.closure import CONTENT_PACKAGES
from vv.plan.content import ProjectError

SOURCES = Path(vv.__file__).resolve().parents[1]  # the folder that holds the vv which is running
BUNDLE = SOURCES / "vv" / "_project"  # in an installed wheel
OWN = BUNDLE if BUNDLE.is_dir() else SOURCES  # the content that came with this vv


def activate(root: Path) -> None:
    """Make the content of a project importable; what it lacks comes from this vv's own.

    Raises ProjectError where another package has the name of one of its folders.
    """
    if sys.path[0] != str(root):
        sys.path[:0] = dict.fromkeys((str(root), str(OWN)))
    for name in CONTENT_PACKAGES:
        folder = root / name
        if (folder / "__init__.py").is_file() and (origin := _origin(name)) != folder.resolve():
            raise ProjectError(
                f"{folder} cannot be imported: in this process '{name}' is "
                f"{origin or 'another module'}; run vv in an environment without it"
            )


def attribute(root: Path, file: Path, name: str) -> Any:
    """What a file of a project calls `name`; raises ProjectError if it fails or has none."""
    activate(root)
    parts = file.relative_to(root).with_suffix("").parts
    try:
        module = importlib.import_module(".".join(p for p in parts if p != "__init__"))
    except Exception as error:
        text = " ".join(str(error).split())
        raise ProjectError(f"{file}{_line(error, file)}: {type(error).__name__}: {text}") from error
    if not hasattr(module, name):
        raise ProjectError(f"{file} has no {name}; it must end in {name} = ...")
    return getattr(module, name)


def raised_within(error: Exception) -> str:
    """The calls in cases, adapters and answers that led to an error, and what it says.

    Empty where none did: then the fault is not in what a project writes.
    """
    frames = [f for f in traceback.extract_tb(error.__traceback__) if _in_content(Path(f.filename))]
    text = f"{type(error).__name__}: {' '.join(str(error).split())}"
    return f"{text}\n{''.join(traceback.format_list(frames)).rstrip()}" if frames else ""


def _in_content(file: Path) -> bool:
    """Whether a file lies in a package of a project that is active."""
    active = [Path(entry) / name for entry in sys.path[:2] for name in CONTENT_PACKAGES]
    return any(folder in file.parents for folder in active)


def _line(error: Exception, file: Path) -> str:
    """Where in the file an import failed, as ':12'; empty if it did not get that far."""
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

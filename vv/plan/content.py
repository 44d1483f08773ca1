"""The names of a project's cases and adapters, read from its files without importing them."""

from __future__ import annotations

import re
from pathlib import Path

from vv.base.errors import UsageError

FILE_NAME = re.compile("[a-z][a-z0-9_]*")


class ProjectError(UsageError):
    """A project, or a file of it, is not as it must be; one line names it and the rule."""


def cases(root: Path) -> dict[str, Path]:
    """Every case's file by name; a leading underscore marks a helper, no other is passed over."""
    folder = root / "cases"
    found: dict[str, Path] = {}
    for file in sorted(folder.rglob("*.py")):
        if file.name.startswith("_") or not written(file, folder):
            continue
        name = name_of(file)
        if name in found:
            raise ProjectError(f"{file} and {found[name]}: a case's name must be unique")
        found[name] = file
    for path in found.values():
        family = path.relative_to(folder).parts[0]
        if family != path.name and name_of(Path(family)) in found:
            raise ProjectError(f"{folder / family}: a family must not have the name of a case")
    return found


def adapters(root: Path) -> dict[str, Path]:
    """Every adapter's file or folder by name; a leading underscore marks a helper."""
    places = [
        path
        for path in sorted((root / "adapters").iterdir())
        if path.name[0] not in "._" and (path.suffix == ".py" or any(path.glob("*.py")))
    ]
    found = {name_of(path): path for path in places}
    if len(found) < len(places):
        raise ProjectError(f"{root / 'adapters'}: a file and a folder have the same name")
    return found


def name_of(path: Path) -> str:
    """The name that a file or folder gives; raises ProjectError if it cannot give one."""
    if not FILE_NAME.fullmatch(path.stem):
        raise ProjectError(
            f"{path}: a name must be lower-case letters, digits and _, and start with a letter"
        )
    return path.stem.replace("_", "-")


def written(file: Path, folder: Path) -> bool:
    """Whether a file was written by someone: neither compiled nor in a hidden folder."""
    parts = file.relative_to(folder).parts
    return not any(part.startswith(".") or part == "__pycache__" for part in parts)

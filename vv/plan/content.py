"""The names of a project's cases and adapters, read from its files without importing them.

A project may have two roots: its own folder, and the folder of the content that came with vv.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path

from vv.base.errors import UsageError

FILE_NAME = re.compile("[a-z][a-z0-9_]*")
PROGRAM = ".toml"  # how the name of a file ends that declares a program
CODE_FILES = (".py", PROGRAM)


class ProjectError(UsageError):
    """A project or one of its files breaks a rule; the message names the file and the rule."""


def cases(roots: Iterable[Path]) -> dict[str, Path]:
    """Every case's file by name; a file whose name starts with an underscore is a helper."""
    folders = [root / "cases" for root in roots]
    found = _unique("case", (file for folder in folders for file in _case_files(folder)))
    for path in found.values():
        folder = home(path, folders)
        family = path.relative_to(folder).parts[0]
        if family != path.name and name_of(Path(family)) in found:
            raise ProjectError(f"{folder / family}: a family must not have the name of a case")
    return found


def _case_files(folder: Path) -> list[Path]:
    return [
        file
        for file in sorted(folder.rglob("*.py"))
        if not file.name.startswith("_") and written(file, folder)
    ]


def adapters(roots: Iterable[Path], programs: Iterable[Path] = ()) -> dict[str, Path]:
    """Every code's file or folder by name; a leading underscore marks a helper.

    A TOML file declares a program; programs: those that lie elsewhere.
    """
    folders = [root / "adapters" for root in roots]
    own = (
        path
        for folder in folders
        for path in sorted(folder.glob("*"))
        if path.name[0] not in "._" and (path.suffix in CODE_FILES or any(path.glob("*.py")))
    )
    return _unique("code", dict.fromkeys((*own, *programs)))


def _unique(kind: str, places: Iterable[Path]) -> dict[str, Path]:
    """Name -> its place; raises ProjectError that names both places of a name."""
    found: dict[str, Path] = {}
    for place in places:
        name = name_of(place)
        if name in found:
            raise ProjectError(f"{place} and {found[name]}: a {kind}'s name must be unique")
        found[name] = place
    return found


def home(file: Path, folders: Iterable[Path]) -> Path:
    """The folder that contains a file; the innermost of several."""
    return max((f for f in folders if f in file.parents), key=lambda folder: len(folder.parts))


def settings(root: Path) -> Mapping[str, object] | None:
    """A project's settings, from vv.toml or [tool.vv] in pyproject.toml; None for other folders.

    alone = true: nothing that came with vv is added to it. Raises ProjectError for a file that
    cannot be read, a pyproject.toml only beside cases/, and for an unknown setting.
    """
    own, shared = root / "vv.toml", root / "pyproject.toml"
    if own.is_file():
        return _settings(own, _table(own))
    try:
        found = _table(shared).get("tool", {}) if shared.is_file() else {}
    except ProjectError:
        if (root / "cases").is_dir():
            raise
        return None
    return _settings(shared, found["vv"]) if isinstance(found, dict) and "vv" in found else None


def _table(file: Path) -> dict[str, object]:
    try:
        return tomllib.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise ProjectError(f"{file}: {error}") from error


def _settings(file: Path, table: Mapping[str, object]) -> Mapping[str, object]:
    for name, value in table.items():
        if name != "alone" or not isinstance(value, bool):
            raise ProjectError(
                f"{file}: {name} = {value!r}; the only setting is alone, true or false"
            )
    return table


def name_of(path: Path) -> str:
    """The name that a file or folder gives; raises ProjectError if it cannot give one."""
    if not FILE_NAME.fullmatch(path.stem):
        raise ProjectError(
            f"{path}: a name must be lower-case letters, digits and _, and start with a letter"
        )
    return path.stem.replace("_", "-")


def written(file: Path, folder: Path) -> bool:
    """Whether a file is a source: neither compiled by Python nor in a hidden folder."""
    parts = file.relative_to(folder).parts
    return not any(part.startswith(".") or part == "__pycache__" for part in parts)

"""Writes templates that work: a program with its TOML file, a case with its reference, a project.

The templates are vv's own examples under another name.
"""

from __future__ import annotations

import enum
import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from vv.base.errors import UsageError
from vv.plan import imports
from vv.plan.content import FILE_NAME

EXAMPLES = imports.OWN / "examples"
SETTINGS = """\
# This folder is a project of vv: its cases and codes are added to those that came with vv.
# alone = true  # there are only its own
"""


class Language(enum.Enum):
    """A language in which a program may start."""

    C = "c"
    PYTHON = "python"
    SH = "sh"


PROGRAMS: Mapping[Language, str] = {
    Language.C: "first_dem",
    Language.PYTHON: "verlet",
    Language.SH: "awk_dem",
}
CASE, TITLE = "rebound", "A sphere rebounds"


def file_name(name: str) -> str:
    """A name as files have it, with `_` for `-`; raises UsageError for a bad one."""
    made = name.replace("-", "_")
    if not FILE_NAME.fullmatch(made):
        rule = "a name must be lower-case letters, digits, - and _, and start with a letter"
        raise UsageError(f"'{name}': {rule}")
    return made


def program(folder: Path, name: str, language: Language) -> list[Path]:
    """Write a program and its TOML file, which answer T1-T4 or part of them; returns the files."""
    name, example = file_name(name), PROGRAMS[language]
    sources = sorted((EXAMPLES / language.value).glob(f"{example}.*"))
    texts = {
        folder / f"{name}{source.suffix}": source.read_text().replace(example, name)
        for source in sources
    }
    return _written(texts)


def case(folder: Path, name: str) -> list[Path]:
    """Write a case and its exact answer below the folder of a project; returns the files."""
    name, texts = file_name(name), {}
    for part in ("cases", "reference_solutions"):
        text = (EXAMPLES / "case" / part / f"{CASE}.py").read_text()
        named = text.replace(f'name="{CASE}"', f'name="{name.replace("_", "-")}"')
        named = named.replace(f'title="{TITLE}"', f'title="{name.replace("_", " ").capitalize()}"')
        texts[folder / part / f"{name}.py"] = re.sub(rf"\b{CASE}\b", name, named)
    return _written(texts)


def project(folder: Path) -> list[Path]:
    """Write the files that make a folder a project; returns them."""
    kept = {folder / part / ".gitkeep": "" for part in ("adapters", "cases")}
    ignored = folder / ".gitignore"
    if not ignored.exists():
        kept[ignored] = ".vv/\n"
    return _written({folder / "vv.toml": SETTINGS, **kept})


def _written(texts: Mapping[Path, str]) -> list[Path]:
    """Write new files, all or none; raises UsageError for a file that exists."""
    _require_free(texts)
    for path, text in texts.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return list(texts)


def _require_free(paths: Iterable[Path]) -> None:
    for path in paths:
        if path.exists():
            raise UsageError(f"{path} already exists and is not overwritten")

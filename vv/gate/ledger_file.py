"""Reads the TOML file of known disagreements and known breaches."""

from __future__ import annotations

import datetime
import tomllib
from pathlib import Path
from typing import Any, TypeVar

from vv.base.errors import UsageError
from vv.gate.disagreement import Disagreement
from vv.gate.known_breaches import KnownBreach
from vv.records import codec

Entry = TypeVar("Entry", Disagreement, KnownBreach)


def read_disagreements(path: Path) -> tuple[Disagreement, ...]:
    """The tables [[disagreement]]; none if there is no file. Raises UsageError on a bad entry."""
    return _entries(path, "disagreement", Disagreement)


def read_breaches(path: Path) -> tuple[KnownBreach, ...]:
    """The tables [[breach]]; none if there is no file. Raises UsageError naming a bad entry."""
    return _entries(path, "breach", KnownBreach)


def _entries(path: Path, name: str, kind: type[Entry]) -> tuple[Entry, ...]:
    """The tables of a name, each as an object of that kind."""
    if not path.is_file():
        return ()
    found = []
    try:
        entries = tomllib.loads(path.read_text(encoding="utf-8")).get(name, [])
    except (OSError, ValueError) as error:
        raise UsageError(f"{path}: {error}") from error
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise UsageError(f"{path}: {name} must be a list of tables, [[{name}]]")
    for number, entry in enumerate(entries, 1):
        try:
            found.append(codec.read(kind, _plain(entry), "it"))
        except ValueError as error:
            raise UsageError(f"{path}: entry {number}: {error}") from error
    return tuple(found)


def _plain(entry: dict[str, Any]) -> dict[str, Any]:
    """An entry as JSON would have it: dates as their ISO texts."""
    return {
        name: value.isoformat() if isinstance(value, datetime.date) else value
        for name, value in entry.items()
    }

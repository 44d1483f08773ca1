"""Recorded results of external codes: kept in the project, shown where the code is absent.

One file per code and case, `CODE/CASE.json`. A recorded result is never a live one: it has no
verdict, sets no exit bit and satisfies no requirement.
"""

from __future__ import annotations

import datetime
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from vv.ask import Status
from vv.base.errors import UsageError
from vv.base.files import write_whole
from vv.gate.baseline import name_of, render
from vv.records.reading import fineness, label, ran, rung, status_of

Json = dict[str, Any]
POINTS = 41  # kept of a series
DIGITS = 6


def keep(
    folder: Path,
    records: Iterable[Mapping[str, Any]],
    series: Callable[[str], Mapping[str, Any]],
    circumstances: Mapping[str, Mapping[str, Any]],
) -> list[Path]:
    """Write what ran, unmodified, one file per code and case; returns the files.

    series: record key -> arrays. circumstances: code -> version, executables' digests, date, ...
    """
    piles: dict[tuple[str, str], list[Mapping[str, Any]]] = {}
    for record in records:
        if ran(record) and not record["modified"]:
            piles.setdefault((record["code"], record["case"]), []).append(record)
    written = []
    for (code, case), pile in piles.items():
        path = folder / code / f"{case}.json"
        finest = {_scheme(r): name_of(r) for r in sorted(pile, key=fineness)}
        document = {
            **circumstances[code],
            "code": code,
            "case": case,
            "parameters": {r["variant"]: dict(r["parameters"]) for r in pile},
            "results": {
                name_of(r): _compact(r, series if name_of(r) in finest.values() else None)
                for r in pile
            },
        }
        write_whole(path, render(document).encode())
        written.append(path)
    return written


def _scheme(record: Mapping[str, Any]) -> tuple[str, str]:
    return record["variant"], label(record)


def _compact(record: Mapping[str, Any], series: Callable[[str], Mapping[str, Any]] | None) -> Json:
    kept: Json = {"cpu": _few(record["cost"]["solve_cpu"])}
    arrays = series(record["key"]) if series else {}
    for entry in record["quantities"]:
        told = {**entry["figures"], **{f"{n} error": e for n, e in entry["errors"].items()}}
        kept[entry["name"]] = {name: _few(value) for name, value in told.items()}
        y = arrays.get(f"{entry['name']}.value")
        if y is not None:
            chosen = np.unique(np.linspace(0, len(y) - 1, POINTS).round().astype(int))
            kept[entry["name"]]["t"] = [_few(value) for value in arrays["t"][chosen]]
            kept[entry["name"]]["y"] = [_few(value) for value in y[chosen]]
    return kept


def _few(value: float | None) -> float | None:
    return None if value is None else float(f"{value:.{DIGITS}g}")


def shown(folder: Path, records: Sequence[Mapping[str, Any]], today: datetime.date) -> list[Json]:
    """The recorded results that may stand beside records of codes that are not installed.

    Only a result of the same variant, scheme, knobs and parameters is one. days: its age.
    """
    files: dict[tuple[str, str], Json] = {}
    found = []
    for record in records:
        if status_of(record) is not Status.NOT_INSTALLED:
            continue
        key = record["code"], record["case"]
        if key not in files:
            files[key] = _read(folder / key[0] / f"{key[1]}.json")
        document = files[key]
        result = document.get("results", {}).get(name_of(record))
        same = document.get("parameters", {}).get(record["variant"]) == record["parameters"]
        if result is not None and same:
            taken = datetime.datetime.fromisoformat(document["utc"]).date()
            names = ("case", "variant", "code", "scheme", "rung")
            found.append(
                {
                    **{name: record[name] for name in names},
                    "knobs": rung(record),
                    "version": document["version"],
                    "utc": document["utc"],
                    "days": (today - taken).days,
                    "cpu": result["cpu"],
                    "quantities": {n: v for n, v in result.items() if n != "cpu"},
                }
            )
    return found


def _read(path: Path) -> Json:
    if not path.is_file():
        return {}
    try:
        return dict(json.loads(path.read_text(encoding="utf-8")))
    except ValueError as error:
        raise UsageError(f"{path}: {error}") from error

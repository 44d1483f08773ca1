"""Accepted results: how they are kept and read.

One file per case, `CASE.json`: sorted, one result a line, so that a change reads well in review.
A result is named by variant, code/scheme and knobs; of each quantity it holds a few figures of
the value, their scale, and the error.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from vv.base.errors import UsageError
from vv.records.reading import error_of, label, rung

Json = dict[str, Any]
DIGITS = 12  # significant digits kept of a figure: a thousandth of the narrowest band


def read(folder: Path, case: str) -> Json | None:
    """The baseline of a case; None if it has none. Raises UsageError for a file that is broken."""
    path = folder / f"{case}.json"
    if not path.is_file():
        return None
    try:
        found: Json = json.loads(path.read_text(encoding="utf-8"))
        missing = {"acceptances", "parameters", "results"} - found.keys()
    except (ValueError, AttributeError) as error:
        raise UsageError(f"{path}: {error}") from error
    if missing or found.get("case") != case:
        raise UsageError(f"{path}: not a baseline of {case}; `vv accept {case}` writes one")
    return found


def render(baseline: Mapping[str, Any]) -> str:
    """The text of a baseline's file."""
    parts = []
    for name in sorted(baseline):
        value = baseline[name]
        if isinstance(value, Mapping) and value:
            lines = (f"  {json.dumps(k)}: {_line(value[k])}" for k in sorted(value))
            parts.append(f" {json.dumps(name)}: {{\n" + ",\n".join(lines) + "\n }")
        else:
            parts.append(f" {json.dumps(name)}: {_line(value)}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def _line(value: Any) -> str:
    return json.dumps(value, sort_keys=True, allow_nan=False)


def name_of(record: Mapping[str, Any]) -> str:
    """What a record's result is called in a baseline."""
    return f"{record['variant']} {label(record)} {rung(record)}".rstrip()


def result_of(record: Mapping[str, Any]) -> Json:
    """What a baseline keeps of a record: figures, scale and error of each quantity."""
    kept: Json = {
        entry["name"]: {
            "error": _rounded(error_of(entry)),
            "scale": _rounded(entry["scale"]),
            **{name: _rounded(value) for name, value in entry["figures"].items()},
        }
        for entry in record["quantities"]
    }
    if relative := record["cost"].get("relative"):
        kept["cost"] = [_rounded(value, 3) for value in relative]
    return kept


def _rounded(value: float | None, digits: int = DIGITS) -> float | None:
    return None if value is None else float(f"{value:.{digits}g}")

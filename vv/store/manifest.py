"""How a manifest, what one invocation did, is written: JSON whose parts can be read on their own.

The first line holds the names of its cases and where it comes from, and the records of a case
are a line each: past runs are asked for these far more often than for all they hold.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

Json = dict[str, Any]


def render(manifest: Mapping[str, Any]) -> str:
    """The text of a manifest, its records by case."""
    records: dict[str, list[Any]] = {}
    for record in manifest["records"]:
        records.setdefault(record["case"], []).append(record)
    head = {"holds": list(records), "provenance": manifest["provenance"]}
    by_case = ",\n".join(f"{_start(case)}{_text(own)}" for case, own in records.items())
    rest = ((name, part) for name, part in manifest.items() if name not in (*head, "records"))
    others = "".join(f",\n{_start(name)}{_text(part)}" for name, part in rest)
    return f'{_text(head)[:-1]},\n"records": {{\n{by_case}\n}}{others}}}\n'


def whole(text: str) -> Json:
    """The manifest of a text; raises ValueError if it is not one."""
    found = json.loads(text)
    if not isinstance(found, dict) or not isinstance(found.get("records"), dict):
        raise ValueError("its records are not by case")
    del found["holds"]
    return {**found, "records": [record for own in found["records"].values() for record in own]}


def head(lines: Iterator[str]) -> tuple[list[str], Json]:
    """The cases and the provenance of a manifest; raises ValueError if it is not one."""
    first = next(lines, "").rstrip()
    if not first.startswith('{"holds": ') or not first.endswith(","):
        raise ValueError("its first line names no cases")
    found = json.loads(first[:-1] + "}")
    return found["holds"], found["provenance"]


def records(lines: Iterable[str], case: str) -> list[Json]:
    """The records of one case in a manifest; raises ValueError if they are damaged."""
    start = _start(case)
    own = next((line for line in lines if line.startswith(start)), None)
    return [] if own is None else list(json.loads(own[len(start) :].rstrip(",\n")))


def _start(name: str) -> str:
    return f"{_text(name)}: "


def _text(part: Any) -> str:
    return json.dumps(part, allow_nan=False)

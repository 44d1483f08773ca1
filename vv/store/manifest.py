"""How a manifest, what one invocation did, is written: JSON whose parts can be read on their own.

The first line holds the names of its cases and where it comes from, and the records of a case
are a line each: past runs are asked for these far more often than for all they hold.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from vv.records import codec
from vv.records.job_record import Record
from vv.records.manifest import Manifest
from vv.records.provenance import Provenance

HEAD = ("holds", "provenance")


def render(manifest: Manifest) -> str:
    """The text of a manifest, its records by case."""
    records: dict[str, list[Record]] = {}
    for record in manifest.records:
        records.setdefault(record.case, []).append(record)
    by_case = ",\n".join(f"{_start(case)}{codec.render(own)}" for case, own in records.items())
    head = codec.render({"holds": [*records], "provenance": manifest.provenance})
    rest = (name for name in codec.names(Manifest) if name not in (*HEAD, "records", "name"))
    others = "".join(f",\n{_start(name)}{codec.render(getattr(manifest, name))}" for name in rest)
    return f'{head[:-1]},\n"records": {{\n{by_case}\n}}{others}}}\n'


def whole(text: str, name: str) -> Manifest:
    """The manifest of a text, of that name; raises ValueError if it is not one."""
    found = codec.parse(text)
    if not isinstance(found, dict) or not isinstance(found.get("records"), dict):
        raise ValueError("its records are not by case")
    records = [record for own in found["records"].values() for record in own]
    parts = {part: data for part, data in found.items() if part != "holds"}
    return codec.read(Manifest, {**parts, "records": records, "name": name}, "manifest")


def head(lines: Iterator[str]) -> tuple[tuple[str, ...], Provenance]:
    """The cases and the provenance of a manifest; raises ValueError if it is not one."""
    first = next(lines, "").rstrip()
    if not first.startswith('{"holds": ') or not first.endswith(","):
        raise ValueError("its first line names no cases")
    found = codec.parse(first[:-1] + "}")
    holds = codec.read(tuple[str, ...], found["holds"], "holds")
    return holds, codec.read(Provenance, found.get("provenance"), "provenance")


def records(lines: Iterable[str], case: str) -> tuple[Record, ...]:
    """The records of one case in a manifest; raises ValueError if they are damaged."""
    start = _start(case)
    own = next((line for line in lines if line.startswith(start)), None)
    data = [] if own is None else codec.parse(own[len(start) :].rstrip(",\n"))
    return codec.read(tuple[Record, ...], data, "records")


def _start(name: str) -> str:
    return f"{codec.render(name)}: "

"""Writes and reads manifests as JSON whose parts can be read on their own.

The first line holds the names of the cases and the provenance, and the records of each case are one
line, since these parts are read far more often than a whole manifest. The first line has its own
seal; it also holds the seals of each case's line and of all lines after the first.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping

from vv.records import codec
from vv.records.job_record import Record
from vv.records.manifest import Manifest, Provenance
from vv.store import record_list
from vv.store.seal import BrokenSealError, seal_of

HEAD = ("holds", "provenance")
ALL = ""  # the name of the seal of all lines after the first
OWN = ', "seal": "'  # the text before the seal of the first line


def render(manifest: Manifest) -> str:
    """The text of a manifest, its records by case."""
    records: dict[str, list[Record]] = {}
    for record in manifest.records:
        records.setdefault(record.case, []).append(record)
    lines = {case: f"{_start(case)}{record_list.render(own)}" for case, own in records.items()}
    by_case = ",\n".join(lines.values())
    rest = (name for name in codec.names(Manifest) if name not in (*HEAD, "records", "name"))
    held = {name: part for name in rest if (part := getattr(manifest, name)) is not None}
    others = "".join(f",\n{_start(name)}{codec.render(part)}" for name, part in held.items())
    body = f'"records": {{\n{by_case}\n}}{others}}}\n'
    return _sealed(manifest.name, manifest.provenance, lines, body)


def renamed(text: str, old: str, name: str, provenance: Provenance) -> str:
    """The text of a manifest with another name and provenance, otherwise unchanged.

    old: its present name. Raises ValueError if the text is no manifest, or damaged.
    """
    first, _, body = text.partition("\n")
    _check(_head(first, old), ALL, body, old)
    return _sealed(name, provenance, lines_of(iter(text.splitlines(keepends=True))), body)


def _sealed(name: str, provenance: Provenance, lines: Mapping[str, str], body: str) -> str:
    """The text of a manifest. lines: case -> the line of its records; body: all but the head."""
    parts = {ALL: body, **lines}
    seals = {part: seal_of(name, text.encode()) for part, text in parts.items()}
    head = codec.render({"holds": [*lines], "provenance": provenance, "seals": seals})
    return f'{head[:-1]}{OWN}{seal_of(name, head.encode())}",\n{body}'


def whole(text: str, name: str) -> Manifest:
    """Parse a manifest of this name; raises ValueError if the text is no manifest or damaged."""
    first, _, body = text.partition("\n")
    _check(_head(first, name), ALL, body, name)
    found = codec.parse(text)
    if not isinstance(found.get("records"), dict):
        raise ValueError("its records are not grouped by case")
    own = {
        case: record_list.read(pile, f"manifest.records.{case}")
        for case, pile in found["records"].items()
    }
    records = tuple(record for case in own.values() for record in case)
    parts = {part: data for part, data in found.items() if part not in ("holds", "seals", "seal")}
    bare = codec.read(Manifest, {**parts, "records": [], "name": name}, "manifest")
    for place, pile in own.items():
        _check_described(place, pile, bare)
    return dataclasses.replace(bare, records=records)


def _check_described(place: str, pile: tuple[Record, ...], rest: Manifest) -> None:
    """Raise ValueError where records name a case, variant or code that is not described."""
    facts = rest.cases.get(place)
    variants = set(facts.variants) if facts else set()
    for record in pile:
        if record.case != place or record.variant not in variants:
            what = f"{record.case}:{record.variant}"
            raise ValueError(f"a record among those of {place} is of {what}, not described there")
        if record.code not in rest.codes:
            raise ValueError(f"a record of {place} is of the code {record.code}, of none described")


def head(lines: Iterator[str], name: str) -> tuple[tuple[str, ...], Provenance]:
    """The cases and the provenance of a manifest; raises ValueError if it is not one."""
    found = _head(next(lines, "").rstrip("\n"), name)
    holds = codec.read(tuple[str, ...], found.get("holds"), "holds")
    return holds, codec.read(Provenance, found.get("provenance"), "provenance")


def records(lines: Iterator[str], case: str, name: str) -> tuple[Record, ...]:
    """The records of one case in a manifest; raises ValueError if they are damaged."""
    seals, start = _head(next(lines, "").rstrip("\n"), name), _start(case)
    own = next((line for line in lines if line.startswith(start)), "").rstrip(",\n")
    if not own and case not in seals["seals"]:
        return ()
    _check(seals, case, own, name)
    return record_list.read(codec.parse(own[len(start) :]), "records")


def lines_of(lines: Iterator[str]) -> dict[str, str]:
    """Case -> the line that holds its records, of a manifest that was found undamaged."""
    found = codec.parse(next(lines).rstrip(",\n") + "}")
    starts = {_start(case): case for case in found["holds"]}
    pairs = ((line[: line.find(": ") + 2], line) for line in lines)
    return {starts[start]: line.rstrip(",\n") for start, line in pairs if start in starts}


def _head(line: str, name: str) -> codec.Json:
    """The content of a manifest's first line; raises ValueError if its seal is broken."""
    text, own, end = line.rpartition(OWN)
    if not text.startswith('{"holds": ') or not own:
        raise BrokenSealError("its first line has no seal: it is of an older form, or damaged")
    if end != f'{seal_of(name, (text + "}").encode())}",':
        raise BrokenSealError("its first line is not what was stored: the digest differs")
    found: codec.Json = codec.parse(text + "}")
    codec.read(dict[str, str], found.get("seals"), "seals")
    return found


def _check(head: codec.Json, part: str, text: str, name: str) -> None:
    """Raise BrokenSealError unless a part has the digest that its seal states."""
    if head["seals"].get(part) != seal_of(name, text.encode()):
        what = f"the list of records of {part}" if part else "its content"
        raise BrokenSealError(f"{what} is not what was stored: the digest differs")


def _start(name: str) -> str:
    return f"{codec.render(name)}: "

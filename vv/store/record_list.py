"""Writes lists of records compactly: each by its differences from the one before.

Records of one scheme on one variant share most of their content, and refusals nearly all, so that a
manifest is half as long and shared parts are read once. A record that names its case is complete.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from vv.records import codec
from vv.records.codec import DamagedError, Json
from vv.records.job_record import Record

WHOLE = "case"  # the member that marks a complete record
FIELDS = codec.names(Record)


def render(records: Iterable[Record]) -> str:
    """Records of one case as a text in JSON."""
    return codec.dump([*_differences(records)])


def read(data: object, name: str) -> tuple[Record, ...]:
    """Records of plain data; raises DamagedError, in which `name` stands for the list."""
    if type(data) is not list:
        raise DamagedError(data, "must be a list", name)
    found: list[Record] = []
    members: Mapping[str, Any] = {}
    for number, one in enumerate(data):
        try:
            own = codec.members(Record, one)
            members = own if WHOLE in own else {**members, **own}
            found.append(Record(**members))
        except DamagedError as error:
            raise error.within(f"{name}[{number}]") from None
        except TypeError as error:  # a member without a default is missing in all records so far
            raise DamagedError(codec.MISSING, str(error), f"{name}[{number}]") from error
    return tuple(found)


def _differences(records: Iterable[Record]) -> Iterator[Json]:
    before: Record | None = None
    written: Json = {}
    for record in records:
        if before is None:
            written = {name: codec.to_data(getattr(record, name)) for name in FIELDS}
            yield codec.to_data(record)
        else:
            new = [name for name in FIELDS if getattr(record, name) is not getattr(before, name)]
            parts = {name: codec.to_data(getattr(record, name)) for name in new}
            other = {name: one for name, one in parts.items() if not _alike(one, written[name])}
            written |= other
            yield other
        before = record


def _alike(one: object, other: object) -> bool:
    """Whether two values have the same JSON text: 0.0 and -0.0 differ, as do 1 and 1.0."""
    return one == other and (type(one) is str or repr(one) == repr(other))

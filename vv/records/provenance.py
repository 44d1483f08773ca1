"""Where a result comes from: commit, command, machine, versions, time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Machine:
    """A processor, its cores and the system; the fingerprint tells one machine from another."""

    processor: str
    cores: int | None
    system: str
    fingerprint: str


@dataclass(frozen=True, slots=True)
class Provenance:
    """The circumstances of an invocation. utc: ISO time; dirty: files differed from the commit."""

    utc: str
    commit: str
    dirty: bool
    command: str
    machine: Machine
    versions: Mapping[str, str]
    threads: int

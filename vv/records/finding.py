"""What a gate finds: one thing worth saying, with the exit bit that it sets."""

from __future__ import annotations

import dataclasses
import enum
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any


class Bit(enum.IntFlag):
    """Exit bits of `vv`; each means one kind of trouble."""

    ACCURACY = 1
    CONSERVATION = 2
    SPEED = 4
    CRASH = 8
    TIMEOUT = 16
    INCOMPLETE = 32
    USAGE = 64


NOTICE = Bit(0)  # what a finding sets that is only worth knowing


@dataclass(frozen=True)
class Finding:
    """One thing worth saying of an invocation.

    check: what was judged. kind: what came of it, in a word. label: CODE/SCHEME. rung: knobs as
    text. bit: what it sets when enforced; none: a notice. size: how bad, for the order in lists:
    how many times the band or the tolerance.
    """

    check: str
    kind: str
    text: str
    case: str = ""
    variant: str = ""
    label: str = ""
    rung: str = ""
    quantity: str = ""
    bit: Bit = NOTICE
    enforced: bool = True
    size: float = 0.0

    @property
    def red(self) -> bool:
        """Whether it turns the gate red."""
        return bool(self.bit) and self.enforced

    @property
    def compares(self) -> bool:
        """Whether it says what changed since a baseline."""
        return self.check in ("regression", "speed")

    @property
    def where(self) -> str:
        """What it is about, in words as people type them."""
        variant = f":{self.variant}" if self.variant else ""
        parts = (f"{self.case}{variant}", self.label, self.rung, self.quantity)
        return " ".join(part for part in parts if part)

    def as_data(self) -> dict[str, Any]:
        """The finding as plain data, for a manifest."""
        return {**dataclasses.asdict(self), "bit": int(self.bit)}


def from_data(data: Mapping[str, Any]) -> Finding:
    """The finding that `as_data` wrote."""
    return Finding(**{**data, "bit": Bit(data["bit"])})


def worst_first(findings: Iterable[Finding]) -> list[Finding]:
    """Red ones first, then those with a bit, then notices; the largest first in each."""
    return sorted(findings, key=lambda f: (not f.red, not f.bit, -f.size, f.where, f.check))


def bits(findings: Iterable[Finding]) -> Bit:
    """The exit bits of all that turn the gate red."""
    total = Bit(0)
    for finding in findings:
        total |= finding.bit if finding.red else Bit(0)
    return total

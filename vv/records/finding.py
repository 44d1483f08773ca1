"""A finding of the gate: one statement, with the exit bit that it sets."""

from __future__ import annotations

import enum
from collections.abc import Iterable
from dataclasses import dataclass

from vv.case import Check


class Bit(enum.IntFlag):
    """Exit bits of `vv`; each means one kind of trouble."""

    ACCURACY = 1
    CONSERVATION = 2
    SPEED = 4
    CRASH = 8
    TIMEOUT = 16
    INCOMPLETE = 32
    USAGE = 64


class Aspect(enum.Enum):
    """The subject of a finding: that jobs ran, or a check of a case; the value is the word."""

    RUN = "run"
    ACCURACY = Check.ACCURACY.value
    REGRESSION = Check.REGRESSION.value
    SPEED = Check.SPEED.value
    CONSERVATION = Check.CONSERVATION.value


class Change(enum.Enum):
    """How a result changed since it was accepted; the value is the word shown to people."""

    NEW = "new"
    GONE = "gone"
    WORSE = "worse"
    BETTER = "better"
    MOVED = "moved"
    SLOWER = "slower"
    FASTER = "faster"
    NO_BASELINE = "no baseline"
    OTHER_PARAMETERS = "other parameters"


IMPROVED = (Change.BETTER.value, Change.FASTER.value)
NOTICE = Bit(0)  # the bit of a finding that is only a notice


@dataclass(frozen=True, slots=True)
class Finding:
    """One statement on an invocation.

    check: the aspect that was judged. kind: the result in a word, such as that of a Change. label:
    CODE/SCHEME. rung: knobs as text. bit: the exit bit that it sets when enforced; zero for a
    notice. size: the severity, by which lists are sorted: a multiple of the band or the tolerance.
    """

    check: Aspect
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
        """Whether it reports a change since a baseline."""
        return self.check in (Aspect.REGRESSION, Aspect.SPEED)

    @property
    def improves(self) -> bool:
        """Whether it reports that something is better than accepted."""
        return self.compares and self.kind in IMPROVED

    @property
    def where(self) -> str:
        """Its case, variant, scheme and setting, in the form that people type."""
        variant = f":{self.variant}" if self.variant else ""
        parts = (f"{self.case}{variant}", self.label, self.rung, self.quantity)
        return " ".join(part for part in parts if part)


def worst_first(findings: Iterable[Finding]) -> list[Finding]:
    """The findings: red ones, then those with a bit, then notices; each with the largest first."""
    return sorted(findings, key=lambda f: (not f.red, not f.bit, -f.size, f.where, f.check.value))


def bits(findings: Iterable[Finding]) -> Bit:
    """The exit bits of all findings that turn the gate red."""
    total = Bit(0)
    for finding in findings:
        total |= finding.bit if finding.red else Bit(0)
    return total

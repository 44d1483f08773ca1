"""The statements that a paper publishes, and what is known to be right of each."""

from __future__ import annotations

import enum
import math
import re
from collections.abc import Callable
from dataclasses import dataclass

from vv.ask import Knobs

LEADING = re.compile(r"[<>~]?\s*(-?\d+(?:\.\d*)?(?:e-?\d+)?)")


class Standing(enum.Enum):
    """What became of a published statement; the value is the word shown to people."""

    REPRODUCED = "reproduced"
    DIFFERS = "not reproduced"
    MISPRINT = "misprint"
    WRONG = "wrong"
    OPEN = "cannot be computed"

    def counted(self, count: int) -> str:
        """The number of statements of which this became, in words."""
        plural = "s" if self is Standing.MISPRINT and count != 1 else ""
        return f"{count} {self.value}{plural}"


class Figure(enum.Enum):
    """Which number of a quantity answers a statement; the value is its name in stored results."""

    VALUE = "value"
    FINAL = "final"
    ERROR = "error"


@dataclass(frozen=True)
class Seen:
    """Where codes answer a statement: a quantity of CASE:VARIANT, at one rung or at the finest.

    times: what the figure is multiplied by to be in the statement's unit, 100 for per cent.
    """

    case: str
    variant: str
    quantity: str
    figure: Figure = Figure.VALUE
    times: float = 1.0
    rung: Knobs | None = None


@dataclass(frozen=True, eq=False)
class Statement:
    """One published number or claim.

    place: figure, equation or section. printed: as the paper has it, beginning with its number if
    it has one. unit: of that number and of what stands beside it. exact: the right number, or words
    where there is none. why: what makes it a misprint or wrong, or what is missing; a reproduced
    statement needs none. close: how far the exact number of a reproduced statement may be from
    the printed one, if not half a unit of its last place. Raises ValueError for a statement without
    a reason that needs one.
    """

    place: str
    what: str
    printed: str
    standing: Standing
    why: str = ""
    unit: str = ""
    exact: Callable[[], float] | str = ""
    seen: tuple[Seen, ...] = ()
    close: float | None = None

    def __post_init__(self) -> None:
        if self.standing is not Standing.REPRODUCED and not self.why:
            raise ValueError(
                f"{self.place}, {self.what}: why = ''; what is {self.standing.value} has a reason"
            )

    @property
    def number(self) -> float | None:
        """The printed number; None where the statement has none, or a bound."""
        found = LEADING.match(self.printed)
        return float(found[1]) if found and self.printed[0] not in "<>" else None

    @property
    def allowance(self) -> float:
        """How far the exact number may be from the printed one: half its last place, or `close`."""
        if self.close is not None:
            return self.close
        found = LEADING.match(self.printed)
        if found is None:
            return math.inf
        digits, _, power = found[1].partition("e")
        places = len(digits.partition(".")[2])
        return 0.5001 * 10.0 ** (int(power or 0) - places)


@dataclass(frozen=True, eq=False)
class Paper:
    """A paper: its short name, citation and DOI, and its statements in its own order."""

    name: str
    citation: str
    doi: str
    statements: tuple[Statement, ...]

"""The statements that a paper publishes, and an assessment of each."""

from __future__ import annotations

import enum
import math
import re
from collections.abc import Callable
from dataclasses import dataclass

from vv.ask import Knobs

LEADING = re.compile(r"[<>~]?\s*(-?\d+(?:\.\d*)?(?:e-?\d+)?)")


class Assessment(enum.Enum):
    """Whether a published statement is right; the value is the phrase shown to people."""

    REPRODUCED = "reproduced"
    DIFFERS = "not reproduced"
    MISPRINT = "misprint"
    WRONG = "wrong"
    OPEN = "cannot be computed"

    def counted(self, count: int) -> str:
        """A number of statements with this assessment, in words."""
        plural = "s" if self is Assessment.MISPRINT and count != 1 else ""
        return f"{count} {self.value}{plural}"


class Figure(enum.Enum):
    """The number of a quantity that a statement gives; the value is its name in stored results."""

    VALUE = "value"
    FINAL = "final"
    ERROR = "error"


@dataclass(frozen=True)
class Computed:
    """Where codes compute the number of a statement: a quantity of CASE:VARIANT at a rung.

    rung: None means the finest. times: the factor that converts the number to the unit of the
    statement, such as 100 for per cent.
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

    place: figure, equation or section. printed: the text in the paper, beginning with its number if
    it has one. unit: of that number and of those compared with it. exact: the right number, or
    words if there is none. why: the reason for any assessment other than reproduced. close: how far
    the exact number of a reproduced statement may be from the printed one, if not half a unit of
    its last place. Raises ValueError if a required reason is missing.
    """

    place: str
    what: str
    printed: str
    assessment: Assessment
    why: str = ""
    unit: str = ""
    exact: Callable[[], float] | str = ""
    computed: tuple[Computed, ...] = ()
    close: float | None = None

    def __post_init__(self) -> None:
        if self.assessment is not Assessment.REPRODUCED and not self.why:
            raise ValueError(
                f"{self.place}, {self.what}: why = ''; what is {self.assessment.value} has a reason"
            )

    @property
    def number(self) -> float | None:
        """The printed number; None if the statement has none, or only a bound."""
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

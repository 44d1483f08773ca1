"""Rows of the tables of tests/findings: a figure, what shows it, and its band."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import pytest

from tests.findings.figures import PROJECT, Figure, Read, asked, error
from tests.findings.recorded import recorded
from tests.support.installed import excused, require
from vv.ask import Knobs
from vv.case import Level


class Row(NamedTuple):
    """What shows a figure: a variant and changes of it, a scheme, a setting, and a band.

    what: a function of the answer, or the name of a quantity whose error is meant.
    """

    name: str
    scheme: str
    at: Knobs | Level | None
    what: str | Figure
    low: float
    high: float

    def found(self) -> float:
        """The figure of a run; as recorded, where the code is not installed and that is kept."""
        figure = error(self.what) if isinstance(self.what, str) else self.what
        return shown(self.name, self.scheme, self.at, figure)

    def check(self) -> None:
        """Fail if the figure is outside its band; skip where it is neither found nor recorded."""
        assert self.low <= self.found() <= self.high


def shown(name: str, scheme: str, at: Knobs | Level | None, figure: Figure) -> float:
    """A figure of a run, or of its record; skips the test if there is neither."""
    adapter = PROJECT.load_adapter(scheme.partition("/")[0])
    if excused(adapter) and isinstance(figure, Read):
        kept = recorded(name, scheme, at, figure)
        if kept is not None:
            return kept
    require(adapter)
    return figure(asked(name, scheme, at))


Table = Mapping[str, Sequence[Row]]  # words of docs/findings.md, and what shows them


def rows(table: Table) -> list[object]:
    """The parameters of a test of all rows of a table."""
    return [
        pytest.param(row, id=f"{told}: {row.name} {row.scheme} {row.at}")
        for told, group in table.items()
        for row in group
    ]


def each(schemes: str, row: Sequence[object]) -> tuple[Row, ...]:
    """The same row for several schemes, CODE/SCHEME,...; the row is without its scheme."""
    name, *others = row
    return tuple(Row(name, scheme, *others) for scheme in schemes.split(","))  # type: ignore[arg-type]

"""Errors and costs of a scheme on a variant by setting, and the floor of its error."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from vv.base.metrics import LEAST_IMPROVEMENT, count_before_floor
from vv.records.job_record import Record
from vv.records.manifest import CodeFound, Manifest
from vv.records.reading import by_fineness, tried
from vv.records.rungs import Floor, Point, Row, row_of

PATIENCE = 60.0  # CPU seconds after which a missing improvement counts as a floor


@dataclass(frozen=True)
class Effort:
    """A scheme on a variant; rows by stiffness, softest first."""

    case: str
    variant: str
    label: str
    external: bool
    rows: tuple[Row, ...]

    @functools.cached_property
    def floor(self) -> Floor | None:
        """The floor of the error over all knobs."""
        return _floor(self.rows)

    @property
    def points(self) -> tuple[Point, ...]:
        """The rungs, by stiffness and step, coarsest first."""
        return tuple(point for row in self.rows for point in row.points)

    @property
    def stepping(self) -> bool:
        """Whether the scheme advances by time steps."""
        return any(point.dt is not None for point in self.points)

    @property
    def timed(self) -> bool:
        """Whether any rung was timed."""
        return any(point.cpu is not None for point in self.points)

    @property
    def best(self) -> float | None:
        """The smallest error of the scheme on the variant."""
        return min((p.error for p in self.points if p.error is not None), default=None)


def efforts(manifest: Manifest) -> list[Effort]:
    """Every scheme that ran on a variant of which something was timed, in the order of records."""
    every = every_effort(manifest)
    timed = _timed(every)
    return [effort for effort in every if (effort.case, effort.variant) in timed]


def untimed(manifest: Manifest) -> list[Effort]:
    """Every scheme with an error on a variant of which nothing was timed."""
    every = every_effort(manifest)
    timed = _timed(every)
    rest = [effort for effort in every if (effort.case, effort.variant) not in timed]
    return [effort for effort in rest if effort.best is not None]


def untimed_costs(effort: Effort) -> Effort:
    """The effort of a scheme with its indicative costs in place of timed ones."""
    rows = tuple(
        dataclasses.replace(
            row,
            points=tuple(dataclasses.replace(p, cpu=p.indicative or None) for p in row.points),
        )
        for row in effort.rows
    )
    return dataclasses.replace(effort, rows=rows)


def _timed(every: Iterable[Effort]) -> set[tuple[str, str]]:
    return {(effort.case, effort.variant) for effort in every if effort.timed}


def every_effort(manifest: Manifest) -> list[Effort]:
    """Every scheme that attempted a variant, timed or not.

    Raises ValueError if costs are of several timing sessions.
    """
    records = manifest.records
    sessions = {r.cost.session for r in records if r.cost.timed}
    if len(sessions) > 1:
        raise ValueError(
            f"costs are of {len(sessions)} timing sessions ({', '.join(sorted(sessions))}); they "
            "may be compared within one only"
        )
    piles: dict[tuple[str, str, str], list[Record]] = {}
    for record in filter(tried, records):
        key = (record.case, record.variant, record.label)
        piles.setdefault(key, []).append(record)
    return [_effort(key, pile, manifest.codes) for key, pile in piles.items()]


def _effort(
    key: tuple[str, str, str], pile: Sequence[Record], codes: Mapping[str, CodeFound]
) -> Effort:
    pile = sorted(pile, key=by_fineness)
    rows = tuple(
        row_of(kn, [r for r in pile if r.rung.kn == kn])
        for kn in dict.fromkeys(record.rung.kn for record in pile)
    )
    return Effort(*key, bool(codes[pile[0].code].files), rows)


def _floor(rows: Sequence[Row]) -> Floor | None:
    """The floor of a scheme, if two refinements of each knob hardly reduced the error.

    dt is judged at the highest stiffness that has three steps, beyond which no stiffness may gain;
    the stiffness is judged by the smallest error at each.
    """
    least = [min(row.errors) for row in rows if row.errors]
    if not least:
        return None
    spent = max((point.cpu or 0.0 for row in rows for point in row.points), default=0.0)
    if spent >= PATIENCE:
        return Floor(min(least), f"{spent:.0f} s were spent")
    at = max((i for i, row in enumerate(rows) if len(row.errors) > 2), default=None)
    if at is None or rows[at].floor is None or any(map(_gains, rows[at + 1 :])):
        return None
    if len(rows) == 1:
        return rows[at].floor
    if count_before_floor(least) == len(least):
        return None
    why = f"two refinements each of dt, at kn = {rows[at].kn:g}, and of kn"
    return Floor(min(least), f"{why} improved less than {LEAST_IMPROVEMENT:g} times")


def _gains(row: Row) -> bool:
    """Whether the last refinement of the step in a row reduced the error enough."""
    last = row.errors[-2:]
    return len(last) == 2 and last[0] >= LEAST_IMPROVEMENT * last[1]

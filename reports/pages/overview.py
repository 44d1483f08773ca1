"""The data of the front page: each scheme's error and cost on each variant."""

from __future__ import annotations

import functools
import math
import statistics
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from reports.book import Book, Place
from reports.marks import Mark
from reports.outcomes import ShownOutcome
from reports.variant.advice import TARGETS
from reports.variant.ranking import ranks
from reports.variant.reading import TARGET
from vv.insight.accuracy_cost import error_cost
from vv.insight.effort import untimed_costs
from vv.insight.stability_summary import Kind


@dataclass(frozen=True)
class Cell:
    """A scheme on a variant: the error at its finest setting, CPU seconds, worst outcome."""

    error: float | None
    cpu: float | None
    worst: ShownOutcome
    ladder: bool


@dataclass(frozen=True)
class Row:
    """A scheme: its coverage, accuracy, cost and failures.

    median: of its error over the variants that a scheme of every code solves, `shared` of which
    it solves itself. dear: median of its cost to TARGET over that of the cheapest, over `reached`
    of `timed` variants. step: the least and largest stable step over what theory gives.
    """

    mark: Mark
    in_house: bool
    covers: int
    median: float | None
    shared: int
    dear: float | None
    reached: int
    step: tuple[float, float] | None
    red: int
    reported: int


@dataclass(frozen=True)
class Overview:
    """cells: place -> label -> cell. costs: place -> label -> CPU to each of TARGETS, or None.

    common: how many variants a scheme of every code solves; timed: how many have costs; guessed:
    whether none was timed alone, so that costs are those measured while other jobs ran.
    """

    cells: Mapping[Place, Mapping[str, Cell]]
    costs: Mapping[Place, Mapping[str, Sequence[float | None]]]
    rows: Sequence[Row]
    common: int
    timed: int
    guessed: bool


@functools.lru_cache(maxsize=1)
def overview(book: Book) -> Overview:
    """The numbers of a manifest."""
    cells = {
        place: {row.mark.label: Cell(row.error, row.cpu, row.worst, row.ladder) for row in rows}
        for place, rows in ranks(book).items()
    }
    efforts = book.efforts
    guessed = not any(e.timed for here in efforts.values() for e in here)
    if guessed:
        efforts = {place: [*map(untimed_costs, here)] for place, here in efforts.items()}
    costs = {
        place: {e.label: [error_cost(e, target).cpu for target in TARGETS] for e in here}
        for place, here in efforts.items()
        if any(e.timed for e in here)
    }
    common = _common(cells)
    steps = _steps(book)
    rows = [
        _row(book, mark, cells, common, _ratios(costs, mark.label), steps)
        for mark in book.marks.values()
    ]
    return Overview(cells, costs, rows, len(common), len(costs), guessed)


def _solved(cell: Cell) -> bool:
    """Whether a cell has an error that can be compared with those of others."""
    return cell.ladder and cell.error is not None


def _common(cells: Mapping[Place, Mapping[str, Cell]]) -> list[Place]:
    """The variants that every code solves with one of its schemes."""
    codes = {label.partition("/")[0] for here in cells.values() for label in here}
    return [
        place
        for place, here in cells.items()
        if codes and {n.partition("/")[0] for n, cell in here.items() if _solved(cell)} == codes
    ]


def _ratios(costs: Mapping[Place, Mapping[str, Sequence[float | None]]], label: str) -> list[float]:
    """The costs of a scheme to reach TARGET over the cheapest, on variants where it does."""
    at, found = TARGETS.index(TARGET), []
    for here in costs.values():
        own = here.get(label, [None] * len(TARGETS))[at]
        known = [row[at] for row in here.values()]
        best = min((cpu for cpu in known if cpu is not None), default=None)
        if own is not None and best:
            found.append(own / best)
    return found


def _steps(book: Book) -> dict[str, tuple[float, float]]:
    """Label -> the least and largest stable step found, over what theory gives."""
    found: dict[str, list[float]] = {}
    for one in book.stability:
        if one.kind is Kind.STEP and one.value is not None and one.due:
            found.setdefault(one.label, []).append(one.value / one.due)
    return {label: (min(values), max(values)) for label, values in found.items()}


def _row(
    book: Book,
    mark: Mark,
    cells: Mapping[Place, Mapping[str, Cell]],
    common: Sequence[Place],
    ratios: Sequence[float],
    steps: Mapping[str, tuple[float, float]],
) -> Row:
    own = [here[mark.label] for here in cells.values() if mark.label in here]
    shared = [cells[place].get(mark.label) for place in common]
    errors = [cell.error for cell in shared if cell and cell.error is not None and _solved(cell)]
    open_ones = [f for f in book.findings if f.label == mark.label and f.bit and not f.improves]
    return Row(
        mark=mark,
        in_house=mark.code not in book.manifest.external(),
        covers=len(own),
        median=statistics.median(errors) if errors else None,
        shared=len(errors),
        dear=math.exp(statistics.median(map(math.log, ratios))) if ratios else None,
        reached=len(ratios),
        step=steps.get(mark.label),
        red=sum(f.red for f in open_ones),
        reported=sum(not f.red for f in open_ones),
    )

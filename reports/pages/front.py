"""The front page: failures, ranking of codes, cost of accuracy, coverage."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from markupsafe import Markup

from reports.book import Book
from reports.drawing import charts
from reports.drawing.curves import draw
from reports.marks import Mark
from reports.outcomes import OUTCOMES, ShownOutcome, summed
from reports.pages import coverage_map
from reports.pages.overview import Overview, overview
from reports.pages.troubles import CARDS, Trouble, troubles
from reports.text import brief
from reports.variant.advice import TARGETS
from reports.variant.reading import TARGET
from vv.case.published import Assessment
from vv.insight.papers import counted as assessments
from vv.output.markdown import headline
from vv.records.outcomes import Outcome


@dataclass(frozen=True)
class Front:
    """What the front page shows. data: JSON that its script recomputes charts and medians from."""

    verdict: str
    red: bool
    reported: int
    counts: Sequence[tuple[ShownOutcome, int]]
    overview: Overview
    codes: Mapping[str, bool]
    profile: Markup
    target: float
    targets: Sequence[float]
    shares: Sequence[tuple[Mark, Sequence[float | None]]]
    cards: Sequence[Trouble]
    more: int
    known: int
    papers: Mapping[Assessment, int]
    rows: Markup
    data: str


def front(book: Book) -> Front:
    """The view of the front page."""
    seen, all_troubles = overview(book), troubles(book)
    external, counts = book.manifest.external(), summed(came for _, came in book.shown)
    ratios = _profile(book, seen, TARGET)
    chart = charts.shares(
        [(book.marks[label], row) for label, row in ratios.items()],
        f"share solved to {brief(TARGET)}",
    )
    return Front(
        verdict=headline(book.findings),
        red=any(f.red for f in book.findings),
        reported=sum(1 for f in book.findings if f.bit and not f.red and not f.improves),
        counts=counts,
        overview=seen,
        codes={m.code: m.code not in external for m in book.marks.values()},
        profile=draw(chart) if chart else Markup(""),
        target=TARGET,
        targets=TARGETS,
        shares=_shares(book, seen),
        cards=all_troubles[:CARDS],
        more=max(0, len(all_troubles) - CARDS),
        known=dict(counts).get(OUTCOMES[Outcome.XFAIL], 0),
        papers=assessments(row for _, rows in book.beside.papers for row in rows),
        rows=coverage_map.rows(book, seen),
        data=_data(book, seen),
    )


def _profile(book: Book, seen: Overview, target: float) -> dict[str, list[float]]:
    """Label -> its cost over that of the cheapest on each timed variant; inf where it fails."""
    at = TARGETS.index(target)
    found: dict[str, list[float]] = {label: [] for label in book.marks}
    for here in seen.costs.values():
        known = {label: row[at] for label, row in here.items() if row[at] is not None}
        best = min((cpu for cpu in known.values() if cpu), default=None)
        if best is not None:
            for label, row in found.items():
                cpu = known.get(label)
                row.append(math.inf if cpu is None else cpu / best)
    return {label: row for label, row in found.items() if any(map(math.isfinite, row))}


def _shares(book: Book, seen: Overview) -> list[tuple[Mark, list[float | None]]]:
    """Scheme -> the share of the variants that anybody solves which it solves, at each target."""
    profiles = [_profile(book, seen, target) for target in TARGETS]
    labels = [label for label in book.marks if any(label in one for one in profiles)]
    return [(book.marks[label], [_share(one.get(label)) for one in profiles]) for label in labels]


def _share(row: Sequence[float] | None) -> float | None:
    return sum(map(math.isfinite, row)) / len(row) if row else None


def _data(book: Book, seen: Overview) -> str:
    """All that the page's script recomputes from, few digits each."""
    places = list(seen.cells)
    errors = {label: [_error(seen, place, label) for place in places] for label in book.marks}
    costs = {
        f"{case}:{variant}": {
            label: [None if cpu is None else float(f"{cpu:.3g}") for cpu in row]
            for label, row in here.items()
            if any(cpu is not None for cpu in row)
        }
        for (case, variant), here in seen.costs.items()
    }
    parts: dict[str, object] = {
        "looks": {label: [m.colour, m.dash, m.points] for label, m in book.marks.items()},
        "targets": TARGETS,
        "errors": errors,
        "costs": costs,
        "guessed": seen.guessed,
    }
    text = json.dumps(parts, separators=(",", ":"))
    return text.replace("&", "\\u0026").replace("<", "\\u003c").replace(">", "\\u003e")


def _error(seen: Overview, place: tuple[str, str], label: str) -> float | None:
    cell = seen.cells[place].get(label)
    known = cell is not None and cell.ladder and cell.error is not None
    return float(f"{cell.error:.2e}") if known and cell and cell.error is not None else None

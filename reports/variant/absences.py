"""Lists settings and schemes of a variant without results, with the reasons."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from reports import plain
from reports.marks import Mark
from reports.outcomes import ShownOutcome, shown_outcome
from reports.variant.reading import anchor
from vv.records.job_record import Record
from vv.records.reading import tried

LONG = 50  # reasons longer than this appear once on a page


@dataclass(frozen=True)
class Absent:
    """Settings of one scheme without result, all for one reason.

    anchor: the scheme's place, if nothing else of it has that and something leads there. whole:
    whether nothing of it ran.
    """

    anchor: str
    mark: Mark
    outcome: ShownOutcome
    settings: Sequence[str]
    reason: str
    whole: bool


def absent(piles: Mapping[str, Sequence[Record]], looks: Mapping[str, Mark]) -> list[Absent]:
    """Settings without results: one row per scheme, outcome and reason."""
    rows: dict[tuple[str, str, str], list[Record]] = {}
    for label, pile in piles.items():
        for record in pile:
            if not record.quantities:
                key = (label, shown_outcome(record).key.value, record.reason)
                rows.setdefault(key, []).append(record)
    anchored = {label for label, pile in piles.items() if any(map(tried, pile))}
    found = []
    for (label, _, why), pile in rows.items():
        shown = shown_outcome(pile[0])
        place = anchor(pile[0]) if shown.troubling and label not in anchored else ""
        whole = not any(map(tried, piles[label]))
        settings = [text for r in pile if (text := plain.setting(r))]
        found.append(Absent(place, looks[label], shown, settings, why, whole))
        anchored.add(label)
    return found


@dataclass(frozen=True)
class Silent:
    """Schemes without any result, all for one reason.

    like: the variant above on the page at which the reason stands; empty if it stands here.
    """

    outcome: ShownOutcome
    reason: str
    marks: Sequence[tuple[str, Mark]]
    like: str = ""


def silent(rows: Sequence[Absent], variant: str, above: dict[str, str]) -> list[Silent]:
    """The schemes without any result, a row for each reason.

    above: reasons that stand above on the page -> at which variant; new ones are added to it.
    """
    found: dict[tuple[ShownOutcome, str], list[tuple[str, Mark]]] = {}
    for row in rows:
        if row.whole:
            reason = row.reason.removeprefix(f"{row.mark.label} does not support: ")
            found.setdefault((row.outcome, reason), []).append((row.anchor, row.mark))
    made = []
    for (outcome, reason), marks in found.items():
        like = above.setdefault(reason, variant) if len(reason) > LONG else variant
        made.append(Silent(outcome, reason, marks, "" if like == variant else like))
    return made

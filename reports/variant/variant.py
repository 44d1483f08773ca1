"""A variant's part of a case's page: scene, settings and results."""

from __future__ import annotations

import functools
import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from markupsafe import Markup

from reports import plain
from reports.book import Book, Place
from reports.drawing import collect
from reports.drawing.collect import History
from reports.drawing.gallery import Figure
from reports.drawing.playback import moving, playback
from reports.outcomes import ShownOutcome, counted, shown_outcome
from reports.text import slug
from reports.variant.absences import Absent, Silent, absent, silent
from reports.variant.advice import Advice, advice
from reports.variant.costs import CostRow, cost_rows
from reports.variant.figures import Over, all_figures, is_drawn
from reports.variant.inputs import Input, inputs
from reports.variant.measurements import MeasuredRow, measured_rows
from reports.variant.models import Modelled, Told, models
from reports.variant.other_codes import PrintedRow, printed_rows
from reports.variant.ranking import Dear, Ranked, cheapest, ranks, why_colours_differ
from reports.variant.settings import Group, groups
from vv.insight.agreement import agreements
from vv.output.gallery.scene_drawing import again, picture
from vv.records.case_facts import VariantFacts
from vv.records.job_record import Record
from vv.records.reading import changed, fineness, settings
from vv.records.recorded import RecordedResult
from vv.scene.picture.sketch import Sketch


@dataclass(frozen=True)
class Recorded:
    """A recorded result of a code that is not installed: never a live one. days: its age."""

    label: str
    version: str
    date: str
    days: int
    error: float | None


@dataclass(frozen=True)
class Variant:
    """A variant: what was asked, and all that came of it.

    not_green: rows that are not green, and why; like: the variant whose figures fit; answers:
    which codes agree, where three have a result; undrawn: (name, symbol) of quantities in bounds.
    """

    name: str
    anchor: str
    facts: VariantFacts
    scene: Markup
    settings: Mapping[str, float]
    modified: bool
    command: str
    outcomes: Sequence[tuple[ShownOutcome, int]]
    ranked: Sequence[Ranked]
    cheapest: Sequence[Dear]
    differ: str
    not_green: Sequence[tuple[Ranked, str]]
    answers: Sequence[str]
    groups: Sequence[Group]
    absent: Sequence[Absent]
    silent: Sequence[Silent]
    models: Sequence[Modelled]
    measured: Sequence[MeasuredRow]
    printed: Sequence[PrintedRow]
    figures: Sequence[Figure]
    playback: str
    like: str
    undrawn: Sequence[tuple[str, str]]
    has_series: bool
    advice: Sequence[Advice]
    costs: Sequence[CostRow]
    recorded: Sequence[Recorded]
    inputs: Sequence[Input]


@dataclass(frozen=True)
class Above:
    """The parts of a page above a variant, which it need not repeat; each variant adds its own.

    curves: variant -> what its figures show; inputs: code -> those that are shown whole;
    models: how whom modelled a scene, and at which variant; reasons: why nothing ran -> variant;
    explained: what is not green, in long words -> where;
    scenes: -> the name of its picture.
    """

    curves: dict[str, list[History]] = field(default_factory=dict)
    inputs: dict[str, list[Input]] = field(default_factory=dict)
    models: Told = field(default_factory=dict)
    reasons: dict[str, str] = field(default_factory=dict)
    explained: dict[str, str] = field(default_factory=dict)
    scenes: dict[Sketch, str] = field(default_factory=dict)


def variant(book: Book, place: Place, above: Above) -> Variant:
    """The view of a variant."""
    case, name = place
    facts, piles = book.manifest.cases[case].variants[name], book.records[place]
    own = [record for pile in piles.values() for record in pile]
    over = functools.cache(lambda name: collect.histories(own, name, book.marks, book.arrays))
    like = _like(name, over(facts.quantities[0].name) if facts.quantities else [], own, above)
    rows, missing = ranks(book)[place], absent(piles, book.marks)
    kept = [one for one in book.manifest.recorded if (one.case, one.variant) == place]
    return Variant(
        name=name,
        anchor=slug(case, name),
        facts=facts,
        scene=_scene(facts.sketch, slug(case, name), above),
        settings=_settings(book, case, own),
        modified=any(record.modified for record in own),
        command=_command(place, own),
        outcomes=counted(own),
        ranked=rows,
        cheapest=cheapest(rows),
        differ=why_colours_differ(rows),
        not_green=_not_green(rows, name, above),
        answers=[agreement.in_words() for agreement in agreements(own, kept)],
        groups=groups(piles, book.marks),
        absent=missing,
        silent=silent(missing, name, above.reasons),
        models=models(rows, name, above.models),
        measured=measured_rows(book, place),
        printed=printed_rows(piles, facts.quantities),
        figures=all_figures(book, place, own, over, bool(like)),
        playback=_played(facts, over),
        like=like,
        undrawn=[(q.name, q.symbol) for q in facts.quantities if not is_drawn(q, facts, own)],
        has_series=any(book.arrays(r.key) for r in own if r.quantities),
        advice=advice(book.efforts.get(place, [])),
        costs=cost_rows(book, place),
        inputs=inputs(book, place, above.inputs),
        recorded=_recorded(kept, facts),
    )


def _like(name: str, curves: list[History], own: Sequence[Record], above: Above) -> str:
    """The variant above whose figures serve here too; '' if none does."""
    like = next((v for v, other in above.curves.items() if collect.same_curve(other, curves)), "")
    if not like:
        above.curves[name] = curves
    if any(shown_outcome(record).troubling for record in own):
        return ""  # a reader who looks for an error needs this picture
    return like


def _command(place: Place, own: Sequence[Record]) -> str:
    """The command that runs the variant again, with the parameters that a user changed."""
    texts = settings(own[0]) if own else []
    return shlex.join(["vv", "run", ":".join(place), *(w for t in texts for w in ("--set", t))])


def _settings(book: Book, case: str, own: Sequence[Record]) -> dict[str, float]:
    """The parameters that a user changed; if there are none, those that differ from the case's."""
    if own and own[0].modified:
        return changed(own[0])
    usual = {p.name: p.value for p in book.manifest.cases[case].parameters}
    given = own[0].parameters if own else {}
    return {key: value for key, value in given.items() if value != usual.get(key)}


def _not_green(rows: Sequence[Ranked], name: str, above: Above) -> list[tuple[Ranked, str]]:
    """The rows that are not green, with reasons; long reasons appear once on a page."""
    return [
        (row, plain.once(row.why, f"{name}, {row.mark.label}", above.explained))
        for row in rows
        if row.why
    ]


def _scene(seen: Sketch | None, anchor: str, above: Above) -> Markup:
    """The picture of a scene, or a reference to the same one above."""
    if seen is None:
        return Markup("")
    name = above.scenes.setdefault(seen, f"scene--{anchor}")
    fresh = name == f"scene--{anchor}"
    return Markup(picture(seen, name) if fresh else again(name))  # they escape


def _played(facts: VariantFacts, over: Over) -> str:
    """The motions that the page plays; '' where none is known."""
    names = moving(facts)
    played = [quantity.name for quantity in facts.quantities if quantity.name in names]
    return playback({name: over(name) for name in played}, facts)


def _recorded(results: Sequence[RecordedResult], facts: VariantFacts) -> list[Recorded]:
    """The recorded result of each scheme at its finest setting, by the first quantity."""
    found = {}
    first = facts.quantities[0].name if facts.quantities else ""
    for one in sorted(results, key=lambda result: fineness(result.rung)):
        kept = one.quantities.get(first)
        error = kept.figures.get("max error") if kept else None
        date = one.utc.partition("T")[0]
        found[one.label] = Recorded(one.label, one.version, date, one.days, error)
    return list(found.values())

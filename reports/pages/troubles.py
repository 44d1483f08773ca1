"""Collects what needs attention: findings with value, bound, and the command to rerun them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from markupsafe import Markup

from reports import plain
from reports.book import Book
from reports.marks import Mark
from vv.gate.judgement import breaches
from vv.output.finding_lines import THAN
from vv.output.gallery.scene_drawing import picture
from vv.records.finding import Aspect, Finding, worst_first
from vv.records.job_record import Record

BOUND = "; it may move "  # precedes the allowed change and its reason
CARDS = 10  # on the front page
JUDGED = (Aspect.ACCURACY, Aspect.CONSERVATION, Aspect.RUN)


@dataclass(frozen=True)
class Trouble:
    """Findings of one kind on one scheme and case, represented by the worst of them.

    red: whether it turns the gate red. bound: the allowed change, with the reason. others: the
    places of the rest, as links and words. scene: the drawing of the worst.
    """

    red: bool
    kind: str
    mark: Mark | None
    where: str
    link: str
    text: str
    bound: str
    setting: str
    command: str
    pattern: str
    others: Sequence[tuple[str, str]]
    count: int
    scene: Markup


def troubles(book: Book, findings: Iterable[Finding] | None = None) -> list[Trouble]:
    """All findings with an exit bit, grouped; red ones first, then worst first.

    Errors precede changes, since they explain more.
    """
    known = book.by_setting
    patterns = {(d.case, d.label): d.text for d in book.patterns}
    piles: dict[tuple[str, str, str, str], list[Finding]] = {}
    for one in worst_first(book.findings if findings is None else findings):
        if one.bit and not one.improves:
            law = one.check is Aspect.CONSERVATION  # one leak of energy violates several laws
            key = one.case, one.label, one.check.value, "" if law else one.kind
            piles.setdefault(key, []).append(one)
    ordered = sorted(
        piles.values(), key=lambda pile: (not pile[0].red, pile[0].check not in JUDGED)
    )
    return [
        _trouble(
            book, pile, known.get(_place(pile[0])), patterns.get((pile[0].case, pile[0].label))
        )
        for pile in ordered
    ]


def _place(one: Finding) -> tuple[str, str, str, str]:
    return one.case, one.variant, one.label, one.rung


def _trouble(
    book: Book, pile: Sequence[Finding], record: Record | None, pattern: str | None
) -> Trouble:
    worst = pile[0]
    text, _, bound = _text(worst, record).partition(BOUND)
    others = dict.fromkeys((f.case, f.variant) for f in pile[1:] if f.variant != worst.variant)
    names = [worst.variant, *([worst.label] if worst.label else [])] if worst.variant else []
    return Trouble(
        red=worst.red,
        kind=f"{worst.check.value}: {worst.kind}",
        mark=book.marks.get(worst.label),
        where=f"{worst.case}:{worst.variant}" if worst.variant else worst.case or "all",
        link=book.to_case(worst.case, *names) if worst.case else "",
        text=text,
        bound=f"{BOUND.removeprefix('; ').capitalize()}{bound}." if bound else "",
        setting=plain.setting(record) if record else worst.rung,
        command=plain.command(record) if record else f"vv run {worst.case}".strip(),
        pattern=pattern or "",
        others=[(book.to_case(case, variant), variant) for case, variant in others],
        count=len(pile),
        scene=_scene(book, worst),
    )


def _scene(book: Book, one: Finding) -> Markup:
    """A small drawing of the scene of a finding."""
    facts = book.manifest.cases.get(one.case)
    variant = facts.variants.get(one.variant) if facts else None
    return Markup(picture(variant.sketch) if variant and variant.sketch else "")


def _text(one: Finding, record: Record | None) -> str:
    """A finding in plain words, taken from its record if it concerns a single one."""
    if record is None or one.check not in JUDGED:
        sentence = f"{THAN.get(one.kind, '')}{one.text}"
        return sentence[:1].upper() + sentence[1:]
    if one.check is Aspect.CONSERVATION:
        for found in breaches(record.ledger):
            if found[0] == one.kind:
                return plain.breach(found)
    quantity = record.quantity(one.quantity)
    return "; ".join(plain.with_notes([quantity])) if quantity else one.text

"""Arranges what an invocation says of stability: one table a kind, a line for what is the same."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from reports.marks import Mark
from reports.text import slug
from reports.views import Stable
from vv.insight.stability_summary import Kind, StabilityStatement, stability
from vv.records.manifest import Manifest

KINDS = {
    Kind.STEP: (
        "Largest stable step",
        "Sought in each code, over what theory gives. A step is stable if the run comes to its "
        "end within the bound that the case states; one that a code refuses is run all the same.",
    ),
    Kind.MAP: (
        "Maps over stiffness and step",
        "Lost: diverged, or off by as much as the answer. Steps are multiples of the critical one "
        "that the case states. The figures stand with the variants.",
    ),
    Kind.DRIFT: (
        "Drift",
        "The largest breach, at any rung, of what the motion conserves.",
    ),
    Kind.COUNT: (
        "Counts",
        "Events seen in the output. Where an event hangs on the last digit no order is due.",
    ),
}


def sections(manifest: Manifest, marks: Mapping[str, Mark]) -> list[Stable]:
    """A section for each kind there is anything of."""
    statements = stability(manifest)
    return [
        Stable(title, caption, _lines([one for one in statements if one.kind is kind], marks))
        for kind, (title, caption) in KINDS.items()
        if any(one.kind is kind for one in statements)
    ]


def _lines(
    statements: Sequence[StabilityStatement], marks: Mapping[str, Mark]
) -> list[tuple[str, str, list[tuple[list[Mark], str]]]]:
    """(anchor, case: variant, what is said and by which schemes), in the order found."""
    places: dict[tuple[str, str], dict[str, list[Mark]]] = {}
    for one in statements:
        texts = places.setdefault((one.case, one.variant), {})
        texts.setdefault(one.text, []).append(marks[one.label])
    return [
        (slug(case, variant), f"{case}: {variant}", [(who, text) for text, who in texts.items()])
        for (case, variant), texts in places.items()
    ]

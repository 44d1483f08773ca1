"""Arranges what an invocation says of stability: one table a kind, a line for what is the same."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from reports.marks import Mark
from reports.text import slug
from reports.views import Stable
from vv.insight.stability_summary import Kind, Told, stability

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


def sections(manifest: Mapping[str, Any], marks: Mapping[str, Mark]) -> list[Stable]:
    """A section for each kind there is anything of."""
    told = stability(manifest)
    return [
        Stable(title, caption, _lines([one for one in told if one.kind == kind], marks))
        for kind, (title, caption) in KINDS.items()
        if any(one.kind == kind for one in told)
    ]


def _lines(
    told: Sequence[Told], marks: Mapping[str, Mark]
) -> list[tuple[str, str, list[tuple[list[Mark], str]]]]:
    """(anchor, case: variant, what is said and by which schemes), in the order found."""
    places: dict[tuple[str, str], dict[str, list[Mark]]] = {}
    for one in told:
        said = places.setdefault((one.case, one.variant), {})
        said.setdefault(one.text, []).append(marks[one.label])
    return [
        (slug(case, variant), f"{case}: {variant}", [(who, text) for text, who in said.items()])
        for (case, variant), said in places.items()
    ]

"""The first page of the gallery: all cases by family, all codes with their schemes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from vv.case import Case
from vv.codes.adapter import Adapter
from vv.output.gallery.markup import cell, table


def index(cases: Sequence[Case], families: Mapping[str, str], adapters: Sequence[Adapter]) -> str:
    """The page, as Markdown. families: case -> its family."""
    return "\n".join([*_cases(cases, families), *_codes(adapters), ""])


def _cases(cases: Sequence[Case], families: Mapping[str, str]) -> Iterator[str]:
    variants = sum(len(case.variants) for case in cases)
    yield from ("# Gallery", "", "`vv docs` writes these pages from what cases and codes declare.")
    yield (
        "In the drawings, grey bodies are held, and where a body may move in some directions only, "
        "dashes show these. Blue arrows are initial velocities, red ones dead loads, green ones "
        "driven motion, g is gravity; arrows show directions and not sizes."
    )
    yield from ("", f"## {len(cases)} cases with {variants} variants")
    for family in sorted(set(families.values())):
        own = [case for case in cases if families[case.name] == family]
        yield from ("", f"### {family}", "")
        rows = [
            (
                f"[{case.name}](cases/{case.name}.md)",
                cell(case.title),
                str(len(case.variants)),
                cell(case.source.citation),
            )
            for case in own
        ]
        yield from table(("case", "what it is", "variants", "source"), rows)


def _codes(adapters: Sequence[Adapter]) -> Iterator[str]:
    yield from ("", f"## {len(adapters)} codes", "")
    rows = [
        (f"[{adapter.name}](codes/{adapter.name}.md)", f"`{scheme.name}`", cell(scheme.summary))
        for adapter in adapters
        for scheme in adapter.schemes
    ]
    yield from table(("code", "scheme", "what it is"), rows)

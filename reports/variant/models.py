"""How the schemes of a variant modelled its scene: what all of a code share stands once."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from reports.variant.ranking import Ranked

Told = tuple[tuple[str, ...], str]  # of whom it is told, and what


@dataclass(frozen=True)
class Modelled:
    """Schemes that modelled a scene in the same way, and how; or what all of a code share.

    like: the variant above on the page for which the same is told; empty if there is none.
    """

    note: str
    rows: Sequence[Ranked]
    code: str = ""
    like: str = ""

    @property
    def names(self) -> tuple[str, ...]:
        """Whom it is of."""
        return self.code, *(row.mark.label for row in self.rows)


def models(rows: Sequence[Ranked], variant: str, above: dict[Told, str]) -> list[Modelled]:
    """How the schemes modelled a scene, a row for each way.

    above: what stands above on the page -> the variant it is told of; the rest is added to it.
    """
    return [
        dataclasses.replace(one, like="" if like == variant else like)
        for one in _all_models(rows)
        for like in [above.setdefault((one.names, one.note), variant)]
    ]


def _all_models(rows: Sequence[Ranked]) -> list[Modelled]:
    piles: dict[str, list[tuple[list[str], Ranked]]] = {}
    for row in rows:
        if row.model:
            said = (row.model.note or "as the scene states it").split("; ")
            clauses = [*said, f"unknowns: {row.model.unknowns}"]
            piles.setdefault(row.mark.code, []).append((clauses, row))
    return [model for pile in piles.values() for model in _models(pile)]


def _models(pile: Sequence[tuple[list[str], Ranked]]) -> Iterator[Modelled]:
    """Those of one code: what all its schemes have in common stands once."""
    common = [c for c in pile[0][0] if all(c in clauses for clauses, _ in pile)]
    found: dict[str, list[Ranked]] = {}
    for clauses, row in pile:
        own = clauses if len(pile) == 1 else [c for c in clauses if c not in common]
        found.setdefault("; ".join(own), []).append(row)
    if len(found) == 1:
        yield Modelled("; ".join(pile[0][0]), [row for _, row in pile])
        return
    if common:
        yield Modelled("; ".join(common), [], pile[0][1].mark.code)
    yield from (Modelled(note or "nothing else", own) for note, own in found.items())

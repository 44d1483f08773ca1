"""How the schemes of a variant modelled its scene: what all of a code share stands once."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from reports.variant.ranking import Ranked


@dataclass(frozen=True)
class Modelled:
    """Schemes that modelled a scene in the same way, and how; or what all of a code share."""

    note: str
    rows: Sequence[Ranked]
    code: str = ""


def models(rows: Sequence[Ranked]) -> list[Modelled]:
    """How the schemes modelled a scene, a row for each way."""
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

"""The models that schemes made of a scene; what the schemes of a code share is shown once."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from reports.variant.ranking import Ranked

WORTH = 0.7  # fraction of the text; a longer difference saves too little
Told = dict[tuple[str, ...], tuple[str, str]]  # schemes -> the variant and the text


@dataclass(frozen=True)
class Modelled:
    """Schemes that modelled a scene in the same way, and how; or what all of a code share.

    like: the variant above on the page with the same model, but for the note; empty if
    there is none.
    """

    note: str
    rows: Sequence[Ranked]
    code: str = ""
    like: str = ""

    @property
    def who(self) -> str:
        """The schemes of this model, in words."""
        labels = ", ".join(row.mark.label for row in self.rows)
        return f"{self.code}, all schemes" if self.code else labels

    @property
    def energy(self) -> str:
        """The energy balances of these schemes."""
        many = len(self.rows) > 1
        balances = [(row.mark.label, row.balance) for row in self.rows if row.balance]
        return "; ".join(f"{label} {balance}" if many else balance for label, balance in balances)

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the schemes of this model."""
        return self.code, *(row.mark.label for row in self.rows)


def models(rows: Sequence[Ranked], variant: str, above: Told) -> list[Modelled]:
    """How the schemes modelled a scene, a row for each way.

    above: models shown above on the page; new ones are added.
    """
    return [_beside(one, variant, above) for one in _all_models(rows)]


def _beside(one: Modelled, variant: str, above: Told) -> Modelled:
    """A row, as its difference from the one above on the page where that is shorter."""
    like, known = above.setdefault(one.names, (variant, one.note))
    but = _difference(known, one.note)
    if like == variant or len(but) > WORTH * len(one.note):
        return one
    return dataclasses.replace(one, note=but, like=like)


def _difference(known: str, note: str) -> str:
    """The clauses of a note that the known one lacks, and those of it that do not hold."""
    before, now = known.split("; "), note.split("; ")
    new = [clause for clause in now if clause not in before]
    subjects = {clause.split()[0] for clause in new if clause}
    gone = [c for c in before if c not in now and c.split()[0] not in subjects]
    return "; ".join([*new, *(f"not: {clause}" for clause in gone)])


def _all_models(rows: Sequence[Ranked]) -> list[Modelled]:
    piles: dict[str, list[tuple[list[str], Ranked]]] = {}
    for row in rows:
        if row.model:
            notes = (row.model.note or "as the scene states it").split("; ")
            clauses = [*notes, f"unknowns: {row.model.unknowns}"]
            piles.setdefault(row.mark.code, []).append((clauses, row))
    return [model for pile in piles.values() for model in _models(pile)]


def _models(pile: Sequence[tuple[list[str], Ranked]]) -> Iterator[Modelled]:
    """The models of one code; the part that all its schemes share is shown once."""
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

"""Who agrees with whom: of three voices or more on a scene, which agree, and which stands alone.

A voice is a family of codes, since relatives share their sources. Voices are compared within a
class of method, whose members share errors: agreement shows what codes do, not what is true.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from vv.ask import Method, Status
from vv.records.job_record import Record
from vv.records.quantity import MeasuredQuantity

FAMILIES = {"lammps": "liggghts", "dart": "ode"}  # code -> the one whose sources it shares
ENOUGH = 3  # voices: of two that differ, neither is the odd one
ROUNDING = 1e-12  # of the scale: what is nearer than that is one


@dataclass(frozen=True)
class Voice:
    """What a family says of a quantity: its value at the finest rung, and how far that may be off.

    label: CODE/SCHEME of the member that speaks, the one with the least error. error: by how much
    the value changed from the next coarser step and stiffness, in the value's unit.
    """

    family: str
    label: str
    value: float
    error: float

    def agrees(self, other: Voice, rounding: float) -> bool:
        """Whether two values lie within their errors."""
        return abs(self.value - other.value) <= self.error + other.error + rounding


@dataclass(frozen=True)
class Vote:
    """What the voices of one class of method say of a quantity of a variant.

    agreeing: the largest group of which each two agree; odd: the others, if the group is more than
    half. alone: the group is more than half of them all, and the reference outside of its errors.
    """

    case: str
    variant: str
    quantity: str
    method: Method
    voices: tuple[Voice, ...]
    reference: float | None
    agreeing: tuple[Voice, ...]
    alone: bool

    @property
    def odd(self) -> tuple[Voice, ...]:
        """The voices that a majority contradicts."""
        if not _majority(self.agreeing, self.voices):
            return ()
        return tuple(voice for voice in self.voices if voice not in self.agreeing)

    def in_words(self) -> str:
        """One sentence on who agrees, who does not, and where the reference stands."""
        names = ", ".join(voice.label for voice in self.agreeing)
        where = f"{self.quantity} of {self.case}:{self.variant} ({self.method.value})"
        if not _majority(self.agreeing, self.voices):
            return f"{where}: no majority of {len(self.voices)} voices agrees"
        odd = "".join(f"; the odd one is {voice.label}, {voice.value:.9g}" for voice in self.odd)
        alone = f"; the reference, {self.reference:.9g}, stands alone" if self.alone else ""
        return f"{where}: {names} agree within their errors{odd}{alone}"


def votes(records: Iterable[Record]) -> list[Vote]:
    """The votes on every quantity on which three families or more of a class of method speak.

    records: of one invocation; those with modified parameters have no vote.
    """
    groups: dict[tuple[str, str, str, Method], dict[str, list[Record]]] = {}
    for record in records:
        if record.status is Status.RAN and not record.modified:
            for one in record.quantities:
                key = record.case, record.variant, one.name, record.method
                groups.setdefault(key, {}).setdefault(record.label, []).append(record)
    return [vote for key, schemes in groups.items() for vote in _vote(*key, schemes)]


def _vote(
    case: str, variant: str, quantity: str, method: Method, schemes: Mapping[str, list[Record]]
) -> Iterator[Vote]:
    """The vote on one quantity, if enough families speak."""
    every = [_voice(label, quantity, records) for label, records in schemes.items()]
    spoken = sorted((v for v in every if v), key=lambda voice: (-voice.error, voice.label))
    voices = {voice.family: voice for voice in spoken}  # the least error comes last, and stays
    if len(voices) < ENOUGH:
        return
    said = tuple(sorted(voices.values(), key=lambda voice: voice.label))
    measured = [one for records in schemes.values() for one in _measured(records, quantity)]
    scale = max((one.scale or 0.0 for one in measured), default=0.0)
    reference = next((r for one in measured if (r := _reference(one)) is not None), None)
    agreeing = _largest_group(said, ROUNDING * scale)
    exact = Voice("", "", math.nan if reference is None else reference, 0.0)
    alone = (
        reference is not None
        and _majority(agreeing, said)
        and not any(voice.agrees(exact, ROUNDING * scale) for voice in agreeing)
    )
    yield Vote(case, variant, quantity, method, said, reference, agreeing, alone)


def _voice(label: str, quantity: str, records: Sequence[Record]) -> Voice | None:
    """What a scheme says at its finest rung; None if no other rung tells how far that is off."""
    code = label.partition("/")[0]
    values = {
        (record.rung.kn or 0.0, record.rung.dt or 0.0): value
        for record in records
        for one in _measured([record], quantity)
        if (value := _value(one)) is not None
    }
    if not values:
        return None
    stiffest = max(kn for kn, _ in values)
    finest = min(dt for kn, dt in values if kn == stiffest)
    coarser = [dt for kn, dt in values if kn == stiffest and dt > finest]
    softer = [kn for kn, _ in values if kn < stiffest]
    near = [(stiffest, min(coarser))] if coarser else []
    if softer:
        near.append((max(softer), min(dt for kn, dt in values if kn == max(softer))))
    said = values[stiffest, finest]
    if not near and finest > 0:
        return None
    error = sum(abs(said - values[place]) for place in near)
    return Voice(FAMILIES.get(code, code), label, said, error)


def _measured(records: Iterable[Record], quantity: str) -> list[MeasuredQuantity]:
    return [one for record in records if (one := record.quantity(quantity)) is not None]


def _value(one: MeasuredQuantity) -> float | None:
    """The number that a quantity comes to: its value, or that of a series at the last time."""
    value = one.value if one.value is not None else one.figures.get("final")
    return value if value is not None and math.isfinite(value) else None


def _reference(one: MeasuredQuantity) -> float | None:
    return one.reference if one.reference is not None else one.end


def _largest_group(voices: Sequence[Voice], rounding: float) -> tuple[Voice, ...]:
    """The most voices of which each two agree; of groups of one size that of the least errors."""
    groups = [
        group
        for size in range(1, len(voices) + 1)
        for group in itertools.combinations(voices, size)
        if all(one.agrees(other, rounding) for one, other in itertools.combinations(group, 2))
    ]
    return max(groups, key=lambda group: (len(group), -sum(voice.error for voice in group)))


def _majority(group: Sequence[Voice], voices: Sequence[Voice]) -> bool:
    return 2 * len(group) > len(voices) and len(group) > 1

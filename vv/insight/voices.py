"""Who agrees with whom: of three voices or more on a scene, which agree, and which stands alone.

A voice is a family of codes, since relatives share their sources. Voices are compared within a
class of method, whose members share errors: agreement shows what codes do, not what is true.
A code that is not installed speaks by what was recorded of it, with the rounding of that.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from vv.ask import Knobs, Method, Status
from vv.gate.recorded import DIGITS
from vv.records.job_record import Record
from vv.records.quantity import MeasuredQuantity
from vv.records.recorded import RecordedResult

FAMILIES = {"lammps": "liggghts", "dart": "ode"}  # code -> the one whose sources it shares
ENOUGH = 3  # voices: of two that differ, neither is the odd one
ROUNDING = 1e-12  # of the scale: what is nearer than that is one
WRITTEN_DOWN = 0.5 * 10.0 ** (1 - DIGITS)  # of a value: what the digits that are recorded lose

Topic = tuple[str, str, str, Method]  # case, variant, quantity, class of method


@dataclass(frozen=True)
class _Said:
    """What a scheme came to at a rung. exact: the quantity as measured; None if recorded."""

    label: str
    rung: Knobs
    value: float
    exact: MeasuredQuantity | None


@dataclass(frozen=True)
class Voice:
    """What a family says of a quantity: its value at the finest rung, and how far that may be off.

    label: CODE/SCHEME of the member that speaks, the one with the least error. error: by how much
    the value changed from the next coarser step and stiffness, in the value's unit. recorded:
    whether it was written down where the code was installed.
    """

    family: str
    label: str
    value: float
    error: float
    recorded: bool = False

    @property
    def name(self) -> str:
        """The label, and whether it is recorded."""
        return f"{self.label} (recorded)" if self.recorded else self.label

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
        names = ", ".join(voice.name for voice in self.agreeing)
        where = f"{self.quantity} of {self.case}:{self.variant} ({self.method.value})"
        if not _majority(self.agreeing, self.voices):
            return f"{where}: no majority of {len(self.voices)} voices agrees"
        odd = "".join(f"; the odd one is {voice.name}, {voice.value:.9g}" for voice in self.odd)
        alone = f"; the reference, {self.reference:.9g}, stands alone" if self.alone else ""
        return f"{where}: {names} agree within their errors{odd}{alone}"


def votes(records: Collection[Record], recorded: Iterable[RecordedResult] = ()) -> list[Vote]:
    """The votes on every quantity on which three families or more of a class of method speak.

    records: of one invocation; those with modified parameters have no vote. recorded: what stands
    beside those of codes that are not installed.
    """
    groups: dict[Topic, dict[str, list[_Said]]] = {}
    for topic, one in (*_measured(records), *_written_down(records, recorded)):
        groups.setdefault(topic, {}).setdefault(one.label, []).append(one)
    return [vote for topic, schemes in groups.items() for vote in _vote(topic, schemes)]


def _measured(records: Iterable[Record]) -> Iterator[tuple[Topic, _Said]]:
    """What runs came to: the value of a number, or that of a series at the last time."""
    for record in records:
        if record.status is Status.RAN and not record.modified:
            for one in record.quantities:
                value = one.value if one.value is not None else one.figures.get("final")
                if value is not None and math.isfinite(value):
                    topic = record.case, record.variant, one.name, record.method
                    yield topic, _Said(record.label, record.rung, value, one)


def _written_down(
    records: Iterable[Record], recorded: Iterable[RecordedResult]
) -> Iterator[tuple[Topic, _Said]]:
    """What was recorded of schemes whose codes are not installed."""
    methods = {
        (record.case, record.variant, record.label): record.method
        for record in records
        if record.status is Status.NOT_INSTALLED and not record.modified
    }
    for one in recorded:
        method = methods.get((one.case, one.variant, one.label))
        for name, quantity in one.quantities.items() if method else ():
            value = quantity.figures.get("value", quantity.figures.get("final"))
            if method and value is not None:
                topic = one.case, one.variant, name, method
                yield topic, _Said(one.label, one.rung, value, None)


def _vote(topic: Topic, schemes: Mapping[str, list[_Said]]) -> Iterator[Vote]:
    """The vote on one quantity, if enough families speak."""
    every = [_voice(label, said) for label, said in schemes.items()]
    spoken = sorted((v for v in every if v), key=lambda voice: (-voice.error, voice.label))
    voices = {voice.family: voice for voice in spoken}  # the least error comes last, and stays
    if len(voices) < ENOUGH:
        return
    heard = tuple(sorted(voices.values(), key=lambda voice: voice.label))
    exact = [one.exact for said in schemes.values() for one in said if one.exact]
    rounding = ROUNDING * max((one.scale or 0.0 for one in exact), default=0.0)
    reference = next((r for one in exact if (r := _reference(one)) is not None), None)
    agreeing = _largest_group(heard, rounding)
    alone = (
        reference is not None
        and _majority(agreeing, heard)
        and not any(voice.agrees(Voice("", "", reference, 0.0), rounding) for voice in agreeing)
    )
    yield Vote(*topic, heard, reference, agreeing, alone)


def _voice(label: str, said: Sequence[_Said]) -> Voice | None:
    """What a scheme says at its finest rung; None if no other rung tells how far that is off."""
    code = label.partition("/")[0]
    values = {(one.rung.kn or 0.0, one.rung.dt or 0.0): one.value for one in said}
    stiffest = max(kn for kn, _ in values)
    finest = min(dt for kn, dt in values if kn == stiffest)
    coarser = [dt for kn, dt in values if kn == stiffest and dt > finest]
    softer = [kn for kn, _ in values if kn < stiffest]
    near = [(stiffest, min(coarser))] if coarser else []
    if softer:
        near.append((max(softer), min(dt for kn, dt in values if kn == max(softer))))
    value = values[stiffest, finest]
    if not near and finest > 0:
        return None
    recorded = any(one.exact is None for one in said)
    error = sum(abs(value - values[place]) for place in near)
    lost = WRITTEN_DOWN * abs(value) if recorded else 0.0
    return Voice(FAMILIES.get(code, code), label, value, error + lost, recorded)


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

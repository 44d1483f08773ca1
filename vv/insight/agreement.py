"""Which codes agree with each other within their errors, and which one does not.

Codes that share sources are one family and give one answer. Answers are compared within a class of
method, whose members share errors, so agreement does not prove that they are right. A code that is
not installed is represented by its recorded results, with their rounding.
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

FAMILIES = {"lammps": "liggghts", "dart": "ode"}  # code -> the code whose sources it shares
ENOUGH = 3  # the fewest answers: of two that differ, either may be wrong
ROUNDING = 1e-12  # relative to the scale: smaller differences are rounding
WRITTEN_DOWN = 0.5 * 10.0 ** (1 - DIGITS)  # relative to a value: rounding of the recorded digits

Topic = tuple[str, str, str, Method]  # case, variant, quantity, class of method


@dataclass(frozen=True)
class _Result:
    """The value of a scheme at a rung. exact: the quantity as measured; None if recorded."""

    label: str
    rung: Knobs
    value: float
    exact: MeasuredQuantity | None


@dataclass(frozen=True)
class FamilyAnswer:
    """The value of a quantity by a family of codes, at the finest rung, and its estimated error.

    label: CODE/SCHEME of the member with the least error. error: by how much the value changed
    from the next coarser step and stiffness, in the value's unit. recorded: whether it is a stored
    result of a code that is not installed here.
    """

    family: str
    label: str
    value: float
    error: float
    recorded: bool = False

    @property
    def name(self) -> str:
        """The label; recorded answers are marked."""
        return f"{self.label} (recorded)" if self.recorded else self.label

    def agrees(self, other: FamilyAnswer, rounding: float) -> bool:
        """Whether two values lie within their errors."""
        return abs(self.value - other.value) <= self.error + other.error + rounding


@dataclass(frozen=True)
class Agreement:
    """A comparison of the answers of one class of method to a quantity of a variant.

    agreeing: the largest group in which every two agree; odd: the others, if the group is a
    majority. alone: the group is a majority, and the reference lies outside its errors.
    """

    case: str
    variant: str
    quantity: str
    method: Method
    answers: tuple[FamilyAnswer, ...]
    reference: float | None
    agreeing: tuple[FamilyAnswer, ...]
    alone: bool

    @property
    def odd(self) -> tuple[FamilyAnswer, ...]:
        """The answers that disagree with a majority."""
        if not _majority(self.agreeing, self.answers):
            return ()
        return tuple(answer for answer in self.answers if answer not in self.agreeing)

    def in_words(self) -> str:
        """One sentence on which codes agree, which do not, and whether the reference does."""
        names = ", ".join(answer.name for answer in self.agreeing)
        where = f"{self.quantity} of {self.case}:{self.variant} ({self.method.value})"
        if not _majority(self.agreeing, self.answers):
            return f"{where}: no majority of {len(self.answers)} answers agrees"
        odd = "".join(f"; {answer.name} differs, {answer.value:.9g}" for answer in self.odd)
        alone = f"; the reference, {self.reference:.9g}, disagrees with them" if self.alone else ""
        return f"{where}: {names} agree within their errors{odd}{alone}"


def agreements(
    records: Collection[Record], recorded: Iterable[RecordedResult] = ()
) -> list[Agreement]:
    """The comparison of every quantity that three families or more of a class of method computed.

    records: of one invocation; those with modified parameters are left out. recorded: results of
    codes that are not installed.
    """
    groups: dict[Topic, dict[str, list[_Result]]] = {}
    for topic, one in (*_measured(records), *_written_down(records, recorded)):
        groups.setdefault(topic, {}).setdefault(one.label, []).append(one)
    return [
        agreement for topic, schemes in groups.items() for agreement in _agreement(topic, schemes)
    ]


def _measured(records: Iterable[Record]) -> Iterator[tuple[Topic, _Result]]:
    """The values of runs, for series at the last time."""
    for record in records:
        if record.status is Status.RAN and not record.modified:
            for one in record.quantities:
                value = one.value if one.value is not None else one.figures.get("final")
                if value is not None and math.isfinite(value):
                    topic = record.case, record.variant, one.name, record.method
                    yield topic, _Result(record.label, record.rung, value, one)


def _written_down(
    records: Iterable[Record], recorded: Iterable[RecordedResult]
) -> Iterator[tuple[Topic, _Result]]:
    """The recorded values of schemes whose codes are not installed."""
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
                yield topic, _Result(one.label, one.rung, value, None)


def _agreement(topic: Topic, schemes: Mapping[str, list[_Result]]) -> Iterator[Agreement]:
    """The comparison of one quantity; None unless enough families computed it."""
    every = [_answer(label, results) for label, results in schemes.items()]
    given = sorted((v for v in every if v), key=lambda answer: (-answer.error, answer.label))
    answers = {answer.family: answer for answer in given}  # the last, with the least error, is kept
    if len(answers) < ENOUGH:
        return
    compared = tuple(sorted(answers.values(), key=lambda answer: answer.label))
    exact = [one.exact for results in schemes.values() for one in results if one.exact]
    rounding = ROUNDING * max((one.scale or 0.0 for one in exact), default=0.0)
    reference = next((r for one in exact if (r := _reference(one)) is not None), None)
    agreeing = _largest_group(compared, rounding)
    alone = (
        reference is not None
        and _majority(agreeing, compared)
        and not any(
            answer.agrees(FamilyAnswer("", "", reference, 0.0), rounding) for answer in agreeing
        )
    )
    yield Agreement(*topic, compared, reference, agreeing, alone)


def _answer(label: str, results: Sequence[_Result]) -> FamilyAnswer | None:
    """The answer of a scheme at its finest rung; None if no other rung gives an error estimate."""
    code = label.partition("/")[0]
    values = {(one.rung.kn or 0.0, one.rung.dt or 0.0): one.value for one in results}
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
    recorded = any(one.exact is None for one in results)
    error = sum(abs(value - values[place]) for place in near)
    lost = WRITTEN_DOWN * abs(value) if recorded else 0.0
    return FamilyAnswer(FAMILIES.get(code, code), label, value, error + lost, recorded)


def _reference(one: MeasuredQuantity) -> float | None:
    return one.reference if one.reference is not None else one.end


def _largest_group(answers: Sequence[FamilyAnswer], rounding: float) -> tuple[FamilyAnswer, ...]:
    """The largest group in which every two agree; among equal ones that with the least errors."""
    groups = [
        group
        for size in range(1, len(answers) + 1)
        for group in itertools.combinations(answers, size)
        if all(one.agrees(other, rounding) for one, other in itertools.combinations(group, 2))
    ]
    return max(groups, key=lambda group: (len(group), -sum(answer.error for answer in group)))


def _majority(group: Sequence[FamilyAnswer], answers: Sequence[FamilyAnswer]) -> bool:
    return 2 * len(group) > len(answers) and len(group) > 1

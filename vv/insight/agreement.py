"""Which codes agree with each other within their errors, and which one does not.

This is judged by their values alone; the reference is compared with what they agree on afterwards.
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
from vv.records.outcomes import Verdict
from vv.records.quantity import MeasuredQuantity
from vv.records.recorded import RecordedResult

FAMILIES = {"lammps": "liggghts", "dart": "ode"}  # code -> the code whose sources it shares
ENOUGH = 3  # the fewest answers: of two that differ, either may be wrong
ROUNDING = 1e-12  # relative to the scale: smaller differences are rounding
CONVERGES = 3.0  # changes by refinement that an error may amount to, see `_against`
WRITTEN_DOWN = 0.5 * 10.0 ** (1 - DIGITS)  # relative to a value: rounding of the recorded digits

Topic = tuple[str, str, str, Method]  # case, variant, quantity, class of method


@dataclass(frozen=True)
class _Result:
    """The values of a scheme at a rung. exact: the quantity as measured; None if recorded.

    values: of a series the last one and the mean over time, since a wrong course may end right.
    """

    label: str
    rung: Knobs
    values: tuple[float, ...]
    exact: MeasuredQuantity | None


@dataclass(frozen=True)
class FamilyAnswer:
    """The value of a quantity by a family of codes, at the finest rung, and its estimated error.

    label: CODE/SCHEME of the member with the least error. values: those of `_Result`; errors: by
    how much each changed from the next coarser step and stiffness, in its unit. recorded: whether
    it is a stored result of a code that is not installed here. against: whether it is judged wrong
    by the reference, by far more than refinement changes its error.
    """

    family: str
    label: str
    values: tuple[float, ...]
    errors: tuple[float, ...]
    recorded: bool = False
    against: bool = False

    @property
    def value(self) -> float:
        """The value, of a series the last one."""
        return self.values[0]

    @property
    def error(self) -> float:
        """The estimated error of the value."""
        return self.errors[0]

    @property
    def name(self) -> str:
        """The label; recorded answers are marked."""
        return f"{self.label} (recorded)" if self.recorded else self.label

    def agrees(self, other: FamilyAnswer, rounding: float) -> bool:
        """Whether all values of two answers lie within their errors."""
        shared = range(min(len(self.values), len(other.values)))  # some records lack a mean
        return all(
            abs(self.values[i] - other.values[i]) <= self.errors[i] + other.errors[i] + rounding
            for i in shared
        )


@dataclass(frozen=True)
class Agreement:
    """A comparison of the answers of one class of method to a quantity of a variant.

    agreeing: the largest group in which every two agree; odd: the others, if the group is a
    majority. alone: the group is a majority, and all of it that ran is against the reference.
    """

    case: str
    variant: str
    quantity: str
    method: Method
    answers: tuple[FamilyAnswer, ...]
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
        if not self.alone:
            return f"{where}: {names} agree within their errors{odd}"
        whole = f"all codes ({names})" if not self.odd else names
        return (
            f"{where}: {whole} agree with each other and not with the reference{odd}: suspect the "
            "reference"
        )


def agreements(
    records: Collection[Record], recorded: Iterable[RecordedResult] = ()
) -> list[Agreement]:
    """The comparison of every quantity that three families or more of a class of method computed.

    records: at the same parameters. recorded: results of codes that are not installed, at the
    case's own parameters.
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
        if record.status is Status.RAN:
            for one in record.quantities:
                if values := _values(one.figures, one.value):
                    topic = record.case, record.variant, one.name, record.method
                    yield topic, _Result(record.label, record.rung, values, one)


def _values(figures: Mapping[str, float | None], value: float | None = None) -> tuple[float, ...]:
    """The values by which answers are compared; empty if there is none."""
    number = figures.get("value") if value is None else value
    given = (figures.get("final"), figures.get("mean")) if number is None else (number,)
    known = tuple(one for one in given if one is not None)
    return known if given[0] is not None and all(map(math.isfinite, known)) else ()


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
            if method and (values := _values(quantity.figures)):
                topic = one.case, one.variant, name, method
                yield topic, _Result(one.label, one.rung, values, None)


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
    agreeing = _largest_group(compared, rounding)
    live = [answer for answer in agreeing if not answer.recorded]
    alone = bool(live) and _majority(agreeing, compared) and all(one.against for one in live)
    yield Agreement(*topic, compared, agreeing, alone)


def _answer(label: str, results: Sequence[_Result]) -> FamilyAnswer | None:
    """The answer of a scheme at its finest rung; None if no other rung gives an error estimate."""
    code = label.partition("/")[0]
    values = {(one.rung.kn or 0.0, one.rung.dt or 0.0): one for one in results}
    stiffest = max(kn for kn, _ in values)
    finest = min(dt for kn, dt in values if kn == stiffest)
    coarser = [dt for kn, dt in values if kn == stiffest and dt > finest]
    softer = [kn for kn, _ in values if kn < stiffest]
    near = [(stiffest, min(coarser))] if coarser else []
    if softer:
        near.append((max(softer), min(dt for kn, dt in values if kn == max(softer))))
    best, coarse = values[stiffest, finest], [values[place] for place in near]
    if not near and finest > 0:
        return None
    recorded = any(one.exact is None for one in results)
    errors = tuple(
        sum(abs(value - one.values[i]) for one in coarse if i < len(one.values))
        + (WRITTEN_DOWN * abs(value) if recorded else 0.0)
        for i, value in enumerate(best.values)
    )
    family, against = FAMILIES.get(code, code), _against(best.exact, [one.exact for one in coarse])
    return FamilyAnswer(family, label, best.values, errors, recorded, against)


def _against(best: MeasuredQuantity | None, coarse: Sequence[MeasuredQuantity | None]) -> bool:
    """Whether a quantity is judged wrong, and its error would stay with any refinement.

    A method of order p has an error of at most 1/(2^p - 1) times its change between a step and
    half of it; CONVERGES bounds this for p > 0.4.
    """
    if best is None or best.verdict is not Verdict.FAIL or best.error is None:
        return False
    change = sum(abs(best.error - one.error) for one in coarse if one and one.error is not None)
    return best.error > CONVERGES * change


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

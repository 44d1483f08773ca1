"""Compares published statements with exact answers and with the results of codes."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass

from vv.case.published import Assessment, Computed, Figure, Paper, Statement
from vv.records.accepted import AcceptedResult

Results = Mapping[str, AcceptedResult]  # keys are 'VARIANT CODE/SCHEME RUNG', as in baselines
SHOWN = 5  # significant digits of the answers of codes
POWER = re.compile(r"(?<=\d)e(-?\d+)")  # powers of ten, as numbers of papers are entered
FEWEST = 1e-12  # a smaller figure is rounding


@dataclass(frozen=True)
class Answer:
    """An answer of codes as text, with their labels CODE/SCHEME. where: CASE:VARIANT."""

    where: str
    text: str
    codes: tuple[str, ...]


@dataclass(frozen=True)
class Row:
    """A published statement with its assessment; numbers as text, in the statement's unit."""

    place: str
    what: str
    printed: str
    unit: str
    exact: str
    answers: tuple[Answer, ...]
    assessment: Assessment
    why: str


def rows(paper: Paper, results: Callable[[str], Results]) -> tuple[Row, ...]:
    """A row for each statement of a paper; results: case -> its stored results."""
    return tuple(_row(one, results) for one in paper.statements)


def counted(rows: Iterable[Row]) -> dict[Assessment, int]:
    """The number of statements of each assessment, in the order of Assessment."""
    found = [row.assessment for row in rows]
    return {assessment: found.count(assessment) for assessment in Assessment if assessment in found}


def _row(one: Statement, results: Callable[[str], Results]) -> Row:
    answers = tuple(
        a for computed in one.computed for a in _answers(one, computed, results(computed.case))
    )
    exact = one.exact if isinstance(one.exact, str) else _beside(one.exact(), one)
    return Row(
        one.place, one.what, one.printed, one.unit, exact, answers, one.assessment, one.why
    )  # fmt: skip


def _beside(value: float, one: Statement) -> str:
    """The exact number, with two digits more than are printed, but at least five."""
    given = one.printed.split()[0].partition("e")[0] if one.printed else ""
    digits = sum(c.isdigit() for c in given.lstrip("-<>~0."))
    return _written(value, max(SHOWN, digits + 2), one)


def _written(value: float, digits: int, one: Statement) -> str:
    """A number with the power of ten that the paper prints, if any; otherwise in short form."""
    power = POWER.search(one.printed)
    scaled = value / 10.0 ** int(power[1]) if power else 0.0
    if power and 0.01 <= abs(scaled) < 1000.0:
        return f"{scaled:.{digits}g}{power[0]}"
    mantissa, _, exponent = f"{value:.{digits}g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if exponent else mantissa


def _answers(one: Statement, computed: Computed, results: Results) -> Iterator[Answer]:
    """The answers of codes; codes with the same answer together."""
    where = f"{computed.case}:{computed.variant}"
    piles: dict[str, list[str]] = {}
    for label, result in _chosen(computed, results).items():
        if (figure := _figure(computed, result)) is not None:
            shown = 0.0 if abs(figure) < FEWEST else figure * computed.times
            piles.setdefault(_written(shown, SHOWN, one), []).append(label)
    for text, labels in piles.items():
        yield Answer(where, text, tuple(labels))


def _chosen(computed: Computed, results: Results) -> dict[str, AcceptedResult]:
    """CODE/SCHEME -> its result at the requested rung, or at its finest."""
    found: dict[str, tuple[tuple[float, float], AcceptedResult]] = {}
    for name, result in results.items():
        variant, label, knobs = _named(name)
        if variant != computed.variant or not _is_at(computed, knobs):
            continue
        fine = (float(knobs.get("kn", 0.0)), -float(knobs.get("dt", 0.0)))
        if label not in found or fine > found[label][0]:
            found[label] = (fine, result)
    return {label: found[label][1] for label in sorted(found)}


@functools.cache
def _named(name: str) -> tuple[str, str, Mapping[str, str]]:
    """The variant, CODE/SCHEME and knobs of a result, from its name; cached."""
    variant, label, *rest = name.split(" ")
    knobs = dict(pair.split("=") for pair in rest[0].split(",")) if rest else {}
    return variant, label, knobs


def _is_at(computed: Computed, knobs: Mapping[str, str]) -> bool:
    """Whether a result is at the requested rung, as far as its scheme has the knobs."""
    due = {} if computed.rung is None else {"dt": computed.rung.dt, "kn": computed.rung.kn}
    return all(
        value is None or name not in knobs or abs(float(knobs[name]) / value - 1.0) < 1e-9
        for name, value in due.items()
    )


def _figure(computed: Computed, result: AcceptedResult) -> float | None:
    quantity = result.quantities.get(computed.quantity)
    if quantity is None:
        return None
    return (
        quantity.error
        if computed.figure is Figure.ERROR
        else quantity.figures.get(computed.figure.value)
    )

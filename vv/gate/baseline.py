"""Reads and writes accepted results.

One file per case, `CASE.json`: sorted, one result a line, so that a change reads well in review.
A result is named by variant, code/scheme and knobs; of each quantity it holds a few figures of
the value, their scale, and the error.
"""

from __future__ import annotations

from pathlib import Path

from vv.base.errors import UsageError
from vv.records import codec
from vv.records.accepted import AcceptedQuantity, AcceptedResult, Baseline
from vv.records.job_record import Record
from vv.records.reading import rung

DIGITS = 12  # significant digits kept of a figure: a thousandth of the narrowest band


def read(folder: Path, case: str) -> Baseline | None:
    """The baseline of a case; None if it has none. Raises UsageError for a file that is broken."""
    path = folder / f"{case}.json"
    if not path.is_file():
        return None
    try:
        found = codec.read(Baseline, codec.parse(path.read_text(encoding="utf-8")), "baseline")
    except ValueError as error:
        raise UsageError(f"{path}: {error}; `vv accept {case}` writes a new one") from error
    if found.case != case:
        raise UsageError(f"{path}: not a baseline of {case}; `vv accept {case}` writes one")
    return found


def name_of(record: Record) -> str:
    """The name of a record's result in a baseline."""
    return named(record.variant, record.label, rung(record))


def named(variant: str, label: str, setting: str) -> str:
    """The name of a result in a baseline. label: CODE/SCHEME; setting: the knobs as text, or ''."""
    return f"{variant} {label} {setting}".rstrip()


def result_of(record: Record, by: str) -> AcceptedResult:
    """The accepted data of a record: figures, scale and error of each quantity."""
    kept = {
        one.name: AcceptedQuantity(
            _rounded(one.error),
            _rounded(one.scale),
            {name: _rounded(value) for name, value in one.figures.items()},
        )
        for one in record.quantities
    }
    relative = record.cost.relative
    cost = relative and (float(f"{relative[0]:.3g}"), float(f"{relative[1]:.3g}"))
    return AcceptedResult(by, cost, kept)


def _rounded(value: float | None) -> float | None:
    return None if value is None else float(f"{value:.{DIGITS}g}")

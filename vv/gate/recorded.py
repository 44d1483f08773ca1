"""Recorded results of external codes: kept in the project, shown where the code is absent.

One file per code and case, `CODE/CASE.json`. A recorded result is never a live one: it has no
verdict, sets no exit bit and satisfies no requirement.
"""

from __future__ import annotations

import dataclasses
import datetime
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np

from vv.ask import Status
from vv.base.errors import UsageError
from vv.base.files import write_whole
from vv.gate.baseline import name_of
from vv.records import codec
from vv.records.job_record import Record
from vv.records.quantity import MeasuredQuantity
from vv.records.reading import by_fineness, ran, rung
from vv.records.recorded import RecordedFile, RecordedQuantity, RecordedResult, RecordedRun
from vv.records.sorted_text import render
from vv.scene import Vector

POINTS = 41  # kept of a series
DIGITS = 6
Series = Callable[[str], Mapping[str, Vector]]  # record key -> arrays


def write_recorded(
    folder: Path,
    records: Iterable[Record],
    series: Series,
    circumstances: Mapping[str, RecordedFile],
) -> list[Path]:
    """Write what ran, unmodified, one file per code and case; returns the files.

    circumstances: code -> a file without results that says where they come from.
    """
    piles: dict[tuple[str, str], list[Record]] = {}
    for record in records:
        if ran(record) and not record.modified:
            piles.setdefault((record.code, record.case), []).append(record)
    written = []
    for (code, case), pile in piles.items():
        path = folder / code / f"{case}.json"
        finest = {(r.variant, r.label): name_of(r) for r in sorted(pile, key=by_fineness)}
        whole = dataclasses.replace(
            circumstances[code],
            case=case,
            parameters={r.variant: r.parameters for r in pile},
            results={
                name_of(r): _compact(r, series(r.key) if name_of(r) in finest.values() else {})
                for r in pile
            },
        )
        write_whole(path, render(whole).encode())
        written.append(path)
    return written


def _compact(record: Record, arrays: Mapping[str, Vector]) -> RecordedRun:
    quantities = {one.name: _compact_quantity(one, arrays) for one in record.quantities}
    return RecordedRun(_few(record.cost.solve_cpu), quantities)


def _compact_quantity(one: MeasuredQuantity, arrays: Mapping[str, Vector]) -> RecordedQuantity:
    errors = {f"{codec.word(norm)} error": error for norm, error in one.errors.items()}
    figures = {name: _few(value) for name, value in {**one.figures, **errors}.items()}
    y = arrays.get(f"{one.name}.value")
    if y is None:
        return RecordedQuantity(figures)
    chosen = np.unique(np.linspace(0, len(y) - 1, POINTS).round().astype(int))
    return RecordedQuantity(
        figures, tuple(map(_few, arrays["t"][chosen])), tuple(map(_few, y[chosen]))
    )


def _few(value: float | None) -> float | None:
    return None if value is None else float(f"{value:.{DIGITS}g}")


def shown(
    folder: Path, records: Sequence[Record], today: datetime.date
) -> tuple[RecordedResult, ...]:
    """The recorded results that are shown for codes that are not installed.

    Only a result of the same variant, scheme, knobs and parameters is one.
    """
    absent = [record for record in records if record.status is Status.NOT_INSTALLED]
    keys = dict.fromkeys((record.code, record.case) for record in absent)
    files = {key: _read(folder / key[0] / f"{key[1]}.json") for key in keys}
    found = []
    for record in absent:
        kept = files[record.code, record.case]
        result = kept and kept.results.get(name_of(record))
        if kept and result and kept.parameters.get(record.variant) == record.parameters:
            found.append(_shown(record, kept, result, today))
    return tuple(found)


def seconds_recorded(folder: Path, code: str, case: str) -> dict[tuple[str, str, str, str], float]:
    """(case, variant, CODE/SCHEME, rung) -> seconds of the stepping loop, as recorded."""
    kept = _read(folder / code / f"{case}.json")
    named = {tuple(name.split(" ")): one.cpu for name, one in kept.results.items()} if kept else {}
    return {
        (case, parts[0], parts[1], parts[2] if len(parts) > 2 else ""): cpu
        for parts, cpu in named.items()
        if cpu
    }


def _shown(
    record: Record, kept: RecordedFile, result: RecordedRun, today: datetime.date
) -> RecordedResult:
    return RecordedResult(
        case=record.case,
        variant=record.variant,
        code=record.code,
        scheme=record.scheme,
        rung=record.rung,
        knobs=rung(record),
        version=kept.version,
        utc=kept.utc,
        days=(today - datetime.datetime.fromisoformat(kept.utc).date()).days,
        cpu=result.cpu,
        quantities=result.quantities,
    )


def _read(path: Path) -> RecordedFile | None:
    if not path.is_file():
        return None
    try:
        return codec.read(RecordedFile, codec.parse(path.read_text(encoding="utf-8")), "recorded")
    except ValueError as error:
        raise UsageError(f"{path}: {error}") from error

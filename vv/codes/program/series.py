"""Reads series.csv: a header that decides which column is which, and a row for each output time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from vv.ask import Ask
from vv.base.files import read_whole
from vv.codes.program.bad_answer import BadAnswerError, short
from vv.codes.program.question import all_columns
from vv.scene import Vector

SERIES = "series.csv"
NEAR = 1e-3  # of the interval between outputs: how exactly a time must be printed


def read_series(file: Path, ask: Ask) -> Mapping[str, Vector]:
    """Column -> its values (k,) at the output times asked for; raises BadAnswerError.

    Columns are identified by the header; columns that were not asked for are ignored.
    """
    if not file.is_file():
        raise BadAnswerError(f"the program ended well, but wrote no {SERIES}")
    try:
        text = read_whole(file).decode("utf-8-sig", errors="replace")
    except OSError as error:
        raise BadAnswerError(f"{SERIES}: {error.strerror}") from error
    header, *rest = text.splitlines() or [""]
    names = [name.strip().strip('"') for name in header.split(",")]
    for wanted in ("t", *all_columns(ask)):
        if names.count(wanted) != 1:
            many = f"{names.count(wanted)} columns" if wanted in names else "no column"
            raise BadAnswerError(f"{SERIES} has {many} {wanted!r}; its header is {short(header)}")
    lines = [(n, line) for n, line in enumerate(rest, 2) if line.strip()]
    rows = _numbers(lines, names)
    series = {name: rows[:, number] for number, name in enumerate(names)}
    _check_times(series["t"], [number for number, _ in lines], ask)
    return series


def _numbers(lines: list[tuple[int, str]], names: list[str]) -> Vector:
    """The numbers in numbered lines, a row each."""
    try:
        table = np.array([line.split(",") for _, line in lines], dtype=float)
        if table.shape == (len(lines), len(names)):
            return table
    except ValueError:
        pass
    for number, line in lines:
        _check_row(number, line.split(","), names)
    raise BadAnswerError(f"{SERIES} has a header and nothing else")


def _check_row(number: int, cells: list[str], names: list[str]) -> None:
    """Raise BadAnswerError if a line is not a number for each name."""
    if len(cells) != len(names):
        counts = f"{len(cells)} numbers where the header has {len(names)} names"
        raise BadAnswerError(f"{SERIES}, line {number}: {counts}: {short(','.join(cells))}")
    for name, cell in zip(names, cells, strict=True):
        try:
            float(cell)
        except ValueError:
            what = f"{short(cell.strip())} is not a number"
            raise BadAnswerError(f"{SERIES}, line {number}, column {name}: {what}") from None


def _check_times(times: Vector, lines: Sequence[int], ask: Ask) -> None:
    """Raise BadAnswerError unless the rows are those of the output times, as exact as printed.

    lines: the numbers of the lines of the rows.
    """
    asked = ask.goal.times(ask.knobs.dt)
    if len(times) != len(asked):
        raise BadAnswerError(
            f"{SERIES} has {len(times)} rows; `times` in ask.json has {len(asked)}, from t = 0 to "
            f"{asked[-1]:g} s"
        )
    off = ~(np.abs(times - asked) <= NEAR * ask.goal.interval)
    if off.any():
        row = int(off.argmax())
        raise BadAnswerError(
            f"{SERIES}, line {lines[row]}: t = {float(times[row])!r} s; `times` in ask.json has "
            f"{float(asked[row])!r} s there"
        )

"""How series.csv is read: columns by their names, a row for each output time, and nothing else."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from vv.ask import Ask, Displacement, History, Knobs
from vv.codes.program.bad_answer import BadAnswerError
from vv.codes.program.question import all_columns
from vv.codes.program.series import read_series
from vv.plan.project import find

STUDY = find().load_case("bounce").declare("floor", find().load_case("bounce").defaults("floor"))
ASK = Ask(STUDY.study.scene, History(0.2, 0.1), (Displacement(1),), Knobs(dt=0.05))
NAMES = ("t", *all_columns(ASK))


def series(folder: Path, *lines: str, before: str = "") -> dict[str, list[float]]:
    """What is read of these lines."""
    file = folder / "series.csv"
    file.write_text(before + "\n".join(lines), encoding="utf-8")
    return {name: values.tolist() for name, values in read_series(file, ASK).items()}


def rows(*times: str) -> list[str]:
    """A row for each time, whose other numbers are those of their columns."""
    return [",".join([t, *(str(n) for n in range(1, len(NAMES)))]) for t in times]


GOOD = rows("0", "0.1", "0.2")


def refused(folder: Path, *lines: str) -> str:
    with pytest.raises(BadAnswerError) as told:
        series(folder, *lines)
    return str(told.value)


def test_columns_are_known_by_their_names_whatever_their_order_and_their_quotes(
    tmp_path: Path,
) -> None:
    header = ",".join(f' "{name}" ' for name in (*NAMES, "of no interest"))
    found = series(tmp_path, header, *(f"{row},7" for row in GOOD), before="\ufeff")
    assert found["t"] == [0.0, 0.1, 0.2]
    assert [found[name] for name in NAMES[1:]] == [[n] * 3 for n in range(1, len(NAMES))]
    turned = [",".join(reversed(row.split(","))) for row in GOOD]
    assert series(tmp_path, ",".join(reversed(NAMES)), *turned)[NAMES[1]] == [1.0] * 3


def test_a_column_must_be_there_once(tmp_path: Path) -> None:
    twice = refused(tmp_path, ",".join((*NAMES, "t")), *(f"{row},0" for row in GOOD))
    assert "has 2 columns 't'" in twice
    assert f"has no column {NAMES[-1]!r}" in refused(tmp_path, ",".join(NAMES[:-1]), *GOOD)


@pytest.mark.parametrize(
    ("time", "is_read"), [("0.10009", True), ("0.10011", False), ("nan", False)]
)
def test_times_are_those_asked_for_to_a_thousandth_of_the_interval(
    tmp_path: Path, time: str, is_read: bool
) -> None:
    lines = (",".join(NAMES), "", *rows("0", time, "0.2"))
    if is_read:
        assert series(tmp_path, *lines)["t"][1] == float(time)
    else:
        told = refused(tmp_path, *lines)
        assert told.startswith(f"series.csv, line 4: t = {float(time)!r} s; ")
        assert told.endswith("`times` in ask.json has 0.1 s there")


def test_what_is_no_number_and_rows_that_lack_some_are_told_with_their_line(tmp_path: Path) -> None:
    header = ",".join(NAMES)
    assert "line 3, column t: x is not a number" in refused(
        tmp_path, header, *rows("0", "x", "0.2")
    )
    short = refused(tmp_path, header, GOOD[0], "", "0.1", GOOD[2])
    assert f"line 4: 1 numbers where the header has {len(NAMES)} names" in short
    assert "has 2 rows; `times` in ask.json has 3" in refused(tmp_path, header, *GOOD[:2])
    assert refused(tmp_path, header) == "series.csv has a header and nothing else"
    assert np.isfinite(series(tmp_path, header, *GOOD)["t"]).all()

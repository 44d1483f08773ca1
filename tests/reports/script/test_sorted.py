"""Claims about tables that are sorted by a click: numbers of any unit and form, and blanks last."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from reports import html
from reports.text import NONE
from tests.reports.script.made_up import in_browser, seen
from tests.support.fabricated import STEPS, cost, entry, manifest, record
from vv.records.job_record import Record
from vv.store.store import Store

pytestmark = in_browser
# errors at STEPS, of orders 2, log2(5000) = 12.3, 1 and none, and the cost [s] of the last
RUNS: dict[str, tuple[tuple[float, ...], float, bool]] = {
    "aa/one": ((4e-2, 1e-2, 2.5e-3), 5.0, True),
    "bb/one": ((1.0, 2e-4, 4e-8), 120.0, True),
    "cc/one": ((8e-3, 4e-3, 2e-3), 7e-4, True),
    "dd/one": ((0.5,), 3e-3, False),
}
CLICK = """
  const table = one("table.ranking");
  const names = [...table.tHead.rows[0].cells].map((cell) => cell.textContent.trim());
  for (const name of ["Observed order", "CPU", "Error", "Code/scheme"]) {
    const column = names.indexOf(name), head = table.tHead.rows[0].cells[column];
    said[name] = [1, 2].map(() => {
      head.click();
      return [...table.tBodies[0].rows].map((row) => row.cells[column].textContent.trim());
    });
  }
"""


def runs() -> list[Record]:
    return [
        record(
            label, "T1", dt, quantities=[entry("pass", {"max": error}, tolerance=1.0)],
            cost=cost(timed=timed, cpu=cpu),
        )
        for label, (errors, cpu, timed) in RUNS.items()
        for dt, error in zip(STEPS, errors, strict=False)
    ]  # fmt: skip


@pytest.fixture(scope="module")
def sorted_by(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """Heading -> the cells below it after one click on it, and after two."""
    root: Path = tmp_path_factory.mktemp("sorted")
    front = html.build(manifest(*runs()), Store(root / ".vv"), root / "report")
    return seen(front.with_name("case-bounce.html"), CLICK, root)


def test_orders_are_sorted_by_their_size_beside_their_spread(sorted_by: dict[str, Any]) -> None:
    up, down = sorted_by["Observed order"]
    assert [cell.split()[0] for cell in up] == ["1.00", "2.00", "12.29", NONE]
    assert [cell.split()[0] for cell in down] == ["12.29", "2.00", "1.00", NONE]


def test_times_are_sorted_by_their_seconds_whatever_their_unit_and_mark(
    sorted_by: dict[str, Any],
) -> None:
    up, down = sorted_by["CPU"]
    assert up == ["700 µs", "3 ms ○", "5 s", "2 min"]
    assert down == up[::-1]


def test_errors_are_sorted_by_their_size_and_words_as_words(sorted_by: dict[str, Any]) -> None:
    assert sorted_by["Error"][0] == ["4.0e-8", "2.0e-3", "2.5e-3", "5.0e-1"]
    assert [cell[:2] for cell in sorted_by["Code/scheme"][1]] == ["dd", "cc", "bb", "aa"]

"""A report on four schemes of three codes in three variants, whose numbers are round.

Errors at each step are those at which costs are asked for, so that a cost is that of a setting.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from reports import html
from tests.support.browser import CHROMIUM, opened
from tests.support.fabricated import STEPS, case, changed, cost, entry, manifest, record
from vv.records.job_record import Record
from vv.store.store import Store

in_browser = pytest.mark.skipif(not CHROMIUM, reason="Chromium is not installed")
Runs = tuple[tuple[float, float], tuple[float, float], tuple[float, float]]
RUNS: dict[tuple[str, str], Runs] = {  # (error, CPU time [ms]) at each of STEPS
    ("aa/one", "T1"): ((1e-2, 1.0), (1e-3, 10.0), (1e-4, 100.0)),
    ("aa/one", "T2"): ((1e-2, 2.0), (1e-3, 40.0), (3e-4, 800.0)),
    ("aa/one", "T3"): ((1e-2, 1.0), (1e-3, 10.0), (5e-4, 100.0)),
    ("aa/two", "T1"): ((1e-2, 3.0), (1e-3, 20.0), (7e-4, 60.0)),
    ("aa/two", "T3"): ((1e-2, 2.0), (1e-3, 5.0), (9e-4, 50.0)),
    ("bb/one", "T1"): ((1e-2, 2.0), (1e-3, 5.0), (2e-4, 30.0)),
    ("bb/one", "T2"): ((1e-2, 4.0), (1e-3, 360.0), (6e-4, 1200.0)),
    ("cc/one", "T1"): ((1e-1, 0.4), (5e-2, 2.0), (2e-2, 3.0)),
    ("cc/one", "T2"): ((1e-1, 1.0), (5e-2, 2.0), (1e-2, 4.0)),
    ("cc/one", "T3"): ((1e-1, 1.0), (5e-2, 2.0), (2e-2, 3.0)),
}


def runs(timed: bool) -> list[Record]:
    return [
        record(
            label, variant, dt,
            quantities=[entry("pass", {"max": error}, tolerance=1.0)],
            cost=cost(timed=timed, cpu=1e-3 * cpu),
        )
        for (label, variant), settings in RUNS.items()
        for dt, (error, cpu) in zip(STEPS, settings, strict=True)
    ]  # fmt: skip


def report(folder: Path, timed: bool = True) -> Path:
    """The folder of the report."""
    facts = case()
    variants = dict.fromkeys(("T1", "T2", "T3"), facts.variants["T1"])
    whole = manifest(*runs(timed), cases={"bounce": changed(facts, variants=variants)})
    return html.build(whole, Store(folder / ".vv"), folder / "report").parent


def seen(page: Path, script: str, scratch: Path, at: str = "") -> dict[str, Any]:
    """What a script noted that ran in a page; nothing else may have been said or asked for."""
    found = opened(page, script, scratch, at)
    assert (found.asked, found.console, found.said.get("failed")) == ([], [], None)
    return found.said

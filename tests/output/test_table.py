"""Stored results as a table: a row for each record and quantity, wherever they are read from."""

from __future__ import annotations

import io
from pathlib import Path

import pandas as pd
import pytest

import vv
from tests.conftest import Tiny
from tests.support.fabricated import entry, manifest_of_all, record
from vv.base.errors import UsageError
from vv.output.table import rows, table
from vv.records.job_record import JobCost
from vv.records.outcomes import CostKind
from vv.store.store import Store

ASKED = ("case", "variant", "code", "scheme", "dt", "kn", "status", "verdict", "quantity", "error",
         "tolerance", "value", "solve_cpu")  # fmt: skip


def test_there_is_a_row_for_each_quantity_and_one_for_what_gave_none(tmp_path: Path) -> None:
    records = manifest_of_all(Store(tmp_path)).records
    found = table(records)
    assert len(found) == sum(max(1, len(record.quantities)) for record in records)
    assert set(ASKED) <= set(found.columns)
    fine = found[(found.code == "dem") & (found.variant == "T1") & (found.dt == 1e-3)]
    assert sorted(fine.verdict) == ["pass", "xfail"]
    assert (found[found.status == "refused"].quantity.isna()).all()
    assert set(found[found.outcome == "not conserved"].scheme) == {"j"}


COST = JobCost(1.5, 2.5, 3.5, 4.5, 5.5, repeats=7, spread=0.25, kind=CostKind.TIMED)
SERIES = entry(
    "xfail", {"max": 0.3, "l2": 0.4}, name="p", unit="N", norm="l2", tolerance=0.6, scale=0.7,
    end=8.0, figures={"final": 9.0, "mean": 10.0}, note="late",
)  # fmt: skip
NUMBER = entry(
    "fail", {"max": 0.11, "final": 0.12}, name="E", unit="J", kind="scalar", norm="final",
    value=13.0, reference=14.0, end=15.0, figures={"final": 16.0, "value": 17.0}, tolerance=0.18,
    scale=19.0,
)  # fmt: skip


def test_each_column_has_the_number_of_its_own_field() -> None:
    """No two numbers are alike, so that a field in the place of another shows."""
    one = record(
        "a/b", "T1", None, rung={"dt": 2e-3, "kn": 3e8}, study="grid", steps=21, cost=COST,
        modified=True, changed=["mu", "m"], parameters={"m": 2.0, "g": 9.81, "mu": 0.25},
        quantities=[SERIES, NUMBER], reason="so it is", method="penalty",
    )  # fmt: skip
    shared = {
        "case": "bounce", "variant": "T1", "study": "grid", "modified": True,
        "changed": "mu=0.25, m=2", "code": "a",
        "scheme": "b", "code_version": "1.2", "method": "penalty", "dt": 2e-3, "kn": 3e8,
        "status": "ran", "outcome": "fail", "reason": "so it is", "steps": 21,
        "cost_kind": "timed", "solve_cpu": 3.5, "solve_wall": 4.5, "startup": 1.5, "setup": 2.5,
        "output": 5.5, "repeats": 7, "spread": 0.25,
    }  # fmt: skip
    series = {
        "quantity": "p", "kind": "series", "unit": "N", "value": 9.0, "reference": 8.0,
        "error": 0.4, "norm": "l2", "tolerance": 0.6, "verdict": "xfail", "note": "late",
    }  # fmt: skip
    number = {
        "quantity": "E", "kind": "scalar", "unit": "J", "value": 13.0, "reference": 14.0,
        "error": 0.12, "norm": "final", "tolerance": 0.18, "verdict": "fail", "note": "",
    }  # fmt: skip
    assert [*rows(one)] == [{**shared, **series}, {**shared, **number}]
    bare = record("a/b", "T1", 2e-3, cost=COST)
    (row,) = rows(bare)
    assert row["changed"] == ""
    assert {row[name] for name in series} == {None}
    assert (row["outcome"], row["kn"], row["study"]) == ("not reported", None, "ladder")


def test_no_records_are_a_table_without_rows() -> None:
    assert len(table(())) == 0
    assert set(ASKED) <= set(table(()).columns)


def test_the_latest_invocation_a_manifest_and_a_document_tell_the_same(
    tiny: Tiny, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("VV_PROJECT", raising=False)
    monkeypatch.delenv("VV_DATA", raising=False)
    monkeypatch.chdir(tiny.root)
    with pytest.raises(UsageError, match="no results in"):
        vv.results()
    codes = ("--codes", "fake/good,fake/refuses")
    tiny.vv("run", "fall:up", *codes, "--json", "out.json")
    found = vv.results()
    assert set(found.quantity.dropna()) == {"y", "y_end", "turns"}
    assert set(found.status) == {"ran", "refused"}
    (manifest,) = (tiny.root / ".vv" / "manifests").glob("*.json")
    pd.testing.assert_frame_equal(vv.results(manifest), found)
    pd.testing.assert_frame_equal(vv.results("out.json"), found)
    said = tiny.vv("report", "--csv", "-").stdout
    again = pd.read_csv(io.StringIO(said))
    assert list(again.quantity.dropna()) == list(found.quantity.dropna())
    assert list(again.error.dropna()) == list(found.error.dropna())

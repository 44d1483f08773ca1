"""Stored results as a table: a row for each record and quantity, wherever they are read from."""

from __future__ import annotations

import io
from pathlib import Path

import pandas as pd
import pytest

import vv
from tests.conftest import Tiny
from tests.support.fabricated import manifest_of_all
from vv.base.errors import UsageError
from vv.output.table import table
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

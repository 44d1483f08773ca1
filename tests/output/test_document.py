"""Claims about records as one JSON document: whole, with their origin, and only numbers in it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from tests.support.fabricated import NOWHERE, changed, entry, manifest, record
from vv.insight.stability_summary import stability
from vv.output.export import document
from vv.records.job_record import Record, summary_of
from vv.records.manifest import Manifest
from vv.store.store import Store

T = np.array([0.0, 0.5, 1.0])
VALUE, REFERENCE = np.array([1.0, np.nan, -np.inf]), np.array([2.0, 3.0, 4.0])


def kept(store: Store, *quantities: Any) -> Record:
    """A record with quantities, and its one series in the store."""
    made = record("dem/default", "T1", 4e-3, quantities=quantities)
    arrays = {"t": T, "y.value": VALUE, "y.reference": REFERENCE}
    store.keep_summary(made.key, summary_of(made), arrays)
    return made


def strict(whole: Manifest, store: Store) -> Any:
    """The document as a reader has it that knows no NaN."""

    def refused(word: str) -> None:
        raise AssertionError(f"{word} is no JSON")

    return json.loads(document(whole, store), parse_constant=refused)


def test_what_is_no_number_is_null_and_only_series_are_written_out(tmp_path: Path) -> None:
    store = Store(tmp_path)
    number = entry("pass", {"max": 0.0}, name="E", kind="scalar", value=3.0, reference=4.0)
    count = entry("pass", {"max": 0.0}, name="n", kind="count", value=5.0, reference=6.0)
    made = kept(store, entry("fail", {"max": None}, end=4.0), number, count)
    (told,) = strict(manifest(made), store)["records"]
    series, scalar, whole = told["quantities"]
    assert series["value"] == {"t": T.tolist(), "y": [1.0, None, None]}
    assert series["reference"] == {"t": T.tolist(), "y": REFERENCE.tolist()}
    assert (scalar["value"], scalar["reference"]) == (3.0, 4.0)
    assert (whole["value"], whole["reference"]) == (5.0, 6.0)


def test_a_series_that_is_not_kept_is_null(tmp_path: Path) -> None:
    store = Store(tmp_path)
    lost = record("dem/default", "T1", 2e-3, quantities=[entry("pass", {"max": 0.0})])
    (told,) = strict(manifest(lost), store)["records"]
    assert told["quantities"][0]["value"] is told["quantities"][0]["reference"] is None


def test_each_record_says_where_it_comes_from(tmp_path: Path) -> None:
    store = Store(tmp_path)
    made = kept(store, entry("fail", {"max": None}, end=4.0))
    (told,) = strict(manifest(made, provenance=changed(NOWHERE, dirty=False)), store)["records"]
    assert (told["provenance"]["commit"], told["provenance"]["dirty"]) == (NOWHERE.commit, False)
    assert told["provenance"]["machine"]["fingerprint"] == NOWHERE.machine.fingerprint


def test_what_a_run_says_of_stability_stands_beside_its_records(tmp_path: Path) -> None:
    store = Store(tmp_path)
    count = {"name": "n", "kind": "count", "unit": ""}
    counted = [
        record("dem/default", "T1", dt, quantities=[
            entry("pass", {"max": 0.0}, value=value, reference=3.0, **count)
        ])
        for dt, value in ((4e-3, 5.0), (2e-3, 3.0))
    ]  # fmt: skip
    whole = manifest(*counted)
    (said,) = stability(whole)
    (told,) = strict(whole, store)["stability"]
    assert (told["kind"], told["label"], told["value"], told["due"]) == (
        said.kind, "dem/default", 3.0, 3.0,
    )  # fmt: skip
    assert told["text"] == said.text

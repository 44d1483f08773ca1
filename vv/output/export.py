"""The records of an invocation as one self-contained document, series included."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from vv.insight.stability_summary import as_data
from vv.store.store import Store


def document(manifest: Mapping[str, Any], store: Store) -> dict[str, Any]:
    """Records as vv/records/record.schema.json states them, and what they say of stability.

    Provenance stands in each record, and series are written out.
    """
    records = [_full(record, manifest["provenance"], store) for record in manifest["records"]]
    return {"records": records, "stability": as_data(manifest)}


def _full(record: Mapping[str, Any], provenance: Mapping[str, Any], store: Store) -> dict[str, Any]:
    arrays = store.series(record["key"]) if record["quantities"] else {}
    entries = [_with_series(entry, arrays) for entry in record["quantities"]]
    return {**record, "quantities": entries, "provenance": dict(provenance)}


def _with_series(entry: dict[str, Any], arrays: Mapping[str, Any]) -> dict[str, Any]:
    if entry["kind"] != "series":
        return entry
    told = {part: arrays.get(f"{entry['name']}.{part}") for part in ("value", "reference")}
    times = arrays.get("t")
    return {**entry, **{part: _series(times, y) for part, y in told.items()}}


def _series(t: Any, y: Any) -> dict[str, list[float | None]] | None:
    if t is None or y is None:
        return None
    finite = [float(v) if np.isfinite(v) else None for v in y]
    return {"t": [float(v) for v in t], "y": finite}

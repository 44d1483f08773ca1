"""The records of an invocation with their series as one JSON document."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from vv.insight.stability_summary import stability
from vv.records import codec
from vv.records.codec import Json
from vv.records.job_record import Record
from vv.records.manifest import Manifest, Provenance
from vv.records.outcomes import QuantityKind
from vv.records.quantity import MeasuredQuantity
from vv.scene import Vector
from vv.store.store import Store


def document(manifest: Manifest, store: Store) -> str:
    """Records as vv/records/record.schema.json states them, and what they say of stability.

    Provenance stands in each record, and series are written out.
    """
    records = [_full(record, manifest.provenance, store) for record in manifest.records]
    return codec.render({"records": records, "stability": stability(manifest)})


def _full(record: Record, provenance: Provenance, store: Store) -> Json:
    arrays = store.series(record.key, record.quantities) or {}
    quantities = [_with_series(one, arrays) for one in record.quantities]
    data: Json = codec.to_data(record)
    return {**data, "quantities": quantities, "provenance": codec.to_data(provenance)}


def _with_series(one: MeasuredQuantity, arrays: Mapping[str, Vector]) -> Json:
    data: Json = codec.to_data(one)
    if one.kind is not QuantityKind.SERIES:
        return data
    times = arrays.get("t")
    parts = {part: arrays.get(f"{one.name}.{part}") for part in ("value", "reference")}
    return {**data, **{part: _series(times, y) for part, y in parts.items()}}


def _series(t: Vector | None, y: Vector | None) -> dict[str, list[float | None]] | None:
    if t is None or y is None:
        return None
    finite = [float(v) if np.isfinite(v) else None for v in y]
    return {"t": [float(v) for v in t], "y": finite}

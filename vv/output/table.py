"""Makes a table of stored results for notebooks and CSV: a row for each record and quantity."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from vv.base.errors import UsageError
from vv.gate.judgement import outcome
from vv.plan.project import find
from vv.records import codec
from vv.records.codec import Json
from vv.records.job_record import Record
from vv.records.quantity import MeasuredQuantity
from vv.records.reading import settings
from vv.store import manifest_text
from vv.store.store import Store

if TYPE_CHECKING:
    import pandas as pd


def results(source: str | Path | None = None) -> pd.DataFrame:
    """Stored results as a table, a row for each record and quantity.

    source: a manifest of a store, or a document that `--json` wrote; if not given, the latest
    invocation of the project that the current folder lies in. A record without quantities has one
    row, without a quantity. dt [s], kn [N/m], the parts of the cost in seconds; `solve_cpu` of
    the stepping loop alone. Raises UsageError where there are no results, ValueError for a file
    that holds none or is damaged.
    """
    return table(_latest() if source is None else _records_in(Path(source)))


def table(records: Iterable[Record]) -> pd.DataFrame:
    """Records as a table, a row for each of their quantities."""
    import pandas as pd

    columns = [*_of_record(None), *_of_quantity(None)]
    return pd.DataFrame([row for record in records for row in rows(record)], columns=columns)


def rows(record: Record) -> Iterator[Json]:
    """A record as rows of the table, one for each of its quantities."""
    shared = _of_record(record)
    for one in record.quantities or (None,):
        yield shared | _of_quantity(one)


def _of_record(record: Record | None) -> Json:
    """The columns of a record; None for all, if there is no record."""
    r = record
    return {
        "case": r and r.case,
        "variant": r and r.variant,
        "study": r and codec.word(r.study),
        "modified": r and r.modified,
        "changed": r and ", ".join(settings(r)),
        "code": r and r.code,
        "scheme": r and r.scheme,
        "code_version": r and r.code_version,
        "method": r and codec.word(r.method),
        "dt": r and r.rung.dt,
        "kn": r and r.rung.kn,
        "status": r and codec.word(r.status),
        "outcome": r and outcome(r).value,
        "reason": r and r.reason,
        "steps": r and r.steps,
        "cost_kind": r and codec.word(r.cost.kind),
        "solve_cpu": r and r.cost.solve_cpu,
        "solve_wall": r and r.cost.solve_wall,
        "startup": r and r.cost.startup,
        "setup": r and r.cost.setup,
        "output": r and r.cost.output,
        "repeats": r and r.cost.repeats,
        "spread": r and r.cost.spread,
    }


def _of_quantity(quantity: MeasuredQuantity | None) -> Json:
    """The columns of a quantity; None for all, if there is none. value: final, for a series."""
    q = quantity
    norm = q and q.norm
    return {
        "quantity": q and q.name,
        "kind": q and codec.word(q.kind),
        "unit": q and q.unit,
        "value": q and (q.value if q.value is not None else q.figures.get("final")),
        "reference": q and (q.reference if q.reference is not None else q.end),
        "error": q and q.error,
        "norm": norm and codec.word(norm),
        "tolerance": q and q.tolerance,
        "verdict": q and q.verdict.value,
        "note": q and q.note,
    }


def _latest() -> Iterable[Record]:
    store = Store(find().data())
    latest = store.manifests.latest()
    if latest is None:
        raise UsageError(f"no results in {store.root}; `vv run` makes some")
    return latest.records


def _records_in(path: Path) -> Iterable[Record]:
    text = path.read_text(encoding="utf-8")
    document = codec.parse(text)
    if isinstance(document, dict) and isinstance(document.get("records"), list):
        return [codec.read(Record, _as_kept(one), "record") for one in document["records"]]
    return manifest_text.whole(text, path.stem).records


def _as_kept(data: Json) -> Json:
    """A record of a JSON document in the form of a manifest, without provenance and series."""
    quantities = [
        {**one, "value": None, "reference": None} if one.get("kind") == "series" else one
        for one in data.get("quantities", ())
    ]
    return {name: part for name, part in data.items() if name != "provenance"} | {
        "quantities": quantities
    }

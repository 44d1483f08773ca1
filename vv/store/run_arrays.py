"""Converts a run to arrays and back; one array holds all else as JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from vv.ask import (
    Cost,
    Displacement,
    Impulse,
    Ledger,
    Model,
    Observable,
    Reaction,
    Run,
    Status,
    Strain,
    Velocity,
)
from vv.records import codec
from vv.records.job_record import ModelSummary
from vv.scene import Form, Term, Vector
from vv.store.series_check import NUMBERS

OBSERVABLES: Mapping[str, type[Observable]] = {
    kind.__name__: kind for kind in (Displacement, Velocity, Reaction, Impulse, Strain)
}


@dataclass(frozen=True, slots=True)
class RunMeta:
    """The parts of a run that are not arrays, with its key; terms and observables by name."""

    observables: tuple[tuple[str, int], ...]
    cost: Cost
    model: ModelSummary | None
    ledger: Ledger | None
    steps: int
    reason: str
    key: str


def arrays_of(run: Run, key: str) -> dict[str, Any]:
    """The arrays to store of a run, by names, with its key."""
    arrays = {f"value{i}": value for i, value in enumerate(run.values.values())}
    arrays |= {f"energy {form.name}": value for form, value in run.energies.items()}
    meta = np.array(codec.render(_meta(run, key)))
    return {"meta": meta, "t": run.times, "tried": run.tried, **arrays}


def run_from(arrays: Mapping[str, Any], key: str) -> Run:
    """The run of that key, which arrays hold; raises what reading raises, and for another key."""
    meta = codec.read(RunMeta, codec.parse(str(arrays["meta"])), "run")
    if meta.key != key:
        raise ValueError(f"it is of the key {meta.key}")
    return _run(meta, arrays)


def _run(meta: RunMeta, arrays: Mapping[str, Any]) -> Run:
    model = meta.model
    for name, array in arrays.items():
        if name != "meta" and array.dtype.kind not in NUMBERS:
            raise ValueError(f"{name} holds no numbers")
    values: dict[Observable, Vector] = {
        OBSERVABLES[kind](body): arrays[f"value{i}"]
        for i, (kind, body) in enumerate(meta.observables)
    }
    return Run(
        Status.RAN,
        meta.reason,
        times=arrays["t"],
        values=values,
        cost=meta.cost,
        steps=meta.steps,
        model=None if model is None else _model_from(model),
        ledger=meta.ledger,
        energies={form: arrays[name] for form in Form if (name := f"energy {form.name}") in arrays},
        tried=arrays["tried"],
    )


def _meta(run: Run, key: str) -> RunMeta:
    model = run.model
    names = tuple(sorted(term.name for term in model.terms)) if model else ()
    return RunMeta(
        observables=tuple((type(o).__name__, o.body) for o in run.values),
        cost=run.cost,
        model=None if model is None else ModelSummary(model.unknowns, names, model.note),
        ledger=run.ledger,
        steps=run.steps,
        reason=run.reason,
        key=key,
    )


def _model_from(summary: ModelSummary) -> Model:
    return Model(summary.unknowns, frozenset(Term[name] for name in summary.terms), summary.note)

"""A made-up invocation: records of every outcome, and the series of those that ran."""

from __future__ import annotations

from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any, TypeVar

import numpy as np

from vv.base import metrics
from vv.case import Parameter, Source
from vv.records import codec
from vv.records.case_facts import CaseFacts, QuantityFacts, ToleranceFacts, VariantFacts
from vv.records.job_record import JobCost, Record, summary_of
from vv.records.manifest import CodeFound, Machine, Manifest, Provenance
from vv.records.outcomes import CostKind, JudgeKind
from vv.records.quantity import MeasuredQuantity
from vv.store.store import Store

STEPS = (4e-3, 2e-3, 1e-3)
VERDICTS = {"dem/default": "pass", "dem/published": "xfail", "other/default": "fail"}
Thing = TypeVar("Thing")
NOWHERE = Provenance(
    utc="2025-01-01T00:00:00+00:00",
    commit="c0ffee" * 7,
    dirty=True,
    command="vv run --all",
    machine=Machine("P", 2, "S", "f00"),
    versions={"vv": "0.1"},
    threads=1,
)


def some(**named: Any) -> Any:
    """A stand-in that has only these attributes."""
    return SimpleNamespace(**named)


def changed(thing: Thing, **changes: Any) -> Thing:
    """A record, or a part of one, with changes as JSON has them: members of enums as words."""
    data = {**codec.to_data(thing), **{name: codec.to_data(one) for name, one in changes.items()}}
    return codec.read(type(thing), data, "changed")


def requantified(record: Record, **changes: Any) -> Record:
    """A record with changes of all its quantities."""
    return changed(record, quantities=[changed(one, **changes) for one in record.quantities])


def cost(timed: bool = False, cpu: float = 1e-4) -> JobCost:
    kind = CostKind.TIMED if timed else CostKind.INDICATIVE
    return JobCost(1e-3, 1e-3, cpu, 1e-3, 1e-3, repeats=9, spread=0.1, kind=kind)


def record(label: str, variant: str, dt: float | None, **changes: Any) -> Record:
    code, _, scheme = label.partition("/")
    data = {
        "case": "bounce",
        "variant": variant,
        "study": "ladder",
        "parameters": {"m": 1.0},
        "modified": False,
        "code": code,
        "scheme": scheme,
        "code_version": "1.2",
        "method": "second-order",
        "rung": {"dt": dt, "kn": None},
        "key": f"{variant}{code}{scheme}{dt}".encode().hex(),
        "status": "ran",
        "reason": "",
        "cost": cost(),
        "steps": 100,
        "model": {"unknowns": 1, "terms": ["gravity", "drag"], "note": "one freedom"},
        "ledger": None,
        "quantities": [],
        **changes,
    }
    return codec.read(Record, codec.to_data(data), "record")


def entry(verdict: str, errors: Mapping[str, float | None], **changes: Any) -> MeasuredQuantity:
    data = {
        "name": "y",
        "kind": "series",
        "unit": "m",
        "value": None,
        "reference": None,
        "end": None,
        "errors": errors,
        "scale": 1.0,
        "figures": {},
        "judge": "exact",
        "norm": "max",
        "tolerance": 1e-3,
        "why": "the method's own error",
        "note": "",
        "verdict": verdict,
        **changes,
    }
    return codec.read(MeasuredQuantity, codec.to_data(data), "quantity")


def ran(store: Store, label: str, variant: str, dt: float | None, verdict: str) -> Record:
    """A record with its series in the store: a wave, wrong by as much as its step."""
    t = np.linspace(0.0, 1.0, 41)
    reference = np.cos(5 * t) if variant == "T2" else np.sin(3 * t)
    value = reference * (1 + 10 * (dt or 1e-9) ** 2 * np.cos(7 * t))
    errors = {
        "max": float(metrics.max_error(value, reference)),
        "final": float(metrics.final_error(value, reference)),
        "pointwise": float(metrics.pointwise_error(value, reference)),
        "l2": float(metrics.l2_error(value, reference)),
    }
    size, end = float(np.abs(reference).max()), float(reference[-1])
    note = "drag is late" if verdict == "xfail" else ""
    known = entry(verdict, errors, note=note, scale=size, end=end)
    made = record(label, variant, dt, quantities=[known], cost=cost(timed=dt == 2e-3))
    series = {"t": t, "y.value": value, "y.reference": reference}
    store.keep_summary(made.key, summary_of(made), series)
    return made


def case() -> CaseFacts:
    quantity = QuantityFacts(
        name="y",
        symbol="y",
        unit="m",
        meaning="height",
        judge=JudgeKind.EXACT,
        norm="max",
        tolerances={"second order in dt": ToleranceFacts(1e-3, "why", 1e-3, 2)},
    )
    variant = VariantFacts(
        summary="a ball bounces",
        formula="y = sin 3t",
        inert=(),
        terms=("gravity",),
        unknowns=1,
        quantities=(quantity,),
    )
    facts = CaseFacts(
        title="Bounces",
        source=Source("Someone (2001)", "10.1/(x)", "misprint"),
        published={"Fig. 4": "grows with time"},
        enforced=(),
        parameters=(Parameter("m", 1.0, "kg", "mass"),),
        variants={"T1": variant, "T2": variant},
    )
    return changed(facts, enforced=["accuracy", "conservation", "regression", "speed"])


def manifest(*records: Record, **parts: Any) -> Manifest:
    """A manifest of these records, each of a fabricated case; parts: as its fields have them."""
    whole: dict[str, Any] = {
        "provenance": NOWHERE,
        "codes": {one.code: CodeFound("1", True, {}) for one in records},
        "cases": {name: case() for name in ("bounce", *(one.case for one in records))},
        "untimed": (),
        "records": records,
        "findings": (),
        "baselines": {},
        "recorded": (),
        "name": "20250101",
    }
    return Manifest(**{**whole, **parts})


HEAD = "# driver <&>\n" * 100
TAIL = "the same <everywhere>\n" * 9


def native(record: Record) -> str:
    """What a code was given for a record, in the language of no code."""
    return f'{HEAD}variant = "{record.variant}"\n{TAIL}'


def with_external(whole: Manifest, code: str) -> Manifest:
    """The manifest, with a code as a program of others."""
    return changed(whole, codes={**whole.codes, code: CodeFound("1", True, {"bin/x": "digest"})})


def manifest_of_all(store: Store) -> Manifest:
    """Two variants in seven schemes: everything that may come of a job, once at least."""
    runs = [
        ran(store, label, variant, dt, verdict)
        for variant in ("T1", "T2")
        for label, verdict in VERDICTS.items()
        for dt in STEPS
    ]
    runs += [ran(store, "exact/default", v, None, "pass") for v in ("T1", "T2")]
    nothing = {"model": None, "steps": 0, "cost": cost(cpu=0.0)}
    fates = (("a", "refused"), ("b", "not-installed"), ("c", "error"), ("d", "timeout"))
    for name, status in (*fates, ("e", "diverged"), ("f", "not-run"), ("l", "too-long")):
        runs += [
            record(f"fate/{name}", "T1", dt, status=status, reason=f"{status} it is", **nothing)
            for dt in STEPS
        ]
    runs.append(record("fate/g", "T1", 1e-3))
    blown = {**nothing, "study": "grid", "status": "diverged", "reason": "it blew up"}
    runs.append(record("fate/k", "T1", 1e-3, **blown))
    runs.append(ran(store, "fate/h", "T1", 1e-3, "xpass"))
    runs.append(ran(store, "fate/i", "T1", 1e-3, "no-reference"))
    energy = {"terms": {}, "unaccounted": 2.0, "peak": 9.0, "bound": 1.0, "audits": {}}
    runs.append(changed(ran(store, "fate/j", "T1", 1e-3, "pass"), ledger=energy))
    return manifest(*runs)

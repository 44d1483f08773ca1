"""An invocation that never was: records of every outcome, and the series of those that ran."""

from __future__ import annotations

from typing import Any

import numpy as np

from vv.base import metrics
from vv.store.store import Store

STEPS = (4e-3, 2e-3, 1e-3)
VERDICTS = {"dem/default": "pass", "dem/published": "xfail", "other/default": "fail"}
Json = dict[str, Any]


def cost(timed: bool = False, cpu: float = 1e-4) -> Json:
    parts = dict.fromkeys(("startup", "setup", "solve_wall", "output"), 1e-3)
    kind = "timed" if timed else "indicative"
    return {**parts, "solve_cpu": cpu, "repeats": 9, "spread": 0.1, "kind": kind}


def record(label: str, variant: str, dt: float | None, **changes: Any) -> Json:
    code, _, scheme = label.partition("/")
    return {
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


def entry(verdict: str, errors: Json, **changes: Any) -> Json:
    return {
        "name": "y",
        "kind": "series",
        "unit": "m",
        "value": None,
        "reference": None,
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


def ran(store: Store, label: str, variant: str, dt: float | None, verdict: str) -> Json:
    """A record with its series in the store: a wave, wrong by as much as its step."""
    t = np.linspace(0.0, 1.0, 41)
    reference = np.cos(5 * t) if variant == "T2" else np.sin(3 * t)
    value = reference * (1 + 10 * (dt or 1e-9) ** 2 * np.cos(7 * t))
    errors = {
        "max": metrics.max_error(value, reference),
        "final": metrics.final_error(value, reference),
        "pointwise": metrics.pointwise_error(value, reference),
        "l2": metrics.l2_error(value, reference),
    }
    known = entry(verdict, errors, note="drag is late" if verdict == "xfail" else "")
    made = record(label, variant, dt, quantities=[known], cost=cost(timed=dt == 2e-3))
    store.keep_record(made["key"], made, {"t": t, "y.value": value, "y.reference": reference})
    return made


def case() -> Json:
    tolerance = {"value": 1e-3, "reason": "why", "dt": 1e-3, "order": 2, "floor": 0, "slack": ""}
    quantity = {
        "name": "y",
        "symbol": "y",
        "unit": "m",
        "meaning": "height",
        "judge": "exact",
        "norm": "max",
        "tolerances": {"second order in dt": tolerance},
    }
    variant = {
        "summary": "a ball bounces",
        "formula": "y = sin 3t",
        "inert": [],
        "terms": ["gravity"],
        "unknowns": 1,
        "quantities": [quantity],
    }
    return {
        "title": "Bounces",
        "source": {"citation": "Someone (2001)", "doi": "10.1/(x)", "note": "misprint"},
        "enforced": ["accuracy", "conservation", "regression", "speed"],
        "published": {"Fig. 4": "grows with time"},
        "parameters": [{"name": "m", "value": 1.0, "unit": "kg", "meaning": "mass"}],
        "variants": {"T1": variant, "T2": variant},
    }


def manifest_of_all(store: Store) -> Json:
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
    runs.append({**ran(store, "fate/j", "T1", 1e-3, "pass"), "ledger": energy})
    machine = {"processor": "P", "cores": 2, "system": "S", "fingerprint": "f00"}
    told = {"utc": "2025-01-01T00:00:00+00:00", "commit": "c0ffee" * 7, "dirty": True}
    told |= {"command": "vv run --all", "versions": {"vv": "0.1"}, "threads": 1}
    return {
        "name": "20250101",
        "provenance": {**told, "machine": machine},
        "codes": {r["code"]: {"version": "1", "installed": True, "files": {}} for r in runs},
        "cases": {"bounce": case()},
        "findings": [],
        "baselines": {},
        "recorded": [],
        "records": runs,
    }

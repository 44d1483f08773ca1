"""What a case says of itself, as plain data for the report and for people."""

from __future__ import annotations

import dataclasses
from typing import Any

from vv.case import Case, Exact, Grid, Quantity, Study, Trial, Variant
from vv.plan.plan import Plan


def dossiers(plan: Plan) -> dict[str, Any]:
    """Case name -> its prose, parameters, variants and quantities, for the variants planned."""
    return {name: dossier(case, plan) for name, case in plan.cases.items()}


def dossier(case: Case, plan: Plan) -> dict[str, Any]:
    """One case as plain data."""
    trials = {v: trial for (name, v), trial in plan.trials.items() if name == case.name}
    return {
        "title": case.title,
        "source": dataclasses.asdict(case.source),
        "published": dict(case.published),
        "enforced": sorted(check.value for check in case.enforced),
        "parameters": [dataclasses.asdict(parameter) for parameter in case.parameters],
        "variants": {name: _variant(case.variant(name), trial) for name, trial in trials.items()},
    }


def _variant(variant: Variant, trial: Trial) -> dict[str, Any]:
    scene = trial.study.scene
    return {
        "summary": variant.summary,
        "formula": variant.formula,
        "inert": sorted(variant.inert),
        "terms": sorted(term.value for term in scene.terms()),
        "unknowns": scene.unknowns(),
        "quantities": [_quantity(quantity) for quantity in trial.quantities],
        **_critical(trial.study),
    }


def _critical(study: Study) -> dict[str, Any]:
    """What the steps of a map are multiples of: [kn or none, step] at every stiffness."""
    if not isinstance(study, Grid):
        return {}
    stiffnesses = dict.fromkeys(kn for level in study.kn.values() for kn in level)
    return {"critical": [[kn, study.critical(kn)] for kn in stiffnesses]}


def _quantity(quantity: Quantity) -> dict[str, Any]:
    judge = quantity.judge
    entry = {
        "name": quantity.name,
        "symbol": quantity.symbol,
        "unit": getattr(quantity, "unit", ""),
        "meaning": quantity.meaning,
        "judge": type(judge).__name__.lower(),
    }
    if isinstance(judge, Exact):
        tolerances = {m.value: dataclasses.asdict(t) for m, t in judge.tolerances.items()}
        shown = {m.value: reason for m, reason in judge.not_judged.items()}
        unjudged = {"shown": shown} if shown else {}
        return {**entry, "norm": judge.norm.value, "tolerances": tolerances, **unjudged}
    return {**entry, "reason": judge.reason}

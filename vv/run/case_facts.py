"""Collects the description of a case that a manifest keeps for reports."""

from __future__ import annotations

import dataclasses
import sys
from collections.abc import Sequence

from vv.ask import Displacement
from vv.case import (
    Case,
    ComponentAlong,
    Exact,
    Grid,
    Quantity,
    RotationAbout,
    Series,
    Study,
    Tolerance,
    Trial,
    Variant,
)
from vv.plan.plan import Plan
from vv.records.case_facts import CaseFacts, QuantityFacts, ToleranceFacts, VariantFacts
from vv.records.quantity import judge_kind
from vv.scene import Scene
from vv.scene.picture.moved import Moved, shifted, turned
from vv.scene.picture.sketch import sketch


def case_facts_of(plan: Plan) -> dict[str, CaseFacts]:
    """Case name -> its prose, parameters, variants and quantities, for the variants planned."""
    return {name: case_facts(case, plan) for name, case in plan.cases.items()}


def case_facts(case: Case, plan: Plan) -> CaseFacts:
    """The description of one case."""
    trials = {v: trial for (name, v), trial in plan.trials.items() if name == case.name}
    return CaseFacts(
        title=case.title,
        source=case.source,
        published=case.published,
        enforced=tuple(sorted(case.enforced, key=lambda check: check.value)),
        parameters=case.parameters,
        variants={name: _variant(case.variant(name), trial) for name, trial in trials.items()},
    )


def _variant(variant: Variant, trial: Trial) -> VariantFacts:
    scene = trial.study.scene
    return VariantFacts(
        summary=variant.summary,
        formula=variant.formula,
        inert=tuple(sorted(variant.inert)),
        terms=tuple(sorted(term.value for term in scene.terms())),
        unknowns=scene.unknowns(),
        quantities=tuple(_quantity(quantity) for quantity in trial.quantities),
        critical=_critical(trial.study),
        sketch=sketch(scene),
        moved=_moved(trial.quantities, scene) or None,
        regions=trial.regions,
        phase=trial.phase,
    )


def _moved(quantities: Sequence[Quantity], scene: Scene) -> dict[str, Moved]:
    """Quantity -> the motion of a body in the sketch, for quantities that are such a motion."""
    found = {}
    for quantity in quantities:
        moved = _one_moved(quantity.observe, scene) if isinstance(quantity, Series) else None
        if moved is not None:
            found[quantity.name] = moved
    return found


def _one_moved(observe: object, scene: Scene) -> Moved | None:
    if isinstance(observe, ComponentAlong) and isinstance(observe.observable, Displacement):
        return shifted(scene, observe.observable.body, observe.direction)
    if isinstance(observe, RotationAbout):
        return turned(scene, observe.body, observe.axis, observe.unit)
    return None


def _critical(study: Study) -> tuple[tuple[float | None, float], ...]:
    """The critical steps of a map, (kn or None, step) at every stiffness."""
    if not isinstance(study, Grid):
        return ()
    stiffnesses = dict.fromkeys(kn for level in study.kn.values() for kn in level)
    return tuple((kn, study.critical(kn)) for kn in stiffnesses)


def _quantity(quantity: Quantity) -> QuantityFacts:
    judge = quantity.judge
    facts = QuantityFacts(
        name=quantity.name,
        symbol=quantity.symbol,
        unit=getattr(quantity, "unit", ""),
        meaning=quantity.meaning,
        judge=judge_kind(judge),
    )
    if not isinstance(judge, Exact):
        return dataclasses.replace(facts, reason=judge.reason)
    return dataclasses.replace(
        facts,
        norm=judge.norm.value,
        tolerances={
            method.value: _tolerance(tolerance) for method, tolerance in judge.tolerances.items()
        },
        shown={method.value: reason for method, reason in judge.not_judged.items()} or None,
    )


def _tolerance(tolerance: Tolerance) -> ToleranceFacts:
    """The tolerance in the form of a record, which holds finite numbers only."""
    kept = {one.name: getattr(tolerance, one.name) for one in dataclasses.fields(ToleranceFacts)}
    return ToleranceFacts(**{**kept, "value": min(tolerance.value, sys.float_info.max)})

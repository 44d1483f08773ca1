"""Prints what `vv explain` shows of a case: formula, parameters, tolerances, models, results."""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Iterable, Mapping
from typing import TypeVar

from vv.case import (
    Case,
    CodeToCode,
    Exact,
    Judge,
    Measured,
    Quantity,
    judge_at_other_parameters,
)
from vv.gate.judgement import against_code, against_measurement, outcome
from vv.insight.agreement import agreements
from vv.output.terminal import say
from vv.output.wording import in_words, scaled
from vv.plan.plan import Job, Plan
from vv.records.job_record import Record
from vv.records.manifest import Manifest
from vv.records.outcomes import Outcome
from vv.records.quantity import MeasuredQuantity
from vv.records.reading import changed, tried
from vv.records.recorded import RecordedResult

Result = TypeVar("Result", Record, RecordedResult)


def print_explanation(plan: Plan, manifests: Iterable[Manifest]) -> None:
    """Explain the planned variants, their last results, and which codes agree."""
    past = tuple(_at_parameters(plan, one) for one in manifests)
    results, heard = _last_results(past), agreements(*_last_records(past))
    for name, case in plan.cases.items():
        doi = f", doi:{case.source.doi}" if case.source.doi else ""
        say(case.title, f"  source: {case.source.citation}{doi}")
        say(*([f"  note: {case.source.note}"] if case.source.note else []))
        for source, text in case.published.items():
            say(f"  published, {source}: {text}")
        for variant in case.variants:
            if (name, variant.name) in plan.trials:
                _explain_variant(plan, case, variant.name, results)
                for agreement in heard:
                    if (agreement.case, agreement.variant) == (name, variant.name):
                        say(f"  agreement: {agreement.in_words()}")


def _at_parameters(plan: Plan, manifest: Manifest) -> Manifest:
    """A past run with only its records at the parameters of the plan."""
    asked = {
        (job.case, job.variant): {name: job.parameters[name] for name in job.changed}
        for job in plan.jobs
    }
    kept = [r for r in manifest.records if asked.get((r.case, r.variant)) == changed(r)]
    return dataclasses.replace(manifest, records=tuple(kept))


def _explain_variant(
    plan: Plan, case: Case, name: str, results: Mapping[tuple[str, ...], list[str]]
) -> None:
    variant, trial = case.variant(name), plan.trials[case.name, name]
    own = [job for job in plan.jobs if (job.case, job.variant) == (case.name, name)]
    scene, values, modified = trial.study.scene, own[0].parameters, own[0].changed
    say("", f"{case.name}:{name}: {variant.summary}", f"  formula: {variant.formula}")
    for p in case.parameters:
        hidden = variant.unseen.get(p.name)
        note = (
            "  (inert: not in the exact answer)"
            if p.name in variant.inert
            else f"  (not seen: {hidden})"
            if hidden
            else ""
        )
        mark = "  (changed)" if p.name in modified else ""
        say(f"  {p.name} = {values[p.name]:g} {p.unit}  {p.meaning}{mark}{note}")
    terms = ", ".join(sorted(term.value for term in scene.terms()))
    say(f"  terms: {terms}", f"  unknowns: {scene.unknowns()}")
    for quantity in trial.quantities:
        judge = judge_at_other_parameters(quantity.judge) if modified else quantity.judge
        _explain_quantity(quantity, judge)
    last = {(job.code, job.scheme): job for job in own}
    for (code, scheme), job in last.items():
        say(f"  {code}/{scheme}: {_model_or_refusal(plan, job)}")
        when, *rungs = results.get((case.name, name, code, scheme), ["none yet"])
        if rungs or not job.settled:
            say(f"    last result: {when}")
        for line in rungs:
            say(f"      {line}")


def _model_or_refusal(plan: Plan, job: Job) -> str:
    """The model that a scheme builds for a job, else its summary, or why it does not run it."""
    if job.settled is None:
        adapter = plan.adapters[job.code]
        note = adapter.describe(job.ask, job.scheme).note
        return note or next(one.summary for one in adapter.schemes if one.name == job.scheme)
    reason = job.settled.reason
    lacks = reason.removeprefix(f"{job.code}/{job.scheme} ")
    came = in_words(Outcome(job.settled.status.value))
    return f"{came}: {reason}" if lacks == reason else lacks


def _explain_quantity(quantity: Quantity, judge: Judge) -> None:
    say(f"  quantity {quantity.name} [{getattr(quantity, 'unit', '')}]: {quantity.meaning}")
    if isinstance(judge, Measured):
        _explain_measurement(judge)
        return
    if isinstance(judge, CodeToCode):
        _explain_code_to_code(judge)
        return
    if not isinstance(judge, Exact):
        say(f"    {type(judge).__name__.lower()}: {judge.reason}")
        return
    say(f"    norm: {judge.norm.value}")
    for method, tolerance in judge.tolerances.items():
        say(f"    {method.value}: {scaled(tolerance)}: {tolerance.reason}")
    for method, reason in judge.not_judged.items():
        say(f"    {method.value}: shown: {reason}")


def _explain_measurement(judge: Measured) -> None:
    """The measured value with its uncertainties, and the band for codes."""
    seen = judge.measurement
    say(
        f"    measured: {seen.value:g}, digitised to {seen.digitisation:g}, experiment to "
        f"{seen.experiment:g}; {seen.conditions}; {seen.source}"
    )
    _explain_band(judge)


def _explain_code_to_code(judge: CodeToCode) -> None:
    """The answer of another code, and the band for codes."""
    other = judge.answer
    say(
        f"    code-to-code, neither exact nor measured: {other.code} has {other.value:g}, rounded "
        f"to {other.rounding:g}; {other.source}"
    )
    _explain_band(judge)


def _explain_band(judge: Measured | CodeToCode) -> None:
    """How far a code may be from the value, and why."""
    allowed = "shown beside it" if judge.band is None else f"within {judge.band:g} of it"
    say(f"    {allowed}: {judge.reason}")


def _last_records(manifests: Iterable[Manifest]) -> tuple[list[Record], list[RecordedResult]]:
    """The newest records of each (case, variant, code, scheme), and the recorded results."""
    found: dict[tuple[str, ...], list[Record]] = {}
    beside: dict[tuple[str, ...], list[RecordedResult]] = {}
    for manifest in manifests:
        newest = _by_scheme(manifest.records)
        kept = _by_scheme(manifest.recorded)
        beside.update({place: kept.get(place, []) for place in newest if place not in found})
        found = {**newest, **found}
    return list(itertools.chain(*found.values())), list(itertools.chain(*beside.values()))


def _by_scheme(results: Iterable[Result]) -> dict[tuple[str, ...], list[Result]]:
    """The results of each (case, variant, code, scheme)."""
    found: dict[tuple[str, ...], list[Result]] = {}
    for one in results:
        found.setdefault((one.case, one.variant, one.code, one.scheme), []).append(one)
    return found


def _last_results(manifests: Iterable[Manifest]) -> dict[tuple[str, ...], list[str]]:
    """The newest result of each (case, variant, code, scheme): when, then each rung in words.

    Runs in which the scheme tried no rung say no more than that it refuses, and are left out.
    """
    found: dict[tuple[str, ...], list[str]] = {}
    for manifest in manifests:
        own = _by_scheme(manifest.records)
        when = manifest.provenance.utc
        newest = {
            place: [when, *map(_in_words, records)]
            for place, records in own.items()
            if any(map(tried, records))
        }
        found = {**newest, **found}
    return found


def _in_words(record: Record) -> str:
    errors = "; ".join(map(_quantity_in_words, record.quantities))
    found = record.largest_step
    dt = ("stable to dt", found) if found else ("dt", record.rung.dt)
    knobs = (dt, ("kn", record.rung.kn), ("dd", record.rung.dd))
    at = " ".join(f"{knob} {value:g}" for knob, value in knobs if value is not None)
    came = in_words(outcome(record))
    return f"{at}{': ' if at else ''}{came}: {errors or record.reason}"


def _value_or_error(one: MeasuredQuantity) -> str:
    """What there is to show of a quantity without a bound: its value, final for a series, error."""
    value = one.figures.get("final") if one.value is None else one.value
    shown = [] if value is None else [f"{value:.6g}"]
    shown += [] if one.error is None else [f"error {one.error:.3g}"]
    return ", ".join(shown) or "no value"


def _quantity_in_words(one: MeasuredQuantity) -> str:
    if one.measurement is not None and one.value is not None:
        text = f"{one.name}: {against_measurement(one.value, one.measurement)}"
    elif one.printed is not None and one.value is not None:
        text = f"{one.name}: {against_code(one.value, one.printed)}"
    elif one.tolerance is None:
        text = f"{one.name}: {_value_or_error(one)}, {one.why}"
    else:
        error = math.nan if one.error is None else one.error
        text = f"{one.name}: error {error:.3g}, allowed {one.tolerance:.3g}"
    return f"{text}, {one.note}" if one.note else text

"""Makes the plan: one job for each selected variant, scheme and setting."""

from __future__ import annotations

import functools
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from vv.ask import Ask, Knobs, Run, Status
from vv.base.errors import UsageError
from vv.base.time_limit import TooLongError, time_limit
from vv.case import (
    Case,
    Count,
    Grid,
    Level,
    Quantity,
    Series,
    Study,
    Trial,
    error_scale,
    evaluated,
    knobs_in_scene,
    settings_of,
    why_too_long,
)
from vv.codes.adapter import Adapter, Found, Scheme, known_beforehand, no_steps
from vv.plan.plan import EmptyPlanError, Job, Options, Plan
from vv.plan.project import Project
from vv.plan.rejections import rejection, stated
from vv.plan.selection import choose_schemes, named_adapters, select
from vv.plan.settings import parameters_with_settings

SAMPLES = 401  # times at which series are evaluated for changed parameters
PATIENCE = 20.0  # limit of CPU time [s] for the references of a variant at changed parameters
REFUSED = (ValueError, ArithmeticError, RuntimeError)
FAR = (*REFUSED, LookupError, MemoryError, TypeError)  # formulas also raise these at far values
INERT = "inert, since the exact answer does not contain it: only the errors of codes may change"


def make_plan(project: Project, selection: Sequence[str], options: Options) -> Plan:
    """The plan for a selection; raises UsageError for unknown names and invalid values."""
    chosen = select(project, selection)
    adapters = named_adapters(project, options.codes)
    found = {name: adapter.found() for name, adapter in adapters.items()}
    schemes = choose_schemes(adapters, options.codes)
    posed = [
        _declared(case, variant, options)
        for case, variant in chosen
        if case.variant(variant).runs_at(options.level)
    ]
    jobs = [
        job
        for one in posed
        for adapter, scheme in schemes
        for job in _jobs(one, adapter, scheme, found[adapter.name])
    ]
    if not jobs:
        raise EmptyPlanError(_no_jobs(chosen, options.level))
    cases = {one.case.name: one.case for one in posed}
    trials = {(one.case.name, one.variant): one.trial for one in posed}
    return Plan(tuple(jobs), cases, trials, adapters, found)


def _no_jobs(chosen: Sequence[tuple[Case, str]], level: Level) -> str:
    """Why a selection has no job."""
    later = [case.variant(variant).level for case, variant in chosen]
    if not later:
        return "the selection is empty"
    first = min(later, key=lambda one: one.rank)
    return (
        f"the selection is empty at level {level.value}; --level {first.value} has variants of it"
    )


@dataclass(frozen=True, eq=False)
class _Declared:
    """A variant with its parameters, trial and settings, and the ask at each setting."""

    case: Case
    variant: str
    parameters: Mapping[str, float]
    trial: Trial
    rungs: tuple[Knobs, ...]
    ask: Callable[[Knobs], Ask]


def _declared(case: Case, variant: str, options: Options) -> _Declared:
    parameters = parameters_with_settings(case, variant, options.settings)
    trial = declare_trial(case, variant, parameters)
    if not trial.study.scene.contact.rigid and any(rung.kn for rung in options.rungs):
        raise UsageError(f"{case.name}:{variant} has a contact stiffness of its own; leave out kn")
    chosen = tuple(_as_in_the_case(rung, trial.study) for rung in options.rungs)
    rungs = chosen or trial.study.rungs[options.level]
    return _Declared(case, variant, parameters, trial, rungs, functools.cache(trial.study.ask))


def _as_in_the_case(asked: Knobs, study: Study) -> Knobs:
    """A setting, with the last digits of the case's own where it is that to twelve digits.

    Findings and tables name settings by twelve digits, and so do commands that run one again.
    """

    def digits(knobs: Knobs) -> list[str]:
        return [f"{value:.12g}" for value in vars(knobs).values() if value is not None]

    return next((one for one in settings_of(study, asked) if digits(one) == digits(asked)), asked)


def finest_ask(case: Case, variant: str, options: Options) -> Ask:
    """The ask of a variant at its finest setting, for no particular scheme."""
    posed = _declared(case, variant, options)
    return posed.ask(posed.rungs[-1])


def declare_trial(case: Case, variant: str, parameters: Mapping[str, float]) -> Trial:
    """The trial of a variant; raises UsageError for parameters that the case rejects.

    An error in a formula that the default parameters meet too is a fault of the case, not of the
    values: it is raised as it is.
    With parameters changed by the user, references are evaluated now, so that their errors are
    found early, and within a limit of time: values far from those of the case may take extremely
    long. With default parameters they are left until a run is measured, because some are costly.
    """
    usual = dict(parameters) == case.defaults(variant)
    refused = REFUSED if usual else FAR
    try:
        return case.declare(variant, parameters) if usual else _evaluated(case, variant, parameters)
    except refused as error:
        if not stated(error) and (usual or _fails_at_defaults(case, variant)):
            raise
        raise UsageError(rejection(case, variant, parameters, error)) from error


def _evaluated(case: Case, variant: str, parameters: Mapping[str, float]) -> Trial:
    """The trial of a variant, whose references have been evaluated within the limit of time."""
    # what is not finite is refused where data are created
    with time_limit(PATIENCE), np.errstate(all="ignore"):
        trial = case.declare(variant, parameters)
        _evaluate_references(trial.quantities, trial.study.goal.duration)
    return trial


@functools.cache
def _fails_at_defaults(case: Case, variant: str) -> bool:
    """Whether a formula of a variant fails at its default parameters; not if it only takes long."""
    try:
        _evaluated(case, variant, case.defaults(variant))
    except TooLongError:
        return False
    except Exception as error:
        return not stated(error)
    return False


def _evaluate_references(quantities: Iterable[Quantity], duration: float) -> None:
    """Evaluate the reference and scale of every quantity; raises what they raise.

    Series are evaluated at times throughout the run: an answer may end before it.
    """
    times = np.linspace(0.0, duration, SAMPLES)
    for quantity in quantities:
        if isinstance(quantity, Series):
            if quantity.reference is not None:
                quantity.reference(times)
        elif quantity.reference is not None:
            evaluated(quantity.reference)
        if not isinstance(quantity, Count) and quantity.scale is not None:
            error_scale(quantity.name, quantity.scale)


def _jobs(posed: _Declared, adapter: Adapter, scheme: Scheme, found: Found) -> list[Job]:
    """The jobs of a variant in a scheme: one for each setting that differs in its knobs."""
    terms = posed.trial.study.scene.terms()
    own = knobs_in_scene(posed.trial.study)
    usual = posed.case.defaults(posed.variant)
    changed = tuple(name for name, value in posed.parameters.items() if value != usual[name])
    timed = {project_knobs(knobs, scheme, own) for knobs in posed.trial.study.timed}
    settle = _known_outcome_on_map if isinstance(posed.trial.study, Grid) else _known_outcome
    return [
        Job(
            case=posed.case.name,
            variant=posed.variant,
            parameters=posed.parameters,
            changed=changed,
            code=adapter.name,
            scheme=scheme.name,
            method=scheme.method_for(terms),
            ask=posed.ask(knobs),
            timed=knobs in timed,
            settle=functools.partial(settle, posed, adapter, scheme, posed.ask(knobs), found),
            inert=_changed_without_effect(posed),
        )
        for knobs in dict.fromkeys(project_knobs(knobs, scheme, own) for knobs in posed.rungs)
    ]


def _changed_without_effect(posed: _Declared) -> str:
    """The changed parameters on which the exact answer does not depend, in words."""
    usual = posed.case.defaults(posed.variant)
    inert = posed.case.variant(posed.variant).inert
    changed = [n for n, value in posed.parameters.items() if n in inert and value != usual[n]]
    given = ", ".join(f"{name} = {posed.parameters[name]:g}" for name in changed)
    return f"{given}: {INERT}" if changed else ""


def _known_outcome(
    posed: _Declared, adapter: Adapter, scheme: Scheme, ask: Ask, found: Found
) -> Run | None:
    """The outcome if it is known without running, a refusal or TOO_LONG; else None."""
    run = known_beforehand(adapter, scheme, ask, found)
    why = why_too_long(posed.trial.study, ask.knobs, scheme.pace)
    return Run(Status.TOO_LONG, why) if why and run is None else run


def _known_outcome_on_map(
    posed: _Declared, adapter: Adapter, scheme: Scheme, ask: Ask, found: Found
) -> Run | None:
    """As `_known_outcome`, but steps of a map that are refused only as too long are run."""
    run, own = _known_outcome(posed, adapter, scheme, ask, found), knobs_in_scene(posed.trial.study)
    if run is None or run.status is not Status.REFUSED or no_steps(ask) is not None:
        return run
    row = [k for k in (project_knobs(k, scheme, own) for k in posed.rungs) if k.kn == ask.knobs.kn]
    shorter = [k for k in row if (k.dt or 0.0) < (ask.knobs.dt or 0.0)]
    taken = (known_beforehand(adapter, scheme, posed.ask(k), found) for k in shorter)
    return None if any(one is None for one in taken) else run


def project_knobs(knobs: Knobs, scheme: Scheme, own: Collection[str] = ()) -> Knobs:
    """The knobs that a scheme has, and those in `own`, which change the scene; others are None.

    dd stays, because it changes the problem that is solved: a scheme without it must refuse.
    """
    return Knobs(**{name: getattr(knobs, name) for name in {*scheme.knobs, *own, "dd"}})

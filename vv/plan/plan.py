"""From a selection of cases, codes and settings to the jobs to run."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from vv.ask import Ask, Knobs, Method, Run, Status
from vv.base.errors import UsageError
from vv.case import (
    Case,
    Count,
    Grid,
    Level,
    Quantity,
    Series,
    Trial,
    number,
    put_in,
    size_of,
    too_long,
)
from vv.codes.adapter import Adapter, Found, Scheme, no_steps, settled
from vv.plan.project import Project
from vv.plan.selection import choose_schemes, named_adapters, select
from vv.plan.settings import with_settings


@dataclass(frozen=True)
class Options:
    """What a user may ask of a run besides the selection.

    codes: patterns CODE or CODE/SCHEME. settings: NAME=VALUE[UNIT] texts. rungs: knobs that
    replace the case's own.
    """

    level: Level = Level.DEFAULT
    codes: tuple[str, ...] = ("*",)
    settings: tuple[str, ...] = ()
    rungs: tuple[Knobs, ...] = ()


@dataclass(frozen=True, eq=False)
class Job:
    """One ask put to one scheme, with where it comes from."""

    case: str
    variant: str
    parameters: Mapping[str, float]
    modified: bool
    code: str
    scheme: str
    method: Method
    ask: Ask
    timed: bool
    settle: Callable[[], Run | None]

    @functools.cached_property
    def settled(self) -> Run | None:
        """The outcome if it is known without running: refused or not installed."""
        return self.settle()

    @property
    def label(self) -> str:
        """The job in one word, as people read it."""
        knobs = ",".join(f"{k}={v:g}" for k, v in dataclasses.asdict(self.ask.knobs).items() if v)
        return f"{self.case}:{self.variant} {self.code}/{self.scheme} {knobs}".rstrip()


class EmptyPlanError(UsageError):
    """What was selected holds nothing at the level asked for."""


@dataclass(frozen=True, eq=False)
class Plan:
    """The jobs of an invocation, with the cases, trials and codes they belong to."""

    jobs: tuple[Job, ...]
    cases: Mapping[str, Case]
    trials: Mapping[tuple[str, str], Trial]
    adapters: Mapping[str, Adapter]
    found: Mapping[str, Found]


def make_plan(project: Project, selection: Sequence[str], options: Options) -> Plan:
    """Expand a selection; raises UsageError for names, units and values that make no sense."""
    chosen = select(project, selection)
    adapters = named_adapters(project, options.codes)
    found = {name: adapter.found() for name, adapter in adapters.items()}
    schemes = choose_schemes(adapters, options.codes)
    posed = [
        _pose(case, variant, options)
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
    """Why a selection comes to nothing."""
    later = [case.variant(variant).level for case, variant in chosen]
    if not later:
        return "the selection holds nothing"
    first = min(later, key=lambda one: one.rank)
    return f"the selection holds nothing at level {level.value}; --level {first.value} has some"


def restricted(plan: Plan, keep: Callable[[Job], bool]) -> Plan:
    """The plan with only the jobs to keep, and only their cases and trials."""
    return _with_jobs(plan, tuple(job for job in plan.jobs if keep(job)))


def joined(one: Plan, other: Plan) -> Plan:
    """Both plans as one, each job once; they must be of one project and the same settings."""
    jobs = {_identity(job): job for plan in (other, one) for job in plan.jobs}
    whole = dataclasses.replace(
        one, cases={**other.cases, **one.cases}, trials={**other.trials, **one.trials}
    )
    return _with_jobs(whole, tuple(jobs.values()))


def _identity(job: Job) -> tuple[object, ...]:
    return job.case, job.variant, job.code, job.scheme, job.ask.knobs


def _with_jobs(plan: Plan, jobs: tuple[Job, ...]) -> Plan:
    cases, trials = {job.case for job in jobs}, {(job.case, job.variant) for job in jobs}
    return dataclasses.replace(
        plan,
        jobs=jobs,
        cases={name: case for name, case in plan.cases.items() if name in cases},
        trials={key: trial for key, trial in plan.trials.items() if key in trials},
    )


@dataclass(frozen=True, eq=False)
class _Posed:
    """A variant with its parameters put in, and the asks of its rungs."""

    case: Case
    variant: str
    parameters: Mapping[str, float]
    trial: Trial
    rungs: tuple[Knobs, ...]
    ask: Callable[[Knobs], Ask]


def _pose(case: Case, variant: str, options: Options) -> _Posed:
    parameters = with_settings(case, variant, options.settings)
    trial = declare(case, variant, parameters)
    if not trial.study.scene.contact.rigid and any(rung.kn for rung in options.rungs):
        raise UsageError(f"{case.name}:{variant} has a contact stiffness of its own; leave out kn")
    rungs = options.rungs or trial.study.rungs[options.level]
    return _Posed(case, variant, parameters, trial, rungs, functools.cache(trial.study.ask))


def declare(case: Case, variant: str, parameters: Mapping[str, float]) -> Trial:
    """The trial; bad parameters are the user's, so their errors are usage errors.

    What the answer makes of a user's parameters is seen beforehand; of the case's own it is not
    asked until a run is measured, since some answers take their time.
    """
    try:
        trial = case.declare(variant, parameters)
        if dict(parameters) != case.defaults(variant):
            _answer(trial.quantities)
        return trial
    except ValueError as error:
        raise UsageError(f"{case.name}:{variant}: {error}") from error


def _answer(quantities: Iterable[Quantity]) -> None:
    """Ask every quantity for its reference and its scale."""
    for quantity in quantities:
        if isinstance(quantity, Series):
            if quantity.reference is not None:
                quantity.reference(np.zeros(1))
        elif quantity.reference is not None:
            number(quantity.reference)
        if not isinstance(quantity, Count) and quantity.scale is not None:
            size_of(quantity.name, quantity.scale)


def _jobs(posed: _Posed, adapter: Adapter, scheme: Scheme, found: Found) -> list[Job]:
    """One job per rung, as projected on the knobs the scheme has."""
    terms = posed.trial.study.scene.terms()
    own = put_in(posed.trial.study)
    timed = {project_knobs(knobs, scheme, own) for knobs in posed.trial.study.timed}
    settle = _mapped if isinstance(posed.trial.study, Grid) else _settled
    return [
        Job(
            case=posed.case.name,
            variant=posed.variant,
            parameters=posed.parameters,
            modified=dict(posed.parameters) != posed.case.defaults(posed.variant),
            code=adapter.name,
            scheme=scheme.name,
            method=scheme.method_for(terms),
            ask=posed.ask(knobs),
            timed=knobs in timed,
            settle=functools.partial(settle, posed, adapter, scheme, posed.ask(knobs), found),
        )
        for knobs in dict.fromkeys(project_knobs(knobs, scheme, own) for knobs in posed.rungs)
    ]


def _settled(posed: _Posed, adapter: Adapter, scheme: Scheme, ask: Ask, found: Found) -> Run | None:
    """What is known of a rung beforehand: `settled`, or that it would take too long."""
    run = settled(adapter, scheme, ask, found)
    why = too_long(posed.trial.study, ask.knobs, scheme.pace)
    return Run(Status.TOO_LONG, why) if why and run is None else run


def _mapped(posed: _Posed, adapter: Adapter, scheme: Scheme, ask: Ask, found: Found) -> Run | None:
    """As `_settled`, for a point of a map: what is refused for a long step alone is run."""
    run, own = _settled(posed, adapter, scheme, ask, found), put_in(posed.trial.study)
    if run is None or run.status is not Status.REFUSED or no_steps(ask) is not None:
        return run
    row = [k for k in (project_knobs(k, scheme, own) for k in posed.rungs) if k.kn == ask.knobs.kn]
    shorter = [k for k in row if (k.dt or 0.0) < (ask.knobs.dt or 0.0)]
    taken = (settled(adapter, scheme, posed.ask(k), found) for k in shorter)
    return None if any(one is None for one in taken) else run


def project_knobs(knobs: Knobs, scheme: Scheme, own: Collection[str] = ()) -> Knobs:
    """The knobs without those the scheme lacks, but for those that are put into the scene."""
    return Knobs(**{name: getattr(knobs, name) for name in {*scheme.knobs, *own}})

"""The plan of an invocation: its options and jobs; plans can be reduced and merged."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from vv.ask import Ask, Knobs, Method, Run
from vv.base.errors import UsageError
from vv.case import (
    Case,
    Level,
    Trial,
)
from vv.codes.adapter import Adapter, Found


@dataclass(frozen=True)
class Options:
    """Options of an invocation beside the selection of cases.

    codes: patterns CODE or CODE/SCHEME. settings: texts NAME=VALUE[UNIT] that change parameters.
    rungs: settings that replace those of the case, if there are any.
    """

    level: Level = Level.DEFAULT
    codes: tuple[str, ...] = ("*",)
    settings: tuple[str, ...] = ()
    rungs: tuple[Knobs, ...] = ()


@dataclass(frozen=True, eq=False)
class Job:
    """One ask to one scheme, with the case and variant that it comes from.

    changed: the names of the parameters that differ from their defaults. timed: whether timing
    sessions measure it. settle(): the outcome, if it is known without running, or None. inert: the
    changed parameters that the exact answer does not depend on, in words; empty if none.
    """

    case: str
    variant: str
    parameters: Mapping[str, float]
    changed: tuple[str, ...]
    code: str
    scheme: str
    method: Method
    ask: Ask
    timed: bool
    settle: Callable[[], Run | None]
    inert: str = ""

    @property
    def modified(self) -> bool:
        """Whether parameters differ from their defaults."""
        return bool(self.changed)

    @functools.cached_property
    def settled(self) -> Run | None:
        """The outcome if known without running, such as refused or not installed; else None."""
        return self.settle()

    def settle_as(self, outcome: Run | None) -> None:
        """Set the outcome that another process has determined."""
        vars(self)["settled"] = outcome

    @property
    def label(self) -> str:
        """The job as shown to people: case:variant code/scheme knobs."""
        knobs = ",".join(f"{k}={v:g}" for k, v in vars(self.ask.knobs).items() if v is not None)
        return f"{self.name} {knobs}".rstrip()

    @property
    def name(self) -> str:
        """The job without its setting: case:variant code/scheme."""
        return f"{self.case}:{self.variant} {self.code}/{self.scheme}"


class EmptyPlanError(UsageError):
    """The selection has no variant at the level asked for."""


@dataclass(frozen=True, eq=False)
class Plan:
    """The jobs of an invocation, with their cases, trials and adapters.

    trials: (case, variant) -> trial; found: code -> where it is, or how to install it.
    """

    jobs: tuple[Job, ...]
    cases: Mapping[str, Case]
    trials: Mapping[tuple[str, str], Trial]
    adapters: Mapping[str, Adapter]
    found: Mapping[str, Found]


def with_jobs_kept(plan: Plan, keep: Callable[[Job], bool]) -> Plan:
    """The plan with only the jobs for which keep(job) holds, and their cases and trials."""
    return _with_jobs(plan, tuple(job for job in plan.jobs if keep(job)))


def merge_plans(one: Plan, other: Plan) -> Plan:
    """The union of two plans of one project and the same parameters; `one` wins over `other`."""
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

"""Which jobs are refused is found on several cores, with the same outcome as on one."""

from __future__ import annotations

import dataclasses
import functools
import os
import time
from collections.abc import Callable

import pytest

from tests import ROOT
from vv.ask import Run, Status
from vv.base import parallel
from vv.plan import refusals
from vv.plan.plan import Job, Options
from vv.plan.planning import make_plan
from vv.plan.project import Project


def told(job: Job, here: int, only_here: bool = False) -> Run | None:
    """Who settles a job, as the reason why it is refused; every fifth is not refused."""
    if only_here and os.getpid() != here:
        os._exit(1)
    number = int(job.variant)
    return None if number % 5 == 0 else Run(Status.REFUSED, f"{number} by {os.getpid()}")


def jobs(count: int, how: Callable[[Job], Run | None]) -> list[Job]:
    """Jobs that `how` settles, by their numbers as the names of their variants."""
    like = make_plan(Project(ROOT), ["single-contact:T1"], Options(codes=("exact",))).jobs[0]
    made: list[Job] = []
    for number in range(count):
        job = dataclasses.replace(like, variant=str(number))
        object.__setattr__(job, "settle", functools.partial(how, job))
        made.append(job)
    return made


def reasons(made: list[Job]) -> list[str]:
    return ["" if job.settled is None else job.settled.reason for job in made]


@pytest.fixture
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Shared out from the second job on, whatever the first takes."""
    clock = iter(range(10**6))
    monkeypatch.setattr(parallel, "ALONE", 1.5)
    monkeypatch.setattr(time, "process_time", lambda: float(next(clock)))


@pytest.mark.usefixtures("at_once")
def test_outcomes_are_those_of_each_job_and_found_in_as_many_processes() -> None:
    made = jobs(20, functools.partial(told, here=os.getpid()))
    refusals.settle(made, 3)
    found = reasons(made)
    assert all(one.startswith(f"{n} by ") for n, one in enumerate(found) if n % 5)
    assert not any(found[::5])
    assert len({one.split()[-1] for one in found if one}) == 3


@pytest.mark.usefixtures("at_once")
def test_what_a_process_that_died_did_not_tell_is_found_here() -> None:
    made = jobs(20, functools.partial(told, here=os.getpid(), only_here=True))
    refusals.settle(made, 3)
    for job in made:
        object.__setattr__(job, "settle", None)  # nothing is left to be found
    assert {one.split()[-1] for one in reasons(made) if one} == {str(os.getpid())}


def test_a_few_quick_jobs_are_settled_here() -> None:
    made = jobs(20, functools.partial(told, here=os.getpid(), only_here=True))
    refusals.settle(made, 3)
    assert len([one for one in reasons(made) if one]) == 16

"""The quick level is small, but leaves no case and no scheme out."""

from collections import defaultdict

from tests import ROOT
from vv.case import Level
from vv.plan.plan import Job, Options, make_plan
from vv.plan.project import Project

PROJECT = Project(ROOT)


def steps(job: Job) -> int:
    """How many steps a job runs at: a search tries several."""
    return job.ask.search.tries if job.ask.search and job.ask.knobs.dt else 1


def test_every_case_and_scheme_that_does_not_refuse_has_two_rungs_at_the_quick_level() -> None:
    plan = make_plan(PROJECT, ["*"], Options(Level.QUICK))
    whole = make_plan(PROJECT, ["*"], Options(Level.DEFAULT))
    assert set(plan.cases) == set(PROJECT.case_names())
    rungs: dict[tuple[str, str, str], int] = defaultdict(int)
    for job in plan.jobs:
        if not (job.settled and job.settled.status.value == "refused"):
            rungs[job.case, f"{job.code}/{job.scheme}", job.variant] += steps(job)
    due = {
        (job.case, f"{job.code}/{job.scheme}")
        for job in whole.jobs
        if not (job.settled and job.settled.status.value == "refused")
    }
    knobs = {f"{a.name}/{s.name}": s.knobs for a in plan.adapters.values() for s in a.schemes}
    for case, label in due:
        most = max((n for (*pair, _), n in rungs.items() if pair == [case, label]), default=0)
        needed = 2 if knobs[label] else 1  # without a knob there is only one rung
        assert most >= needed, f"{case} runs {label} at {most} rungs at the quick level"

"""The quick level is small, but leaves no scheme out, and of cases only three with many spheres."""

from collections import defaultdict
from collections.abc import Callable

from tests import ROOT
from vv.case import Level
from vv.plan.plan import Job, Options
from vv.plan.planning import make_plan
from vv.plan.project import Project

PROJECT = Project(ROOT)
LARGE = {
    "column-collapse",
    "homogeneous-cooling",
    "hopper",
}  # seconds in each code


def steps(job: Job) -> int:
    """How many steps a job runs at: a search tries several."""
    return job.ask.search.tries if job.ask.search and job.ask.knobs.dt else 1


def rungs(level: Level, count: Callable[[Job], int]) -> dict[tuple[str, str], int]:
    """Of each case and scheme that does not refuse, the most rungs of a variant."""
    found: dict[tuple[str, str, str], int] = defaultdict(int)
    for job in make_plan(PROJECT, ["*"], Options(level)).jobs:
        if not (job.settled and job.settled.status.value == "refused"):
            found[job.case, f"{job.code}/{job.scheme}", job.variant] += count(job)
    most: dict[tuple[str, str], int] = defaultdict(int)
    for (case, label, _), own in found.items():
        most[case, label] = max(most[case, label], own)
    return most


def test_every_case_and_scheme_has_two_rungs_at_the_quick_level_or_all_it_has() -> None:
    quick, whole = rungs(Level.QUICK, steps), rungs(Level.DEFAULT, lambda _: 1)
    assert {case for case, _ in quick} == set(PROJECT.case_names()) - LARGE
    for (case, label), own in whole.items():
        if case in LARGE:
            continue
        there = quick[case, label]
        assert there >= min(own, 2), f"{case} runs {label} at {there} rungs at the quick level"

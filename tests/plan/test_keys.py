"""What a stored result is known by, part by part: a change of any of them asks anew."""

from __future__ import annotations

import dataclasses
import datetime
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests import ROOT
from vv.ask import Bracket, Knobs, Method
from vv.base.closure import source_digest
from vv.case import Level
from vv.codes.adapter import Found
from vv.plan import keys
from vv.plan.plan import Job, Options, Plan
from vv.plan.planning import make_plan
from vv.plan.project import Project
from vv.run import reuse

PROJECT = Project(ROOT)
PLAN = make_plan(PROJECT, ["single-contact:T1"], Options(Level.QUICK, ("dem/default",)))
JOB = PLAN.jobs[0]


def key_of(job: Job, plan: Plan = PLAN) -> tuple[str, str]:
    """The keys of the run and of the record of a job alone."""
    alone = dataclasses.replace(plan, jobs=(job,))
    runs = keys.run_keys(PROJECT, alone)
    return runs[0], keys.record_keys(PROJECT, alone, runs)[0]


def finer(job: Job) -> Any:
    return dataclasses.replace(job.ask, knobs=Knobs((job.ask.knobs.dt or 0.0) / 2))


@pytest.mark.parametrize("search", [None, Bracket(4.0, 1.0)])
def test_how_a_search_is_done_is_part_of_what_it_found_and_of_nothing_else(
    search: Bracket | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    job = dataclasses.replace(JOB, ask=dataclasses.replace(JOB.ask, search=search))
    before, whole = key_of(job), source_digest
    other = [keys.PACKAGE / "run" / "search.py"]
    monkeypatch.setattr(keys, "source_digest", lambda p: "other" if p == other else whole(p))
    assert (key_of(job) == before) is (search is None)


@pytest.mark.parametrize(
    ("change", "runs_anew"),
    [
        (lambda job: {"scheme": "published"}, True),
        (lambda job: {"code": "exact"}, True),
        (lambda job: {"ask": finer(job)}, True),
        (lambda job: {"ask": dataclasses.replace(job.ask, search=Bracket(4.0, 1.0))}, True),
        (lambda job: {"variant": "T2"}, False),
        (lambda job: {"parameters": {**job.parameters, "m": 3.0}}, False),
        (lambda job: {"method": Method.PENALTY}, False),
    ],
)
def test_what_a_solver_sees_runs_anew_and_what_judges_is_measured_anew(
    change: Callable[[Job], dict[str, Any]], runs_anew: bool
) -> None:
    plan = dataclasses.replace(PLAN, found={**PLAN.found, "exact": Found(True)})
    run, record = key_of(JOB, plan)
    other_run, other_record = key_of(dataclasses.replace(JOB, **change(JOB)), plan)
    assert (other_run != run) is runs_anew
    assert other_record != record


@pytest.mark.parametrize(
    ("name", "other"),
    [
        ("source_digest", lambda files: "other"),
        ("library_versions", lambda files: {"numpy": "0"}),
        ("executables", lambda project, found: {"/bin/x": "f00"}),
    ],
)
def test_a_code_is_its_sources_its_libraries_and_its_executables(
    name: str, other: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    before = keys.code_digest(PROJECT, Found(True), "dem")
    monkeypatch.setattr(keys, name, other)
    assert keys.code_digest(PROJECT, Found(True), "dem") != before


def test_a_program_that_changed_in_place_is_another(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = tmp_path / "program"
    found = Found(True, files=(program,))
    monkeypatch.setenv("VV_DATA", str(tmp_path / "data"))
    digests = []
    for text in ("one", "two"):  # of one size, and of one time as far as that can be set
        program.write_text(text)
        os.utime(program, (1, 1))
        digests.append(keys.executables(PROJECT, found)[str(program)])
    assert digests[0] != digests[1]


def test_what_stands_today_is_looked_at_anew_tomorrow() -> None:
    days = [datetime.date(2027, 1, day) for day in (1, 1, 2)]
    same, again, later = (reuse.identity(PROJECT, ("run",), day) for day in days)
    assert same == again != later

"""Checks that a case's reference imports no source of the codes that it judges."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping
from pathlib import Path

from vv.base.closure import import_closure
from vv.plan.keys import PACKAGE, roots
from vv.plan.plan import Plan
from vv.plan.project import Project
from vv.records.job_record import Record
from vv.records.outcomes import Verdict


def shared_sources(project: Project, plan: Plan) -> dict[tuple[str, str], Path]:
    """(case, code) -> a file that both import, if there is one.

    The modules of the framework do not count, but its engines do: a case that imports an engine
    would judge the engine by itself.
    """
    places = roots(project)
    codes = {
        code: {f for f in import_closure(project.adapter_files(code), places) if not _is_common(f)}
        for code in {job.code for job in plan.jobs}
    }
    found = {}
    case_files = project.case_files()
    for case in plan.cases:
        files = import_closure([case_files[case]], places)
        for code, own in codes.items():
            if common := own.intersection(files):
                found[case, code] = min(common)
    return found


def _is_common(file: Path) -> bool:
    """Whether cases and codes may both import a file: a part of vv outside the engines."""
    return PACKAGE in file.parents and PACKAGE / "engines" not in file.parents


def fail_dependent(
    records: Iterable[Record], common: Mapping[tuple[str, str], Path]
) -> list[Record]:
    """The records; they fail where the reference shares a source with the code that it judges."""
    return [
        _failed(record, common[pair]) if pair in common else record
        for record in records
        for pair in [(record.case, record.code)]
    ]


def _failed(record: Record, file: Path) -> Record:
    note = f"the reference and the code share the source file {file.name}"
    judged = (Verdict.PASS, Verdict.FAIL)
    quantities = tuple(
        dataclasses.replace(one, verdict=Verdict.FAIL, note=note) if one.verdict in judged else one
        for one in record.quantities
    )
    return dataclasses.replace(record, quantities=quantities)

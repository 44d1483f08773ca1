"""The answer of every scheme to a case: the number of unknowns of its model, or its refusal.

`vv accept` writes one file per case, `cases/answers/CASE.json`. Comparing with it shows whether a
change of a code or a scene lets a scheme run what it refused, or refuse what it ran. What is not in
the file, such as a new code or variant, is not compared.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from vv.ask import Status
from vv.base.errors import UsageError
from vv.base.files import write_whole
from vv.case import Level
from vv.plan.plan import Job, Options, Plan
from vv.plan.planning import make_plan
from vv.plan.project import Project
from vv.records.finding import NOTICE, Aspect, Bit, Finding
from vv.records.job_record import Record
from vv.records.reading import rung

NUMBER = re.compile(r"\d+(\.\d+)?(e[-+]?\d+)?")
Answers = dict[str, dict[str, int | str]]  # scheme -> variant -> unknowns, or why it refuses


def given(project: Project, case: str) -> Answers:
    """The answers of the schemes of all installed codes to a case, at every level.

    A scheme that runs one rung of a variant answers with its model. Codes that are not installed,
    which might refuse only when they run, are left out.
    """
    plan = make_plan(project, [case], Options(Level.PAPER))
    table: Answers = {}
    for job in plan.jobs:
        if not plan.found[job.code].installed:
            continue
        row = table.setdefault(f"{job.code}/{job.scheme}", {})
        if not isinstance(row.get(job.variant), int):
            row[job.variant] = _answer(plan, job)
    return table


def _answer(plan: Plan, job: Job) -> int | str:
    if job.settled is not None:
        return job.settled.reason
    return plan.adapters[job.code].describe(job.ask, job.scheme).unknowns


def accepted(project: Project, case: str) -> Answers | None:
    """The answers on record: the project's own, else those that came with the case, or None."""
    places = (_place(root, case) for root in project.roots)
    path = next((path for path in places if path.is_file()), None)
    if path is None:
        return None
    try:
        return _checked(json.loads(path.read_text(encoding="utf-8")))
    except (ValueError, RecursionError) as error:
        raise UsageError(f"{path}: {error}") from error


def _checked(found: object) -> Answers:
    """Stored answers; raises ValueError if they are invalid."""
    if not isinstance(found, dict):
        raise ValueError("it must be an object: scheme -> variant -> answer")
    for scheme, row in found.items():
        if not isinstance(row, dict):
            raise ValueError(f"{scheme!r} must be an object: variant -> answer")
        for variant, answer in row.items():
            if not isinstance(answer, int | str):
                raise ValueError(f"{scheme!r}, {variant!r}: an answer is a number or a reason")
    return found


def accept(project: Project, case: str) -> Path:
    """Store the present answers; those of codes that are not installed stay as they were."""
    absent = [n for n in project.adapter_names() if not project.load_adapter(n).found().installed]
    was = accepted(project, case) or {}
    kept = {name: row for name, row in was.items() if name.partition("/")[0] in absent}
    path = _place(project.root, case)
    text = json.dumps({**kept, **given(project, case)}, indent=1, sort_keys=True)
    write_whole(path, f"{text}\n".encode())
    return path


def _place(root: Path, case: str) -> Path:
    return root / "cases" / "answers" / f"{case}.json"


def compare(
    case: str, records: Sequence[Record], known: Answers, enforced: bool
) -> Iterator[Finding]:
    """Findings on what ran although stored as refused, and on refusals for a new reason.

    A result that is now refused is found by comparison with the baseline.
    """
    for record in records:
        was = known.get(record.label, {}).get(record.variant)
        if record.case != case or record.modified or not isinstance(was, str):
            continue
        if record.status is Status.RAN:
            text = f"was refused: {was}; to accept that it runs: vv accept {case} --reason ..."
            yield _finding(record, "no longer refused", text, Bit.ACCURACY, enforced)
        elif record.status is Status.REFUSED and _worded(record.reason) != _worded(was):
            text = f"was refused: {was}; now: {record.reason}"
            yield _finding(record, "refused otherwise", text, NOTICE, enforced)


def _worded(reason: str) -> str:
    """A reason without its numbers, such as that of a step, which differ between rungs."""
    return NUMBER.sub("#", reason)


def _finding(record: Record, kind: str, text: str, bit: Bit, enforced: bool) -> Finding:
    """A finding on a whole record."""
    return Finding(
        Aspect.REGRESSION, kind, text, record.case, record.variant, record.label, rung(record),
        bit=bit, enforced=enforced,
    )  # fmt: skip

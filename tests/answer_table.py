"""The committed table of what every scheme answers to every variant; run it to write it anew."""

import json
from pathlib import Path

from tests import ROOT
from vv.case import Level
from vv.plan.plan import Options, make_plan
from vv.plan.project import find

TABLE = ROOT / "tests" / "answers.json"


def answers() -> dict[str, dict[str, int | str]]:
    """Scheme -> variant -> unknowns of the model it builds, or why it refuses every rung."""
    project = find(Path(__file__))
    plan = make_plan(project, ["*"], Options(Level.PAPER))
    table: dict[str, dict[str, int | str]] = {}
    for job in plan.jobs:
        row = table.setdefault(f"{job.code}/{job.scheme}", {})
        refused = job.settled is not None and plan.found[job.code].installed
        model = plan.adapters[job.code].describe
        answer = job.settled.reason if job.settled and refused else None
        key = f"{job.case}:{job.variant}"
        if not isinstance(row.get(key), int):
            row[key] = answer or model(job.ask, job.scheme).unknowns
    return table


if __name__ == "__main__":
    TABLE.write_text(json.dumps(answers(), indent=1, sort_keys=True) + "\n")

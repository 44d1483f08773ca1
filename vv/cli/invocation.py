"""Carries out a plan as one invocation: progress, files, report, and the last line."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vv import screen
from vv.plan import Plan
from vv.project import Project
from vv.store import Store, deliver

if TYPE_CHECKING:
    from vv.session import Limits


def carried_out(
    project: Project, plan: Plan, limits: Limits, json_file: Path | None = None
) -> dict[str, Any]:
    """Carry out a plan, write records if asked to, and the report; returns the manifest."""
    from vv.session import Timing, carry_out

    with screen.progress(len(plan.jobs)) as shown:
        manifest = carry_out(project, plan, limits, shown, ["vv", *sys.argv[1:]])
    if json_file:
        from vv.export import full_records

        records = full_records(manifest, Store(project.data()))
        deliver(json_file, json.dumps({"records": records}, allow_nan=False).encode())
    drawing = limits.timing in (Timing.STORED, Timing.NEW)
    path = builder(project, drawing)(manifest, Store(project.data()), _report(project))
    screen.print_refusals(manifest["records"])
    screen.print_counts(manifest["records"], path)
    return manifest


def _report(project: Project) -> Path:
    return project.data() / "report.html"


def builder(project: Project, drawing: bool) -> Callable[[dict[str, Any], Store, Path], Path]:
    """What writes a report; without drawing, figures are left to `vv report`."""
    project.activate()
    from reports import html

    return html.build if drawing else html.build_quickly

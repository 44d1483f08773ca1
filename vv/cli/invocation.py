"""Carries out a plan as one invocation: progress, files, report, and the last line."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vv import screen
from vv.files import deliver
from vv.plan import Plan
from vv.progress import progress
from vv.project import Project
from vv.store import Store

if TYPE_CHECKING:
    from vv.session import Limits


def answered(
    project: Project,
    asked: tuple[object, ...],
    make_plan: Callable[[], Plan],
    limits: Limits,
    json_file: Path | None,
) -> dict[str, Any]:
    """As `carried_out`, but an invocation that stands unchanged is answered with its manifest.

    asked: frozen data that the plan is made of. How many processes may be used, and where else
    results are to be written, does not decide them.
    """
    from vv import standing
    from vv.session import Timing, now_utc

    store, report = Store(project.data()), _report(project)
    if limits.fresh or limits.timing is Timing.NEW:
        return carried_out(project, make_plan(), limits, json_file)

    def identity() -> str:
        demanded = (*asked, limits.timing)
        return standing.identity(project, demanded, now_utc().date(), limits.against)

    before = identity()
    manifest = standing.recall(store, before)
    if manifest is None:
        manifest = carried_out(project, make_plan(), limits, json_file)
    else:
        left = standing.untouched(store, before, report)
        if not left:
            _build(project, manifest, limits)
        _tell(project, manifest, json_file)
        screen.note(f"nothing has changed since {manifest['name']}")
        if left:
            return manifest
    if identity() == before:  # nobody edited anything meanwhile
        standing.remember(store, before, manifest, report)
    return manifest


def carried_out(
    project: Project, plan: Plan, limits: Limits, json_file: Path | None = None
) -> dict[str, Any]:
    """Carry out a plan, write records if asked to, and the report; returns the manifest."""
    from vv.session import carry_out

    with progress(len(plan.jobs)) as shown:
        manifest = carry_out(project, plan, limits, shown, ["vv", *sys.argv[1:]])
    _build(project, manifest, limits)
    _tell(project, manifest, json_file)
    return manifest


def _build(project: Project, manifest: dict[str, Any], limits: Limits) -> None:
    """Write the report, with all figures where everything that should be was timed."""
    from vv.session import MEASURED

    build = builder(project, limits.timing in MEASURED)
    build(manifest, Store(project.data()), _report(project))


def _tell(project: Project, manifest: dict[str, Any], json_file: Path | None) -> None:
    """Write the records if asked to, and say how it went."""
    if json_file:
        from vv.export import document

        told = document(manifest, Store(project.data()))
        deliver(json_file, json.dumps(told, allow_nan=False).encode())
    screen.print_refusals(manifest["records"])
    screen.print_counts(manifest["records"], _report(project))


def _report(project: Project) -> Path:
    return project.data() / "report.html"


def builder(project: Project, drawing: bool) -> Callable[[dict[str, Any], Store, Path], Path]:
    """What writes a report; without drawing, figures are left to `vv report`."""
    project.activate()
    from reports import html

    return html.build if drawing else html.build_quickly

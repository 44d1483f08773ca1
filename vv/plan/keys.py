"""The keys of stored results: a run by all a solver sees, a record by all that judges it."""

from __future__ import annotations

import platform
from pathlib import Path

import vv
from vv.base.closure import closure, libraries, source_digest
from vv.base.digest import digest
from vv.plan import imports
from vv.plan.plan import Plan
from vv.plan.project import Project
from vv.store.provenance import file_digests

PACKAGE = Path(vv.__file__).parent


def run_keys(project: Project, plan: Plan) -> dict[int, str]:
    """Job number -> key of its run: ask, scheme, sources, libraries and executables.

    What a search comes to depends on how it is done, too.
    """
    codes = {job.code for job in plan.jobs}
    prints = {code: code_digest(project, plan, code) for code in codes}
    searching = source_digest([PACKAGE / "run" / "search.py"])
    asks: dict[int, str] = {}
    found = {}
    for number, job in enumerate(plan.jobs):
        key = id(job.ask)
        asks[key] = asks.get(key) or job.ask.digest()
        how = "" if job.ask.search is None else searching
        found[number] = digest(asks[key], job.code, job.scheme, prints[job.code], how)
    return found


def record_keys(project: Project, plan: Plan, runs: dict[int, str]) -> dict[int, str]:
    """Job number -> key of its record: the run, the parameters, and the sources that judge."""
    prints = {name: case_digest(project, name) for name in plan.cases}
    return {
        number: digest(
            runs[number], job.case, job.variant, prints[job.case], job.parameters, job.method
        )
        for number, job in enumerate(plan.jobs)
    }


def code_digest(project: Project, plan: Plan, code: str) -> str:
    """Fingerprint of a code: import closure, what refuses for it, libraries, executable files."""
    files = [*project.adapter_files(code), PACKAGE / "codes" / "adapter.py"]
    sources = closure(files, roots(project))
    external = executables(project, plan, code)
    python = platform.python_version()
    return digest(source_digest(sources), libraries(sources), python, sorted(external.values()))


def executables(project: Project, plan: Plan, code: str) -> dict[str, str]:
    """Path -> digest of the files that a code's results depend on besides our sources."""
    return file_digests(plan.found[code].files, project.data() / "digests.json")


def case_digest(project: Project, case: str) -> str:
    """Fingerprint of what judges a case: its import closure and that of the measuring."""
    files = closure([project.case_file(case), PACKAGE / "records" / "record.py"], roots(project))
    return digest(source_digest(files), libraries(files))


def roots(project: Project) -> tuple[Path, ...]:
    """The folders below which a source is ours: the project's content, the tool's, the tool."""
    return project.root, imports.OWN, PACKAGE.parent

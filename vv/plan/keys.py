"""Keys of stored results: digests of all that a run, or the record of a run, depends on."""

from __future__ import annotations

import platform
from pathlib import Path

import vv
from vv.base.closure import import_closure, library_versions, source_digest
from vv.base.digest import digest
from vv.codes.adapter import Found
from vv.plan import imports
from vv.plan.plan import Plan
from vv.plan.project import Project
from vv.store.provenance import file_digests

PACKAGE = Path(vv.__file__).parent
MEASURING = (PACKAGE / "records" / "record.py", PACKAGE / "records" / "checking.py")


def run_keys(project: Project, plan: Plan) -> dict[int, str]:
    """Job number -> key of its run: ask, scheme, sources, libraries and executables.

    The key of a search also contains the source of the search.
    """
    prints = code_digests(project, plan)
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
    """Job number -> key of its record: the run, parameters, class of method and case's sources."""
    places, files = roots(project), project.case_files()
    prints = {name: case_digest(files[name], places) for name in plan.cases}
    return {
        number: digest(
            runs[number], job.case, job.variant, prints[job.case], job.parameters, job.method
        )
        for number, job in enumerate(plan.jobs)
    }


def code_digests(project: Project, plan: Plan) -> dict[str, str]:
    """Code -> its digest, for the codes that a plan has jobs of."""
    codes = {job.code for job in plan.jobs}
    return {code: code_digest(project, plan.found[code], code) for code in codes}


def code_digest(project: Project, found: Found, code: str) -> str:
    """Digest of a code: sources of the adapter and all it imports, libraries, executables."""
    files = [*project.adapter_files(code), PACKAGE / "codes" / "adapter.py"]
    sources = import_closure(files, roots(project))
    external = executables(project, found)
    python = platform.python_version()
    return digest(
        source_digest(sources), library_versions(sources), python, sorted(external.values())
    )


def executables(project: Project, found: Found) -> dict[str, str]:
    """Path -> digest of the files of an external code that its results depend on."""
    return file_digests(found.files, project.data() / "digests.json")


def case_digest(case: Path, places: tuple[Path, ...]) -> str:
    """Digest of what judges a case: sources of its file and of the measuring, and libraries."""
    files = import_closure([case, *MEASURING], places)
    return digest(source_digest(files), library_versions(files))


def roots(project: Project) -> tuple[Path, ...]:
    """The folders that hold our sources: the project, the bundled content, and vv itself."""
    return project.root, imports.OWN, PACKAGE.parent

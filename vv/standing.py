"""Whether an invocation stands already: the same words, sources, programs, machine and day."""

from __future__ import annotations

import datetime
import os
import platform
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from vv import imports
from vv.ask import Status
from vv.closure import CONTENT, source_digest
from vv.content import written
from vv.digest import digest
from vv.project import Project
from vv.provenance import commit, machine
from vv.store import Store

LASTING = {status.name.lower().replace("_", "-") for status in (Status.RAN, Status.REFUSED)}
SEEN = (
    "PATH",
    "PYTHON",
    "VV_",
    "LD_",
    "NUMBA_",
    "OMP",
    "MKL_",
    "OPENBLAS_",
)  # what decides results


def identity(
    project: Project, words: Sequence[str], today: datetime.date, against: Path | None = None
) -> str:
    """The digest of all that goes into an invocation; coarser than the keys of single results.

    So a repeated invocation costs the reading of its sources, whatever the number of its jobs.
    against: a folder of baselines that it is judged by.
    """
    adapters = [project.load_adapter(name) for name in project.adapter_names()]
    found = {adapter.name: adapter.found() for adapter in adapters}
    files = sorted({file for one in found.values() for file in one.files})
    return digest(
        list(words),
        str(Path.cwd()),
        {name: value for name, value in os.environ.items() if name.startswith(SEEN)},
        [[name, one.installed, one.version] for name, one in sorted(found.items())],
        [[str(file), *_state(file)] for file in files],
        source_digest(_sources(project)),
        source_digest(sorted(against.glob("*.json"))) if against else "",
        _libraries(),
        list(commit(project.root)),
        machine(),
        today.isoformat(),
    )


def remember(store: Store, identity: str, manifest: dict[str, Any], report: Path) -> None:
    """Note what an invocation came to, unless something in it may go better another time."""
    if {record["status"] for record in manifest["records"]} <= LASTING:
        store.keep_answer(
            _key(store, identity), {"manifest": manifest["name"], "report": _state(report)}
        )


def recall(store: Store, identity: str, report: Path) -> dict[str, Any] | None:
    """The manifest of an invocation that stands, with its report as it was left; else None."""
    answer = store.answer(_key(store, identity))
    if answer is None or answer["report"] != _state(report):
        return None
    try:
        return {**store.manifest(answer["manifest"]), "name": answer["manifest"]}
    except OSError:
        return None


def _key(store: Store, identity: str) -> str:
    """The identity and the timing session of now, which the invocation itself may have made."""
    return digest(identity, (store.last_timings() or ("", {}))[0])


def _sources(project: Project) -> list[Path]:
    folders = [Path(imports.__file__).parent]
    folders += [root / name for root in {project.root, imports.OWN} for name in CONTENT]
    return [
        path
        for folder in dict.fromkeys(folders)
        for path in folder.rglob("*")
        if path.is_file() and written(path, folder)
    ]


def _libraries() -> list[str]:
    """Python, and what is installed beside it: the names of the folders say the versions."""
    places = {Path(place) for place in sys.path if place.endswith("site-packages")}
    names = {path.name for place in places for path in place.glob("*.dist-info")}
    return [platform.python_version(), sys.prefix, *sorted(names)]


def _state(path: Path) -> list[int]:
    """Size and times of change of a file, which cannot be set back; empty where there is none."""
    try:
        state = path.stat()
    except OSError:
        return []
    return [state.st_size, state.st_mtime_ns, state.st_ctime_ns]

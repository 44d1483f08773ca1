"""Reuses an earlier invocation if nothing has changed that its results depend on."""

from __future__ import annotations

import dataclasses
import datetime
import functools
import hashlib
import os
import platform
import sys
from collections.abc import Iterator, Sequence
from importlib import metadata
from pathlib import Path

from vv.ask import Status
from vv.base.closure import CONTENT_PACKAGES
from vv.base.digest import digest
from vv.plan import imports
from vv.plan.content import written
from vv.plan.keys import PACKAGE
from vv.plan.project import Project
from vv.records.job_record import Record
from vv.records.manifest import Answer, Manifest, PrintedOutput
from vv.records.outcomes import StudyKind
from vv.store.checkout import commit
from vv.store.provenance import machine, provenance, run_name
from vv.store.store import Store

LASTING = {Status.RAN, Status.REFUSED, Status.TOO_LONG, Status.NOT_INSTALLED}
SEEN = (
    "PATH",
    "PYTHON",
    "VV_",
    "LD_",
    "NUMBA_",
    "OMP",
    "MKL_",
    "OPENBLAS_",
)  # variables that affect results


def identity(
    project: Project, asked: tuple[object, ...], today: datetime.date, against: Path | None = None
) -> str:
    """The digest of everything that the results of an invocation depend on.

    A repeated invocation then only reads its sources, whatever the number of jobs. The commit is
    left out: if all files are the same, so are the results. asked: frozen data, the selection and
    options. against: the folder of baselines to judge by.
    """
    adapters = [project.load_adapter(name) for name in project.adapter_names()]
    found = {adapter.name: adapter.found() for adapter in adapters}
    files = sorted({file for one in found.values() for file in one.files})
    return digest(
        asked,
        str(Path.cwd()),
        {name: value for name, value in os.environ.items() if name.startswith(SEEN)},
        [[name, one.installed, one.version] for name, one in sorted(found.items())],
        [[str(file), *_state(file)] for file in files],
        _sources(project),
        {path.name: _content(path) for path in against.glob("*.json")} if against else "",
        _libraries(),
        machine(),
        today.isoformat(),
    )


def remember(store: Store, identity: str, manifest: Manifest) -> None:
    """Store the manifest of an invocation for reuse, unless a repetition may give a better one.

    It may if a job crashed, or if a timing session has gaps, which are timed again.
    """
    if all(map(is_reusable, manifest.records)) and not manifest.untimed:
        store.keep_answer(_key(store, identity), Answer(manifest.name, digest(store.state())))


def is_reusable(record: Record) -> bool:
    """Whether a record may be reused while nothing changes; in a map blow-ups are results."""
    status = record.status
    return status in LASTING or (status is Status.DIVERGED and record.study is StudyKind.GRID)


def recall(store: Store, identity: str) -> Manifest | None:
    """The manifest stored for this identity; None if it or some of its series are missing."""
    answer = store.answer(_key(store, identity))
    if answer is None:
        return None
    try:
        manifest = store.manifests.read(answer.manifest)
    except OSError:
        return None
    if answer.records == digest(store.state()):
        return manifest
    measured = (record for record in manifest.records if record.quantities)
    kept = all(store.series(one.key, one.quantities) is not None for one in measured)
    return manifest if kept else None  # `--json` writes them out


def of_this_commit(
    project: Project, store: Store, identity: str, found: Manifest, command: Sequence[str]
) -> Manifest:
    """The reused manifest, stored again under the present commit if it is of another one."""
    if (found.provenance.commit, found.provenance.dirty) == commit(project.root):
        return found
    now = datetime.datetime.now(datetime.UTC)
    name, origin = run_name(now), provenance(project.root, command, now)
    store.manifests.keep_renamed(found.name, name, origin)
    store.keep_answer(_key(store, identity), Answer(name, digest(store.state())))
    return dataclasses.replace(found, name=name, provenance=origin)


def keep_output(store: Store, identity: str, manifest: str, printed: PrintedOutput) -> None:
    """Store the output of an invocation if its manifest is the one stored for this identity."""
    answer = store.answer(_key(store, identity))
    if answer is not None and answer.manifest == manifest:
        again = dataclasses.replace(answer, printed=printed)
        store.keep_answer(_key(store, identity), again)


def output_of(
    project: Project, store: Store, identity: str, report: Path, required: tuple[str, ...]
) -> tuple[str, PrintedOutput] | None:
    """The name and the printed output of the reusable manifest; None if files have changed.

    Output of another commit is not reused, since the report names the commit.
    """
    answer = store.answer(_key(store, identity))
    if answer is None or answer.printed is None:
        return None
    if answer.printed.of != output_key(store, answer.manifest, report, required):
        return None
    origin = store.manifests.head(answer.manifest)[1]
    same = (origin.commit, origin.dirty) == commit(project.root)
    return (answer.manifest, answer.printed) if same else None


def output_key(store: Store, manifest: str, report: Path, required: tuple[str, ...]) -> str:
    """The digest of what the output describes: manifest, report, records, required codes."""
    states = _state(store.manifests.file(manifest)), _state_of_all(report), store.state()
    return digest(states, required)


def note_report(store: Store, name: str, report: Path) -> None:
    """Store the states of the files of a report, so that later changes are noticed."""
    store.keep_answer(digest("report", name), Answer(report=_state_of_all(report)))


def untouched(store: Store, name: str, report: Path) -> bool:
    """Whether the report in the folder is that of the manifest, and unchanged."""
    answer = store.answer(digest("report", name))
    return answer is not None and answer.report == _state_of_all(report)


def _key(store: Store, identity: str) -> str:
    """The key of an identity; it depends on the last timing session too."""
    return digest(identity, store.last_session())


def _sources(project: Project) -> dict[str, str]:
    """Path -> digest of every source file of vv and of the project."""
    roots = dict.fromkeys((project.root, imports.OWN))
    folders = [
        ("vv", PACKAGE),
        *((f"{i}/{c}", r / c) for i, r in enumerate(roots) for c in CONTENT_PACKAGES),
    ]
    return {
        f"{name}/{path.relative_to(folder)}": _content(path)
        for name, folder in folders
        for path in _files(folder)
        if written(path, folder)
    }


def _content(path: Path) -> str:
    """The digest of a file, read anew each time: it may be edited during an invocation."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _files(folder: Path) -> Iterator[Path]:
    """All files below a folder, also those of folders it links to, each folder once."""
    seen = set()
    for place, below, names in os.walk(folder, followlinks=True):
        real = os.path.realpath(place)
        if real in seen:
            below.clear()  # a link to a parent folder would never end
            continue
        seen.add(real)
        yield from (Path(place, name) for name in names if os.path.isfile(Path(place, name)))


@functools.cache
def _libraries() -> list[str]:
    """The versions of Python and of all packages that are installed."""
    installed = {f"{one.name} {one.version}" for one in metadata.distributions()}
    return [platform.python_version(), sys.prefix, *sorted(installed)]


def _state_of_all(folder: Path) -> tuple[int, ...]:
    """The states of all files of a folder; empty if there are none."""
    return tuple(number for path in sorted(folder.glob("*")) for number in _state(path))


def _state(path: Path) -> tuple[int, ...]:
    """Size and times of change of a file; empty if it does not exist."""
    try:
        state = path.stat()
    except OSError:
        return ()
    return state.st_size, state.st_mtime_ns, state.st_ctime_ns

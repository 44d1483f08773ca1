"""Where a result comes from: commit, machine, versions, command, time."""

from __future__ import annotations

import datetime
import functools
import hashlib
import os
import platform
import shlex
from collections.abc import Iterable, Sequence
from importlib import metadata
from pathlib import Path

import vv
from vv.base.digest import digest
from vv.base.files import read_whole, write_whole
from vv.records import codec
from vv.records.manifest import Machine, Provenance
from vv.store.checkout import commit
from vv.store.seal import opened_text, sealed_text

LIBRARIES = ("numpy", "scipy", "numba")


def run_name(now: datetime.datetime) -> str:
    """The name in the store of a run made now; names sort by time."""
    return f"{now:%Y%m%dT%H%M%S.%f}Z-{os.getpid()}"


def provenance(root: Path, command: Sequence[str], now: datetime.datetime) -> Provenance:
    """The circumstances of a result: commit, machine, versions, command and time."""
    revision, dirty = commit(root)
    return Provenance(
        utc=now.isoformat(timespec="seconds"),
        commit=revision,
        dirty=dirty,
        command=shlex.join(command),
        machine=machine(),
        versions={"vv": vv.__version__, "python": platform.python_version(), **_versions()},
        threads=1,
    )


@functools.cache
def machine() -> Machine:
    """The processor, its cores and the system; times of different machines are never mixed."""
    return Machine(
        processor=_processor(),
        cores=os.cpu_count(),
        system=f"{platform.system()} {platform.release()}",
        fingerprint=digest(_processor(), os.cpu_count(), platform.node())[:12],
    )


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.machine()


def _versions() -> dict[str, str]:
    found = {}
    for library in LIBRARIES:
        try:
            found[library] = metadata.version(library)
        except metadata.PackageNotFoundError:
            continue
    return found


def file_digests(files: Iterable[Path], memory: Path) -> dict[str, str]:
    """SHA-256 of large files, remembered in `memory` by path, size and time of change.

    The time is that of the inode: unlike that of the content it cannot be set back.
    """
    try:
        text = opened_text(memory.name, read_whole(memory).decode())
        known = codec.read(dict[str, str], codec.parse(text), "digests")
    except (OSError, ValueError):
        known = {}
    found = {}
    for path in files:
        state = path.stat()
        label = f"{path} {state.st_size} {state.st_ctime_ns}"
        if label not in known:
            known[label] = hashlib.sha256(path.read_bytes()).hexdigest()
            text = sealed_text(memory.name, codec.render(known, indent=0, sort_keys=True))
            write_whole(memory, text.encode())
        found[str(path)] = known[label]
    return found

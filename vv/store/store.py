"""Stores runs and records under digests of all that they depend on, and manifests by name.

Every file is written beside its place and renamed, so that a killed process leaves whole files
or none, and two processes at once at worst write the same file twice. Every file is sealed with a
digest of its place and content: what is damaged or got into the wrong place is named and answers
nothing. Nothing that is read is code.
"""

from __future__ import annotations

import contextlib
import errno
import functools
import hashlib
import io
import os
import shutil
import tempfile
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TextIO, TypeVar

import numpy as np

from vv.ask import Run, Status
from vv.base.files import opened, read_whole, write_whole
from vv.base.notices import notice
from vv.records import codec
from vv.records.fields import SPREAD
from vv.records.job_record import Record, RunSummary
from vv.records.manifest import Answer, Manifest, Provenance, TimedRun
from vv.records.quantity import MeasuredQuantity
from vv.scene import Vector
from vv.store import manifest
from vv.store.array_files import arrays_in
from vv.store.run_arrays import arrays_of, run_from
from vv.store.seal import opened_bytes, opened_text, sealed_bytes, sealed_text
from vv.store.series_check import check_series

Found = TypeVar("Found")
Session = dict[str, TimedRun]  # what a timing session measured, by the keys of the runs
DAY = 86400.0  # s, by which clocks of machines may differ
STALE = 7 * DAY  # s that the logs of a failure are kept
ABSENT = (FileNotFoundError, NotADirectoryError)
UNREADABLE = (OSError, ValueError, KeyError, TypeError)


@dataclass(frozen=True, slots=True)
class _Kept:
    """The stored summary of a record, and the key it belongs to."""

    run: RunSummary = field(metadata={SPREAD: True})  # its fields stand beside the key
    key: str


@dataclass(frozen=True)
class Store:
    """The folder of stored results. No file in it is changed in place."""

    root: Path

    def run(self, key: str) -> Run | None:
        """The stored run of that key; None if there is none or it cannot be read."""
        try:
            return run_from(self._arrays("runs", key), key)
        except ABSENT:
            return None
        except UNREADABLE as error:
            self._passed_over("runs", key, "npz", error)
            return None

    def has_run(self, key: str) -> bool:
        """Whether something is stored as the run of that key."""
        return self._path("runs", key, "npz").is_file()

    def keep_run(self, key: str, run: Run) -> None:
        """Store a run that ran; failures are never kept."""
        if run.status is Status.RAN:
            self._keep_arrays("runs", key, arrays_of(run, key))

    def summary(self, key: str) -> RunSummary | None:
        """The measured summary stored under a record's key; None if there is none."""
        kept = self._read(_Kept, "records", key)
        if kept and kept.key != key:
            self._passed_over("records", key, "json", ValueError(f"it is of the key {kept.key}"))
            return None
        return kept.run if kept else None

    def keep_summary(self, key: str, run: RunSummary, series: Mapping[str, Vector]) -> None:
        """Store the measured summary of a run, and the arrays of its series."""
        self._keep_arrays("records", key, series)
        self._write("records", key, _Kept(run, key))

    def series(self, key: str, quantities: Iterable[MeasuredQuantity]) -> dict[str, Vector] | None:
        """The arrays kept beside a record, of which its quantities were measured.

        None if there are none, or if they are not those of the quantities.
        """
        try:
            arrays = self._arrays("records", key)
            check_series(arrays, quantities)
        except ABSENT:
            return None
        except UNREADABLE as error:
            self._passed_over("records", key, "npz", error)
            return None
        return arrays

    def series_of(self, records: Iterable[Record]) -> Callable[[str], Mapping[str, Vector]]:
        """Reads the arrays kept beside these records, by key; empty where there are none."""
        measured = {one.key: one.quantities for one in records}
        return functools.cache(lambda key: self.series(key, measured[key]) or {})

    def keep_manifest(self, what: Manifest) -> None:
        """Store the manifest of an invocation under its name; names sort by time."""
        write_whole(self.manifest_file(what.name), manifest.render(what).encode())

    def keep_renamed(self, old: str, name: str, provenance: Provenance) -> None:
        """Store a past invocation again, as one of that name and provenance; raises OSError."""
        text = self._of_manifest(
            old, lambda file: manifest.renamed(file.read(), old, name, provenance)
        )
        write_whole(self.manifest_file(name), text.encode())

    def manifests(self) -> list[str]:
        """The names of past invocations, oldest first.

        One whose name lies in the future, which would stay the latest until then, is none.
        """
        names = sorted(path.stem for path in (self.root / "manifests").glob("*.json"))
        tomorrow = time.strftime("%Y%m%dT%H%M%S", time.gmtime(time.time() + DAY))
        for name in names:
            if name > tomorrow:
                notice(f"past run {name}: its time has not come; passed over")
        return [name for name in names if name <= tomorrow]

    def manifest(self, name: str) -> Manifest:
        """A past invocation; raises FileNotFoundError with the name, OSError if it is damaged."""
        return self._of_manifest(name, lambda file: manifest.whole(file.read(), name))

    def manifest_file(self, name: str) -> Path:
        """Where a past invocation is stored."""
        return self.root / "manifests" / f"{name}.json"

    def state(self) -> tuple[int, ...]:
        """Sizes and times of change of all stored records: any change of a file changes one."""
        folders = [place for place in self.root.glob("records/*") if place.is_dir()]
        files = sorted(
            (one.name, one.stat(follow_symlinks=False))
            for place in folders
            for one in os.scandir(place)
        )
        return tuple(n for _, s in files for n in (s.st_size, s.st_mtime_ns, s.st_ctime_ns))

    def latest(self) -> Manifest | None:
        """The newest past invocation that can be read, or None; damaged ones are named."""
        for name in reversed(self.manifests()):
            if found := self.newest_of([name], notice):
                return found[0]
        return None

    def newest(self, most: int, passed_over: Callable[[str], None]) -> list[Manifest]:
        """The newest past invocations, newest first; `passed_over` is called for damaged ones."""
        return self.newest_of(self.manifests()[-most:], passed_over)

    def newest_of(self, names: Sequence[str], passed_over: Callable[[str], None]) -> list[Manifest]:
        """The readable ones of these past invocations, newest first; names: oldest first."""
        found = []
        for name in reversed(names):
            try:
                found.append(self.manifest(name))
            except OSError as error:
                passed_over(f"past run {name}: {error.strerror}; passed over")
        return found

    def head(self, name: str) -> tuple[tuple[str, ...], Provenance]:
        """The cases a past invocation holds, and its provenance; raises as `manifest`."""
        return self._of_manifest(name, lambda file: manifest.head(file, name))

    def records_of(self, name: str, case: str) -> tuple[Record, ...]:
        """The records of one case in a past invocation; raises as `manifest`."""
        return self.reader(name)(case)

    def digests_of(self, name: str) -> dict[str, str]:
        """Case -> digest of its records in a past invocation; empty if it cannot be read.

        For who has read it whole and so knows that it is undamaged.
        """
        path = self.manifest_file(name)
        try:
            return dict(_digests_in(path, path.stat().st_mtime_ns))
        except OSError:
            return {}

    def reader(self, name: str) -> Callable[[str], tuple[Record, ...]]:
        """Reads the records of a case in a past invocation; raises as `manifest`."""
        lines = self._of_manifest(name, list)
        path = self.manifest_file(name)
        return lambda case: _undamaged(path, lambda: manifest.records(iter(lines), case, name))

    def timings(self, session: str) -> Session | None:
        """The timing session of this digest of what was timed and on which machine."""
        return self._read(Session, "timings", session)

    def keep_timings(self, session: str, timings: Session) -> None:
        """Store a timing session."""
        self._write("timings", session, timings)

    def last_session(self) -> str:
        """The name of the newest timing session; empty if there is none."""
        found = (self.root / "timings").glob("*/*.json")
        files = sorted(found, key=lambda path: path.lstat().st_mtime_ns)
        return files[-1].stem if files else ""

    def answer(self, key: str) -> Answer | None:
        """What is kept of an invocation under the digest of all it depends on."""
        return self._read(Answer, "answers", key)

    def keep_answer(self, key: str, answer: Answer) -> None:
        """Keep the manifest's name and printed output of an invocation for reuse."""
        self._write("answers", key, answer)

    def facts(self, kind: type[Found], key: str) -> Found | None:
        """Facts derived from results, under the digest of all they were derived from."""
        return self._read(kind, "facts", key)

    def keep_facts(self, key: str, facts: object) -> None:
        """Store facts derived from results."""
        self._write("facts", key, facts)

    def scratch(self) -> Path:
        """A new, empty folder for one worker."""
        (self.root / "scratch").mkdir(parents=True, exist_ok=True)
        return Path(tempfile.mkdtemp(dir=self.root / "scratch"))

    def clear_scratch(self) -> None:
        """Remove what workers that failed, or were killed, left behind long ago."""
        for folder in (self.root / "scratch").glob("*"):
            with contextlib.suppress(OSError):
                if time.time() - folder.stat().st_mtime > STALE:
                    shutil.rmtree(folder, ignore_errors=True)

    def _of_manifest(self, name: str, read: Callable[[TextIO], Found]) -> Found:
        path = self.manifest_file(name)
        if not path.exists() and not path.is_symlink():
            raise FileNotFoundError(f"no run '{name}' in {path.parent}")
        with io.TextIOWrapper(opened(path), encoding="utf-8") as file:
            return _undamaged(path, lambda: read(file))

    def _read(self, kind: type[Found], layer: str, key: str) -> Found | None:
        """The content of a file; None if it is missing or damaged."""
        try:
            whole = read_whole(self._path(layer, key, "json")).decode()
            text = opened_text(f"{layer}/{key}", whole)
            return codec.read(kind, codec.parse(text), layer)
        except ABSENT:
            return None
        except (OSError, ValueError) as error:
            self._passed_over(layer, key, "json", error)
            return None

    def _passed_over(self, layer: str, key: str, suffix: str, error: Exception) -> None:
        """Say that a file is damaged; what it held is made again."""
        why = error.strerror if isinstance(error, OSError) else error
        notice(f"{self._path(layer, key, suffix)}: {why}; passed over, and made again")

    def _write(self, layer: str, key: str, what: object) -> None:
        text = sealed_text(f"{layer}/{key}", codec.render(what))
        self._put(self._path(layer, key, "json"), text.encode())

    def _arrays(self, layer: str, key: str) -> dict[str, Any]:
        return arrays_in(self._opened(layer, key))

    def _opened(self, layer: str, key: str) -> bytes:
        return opened_bytes(f"{layer}/{key}", read_whole(self._path(layer, key, "npz")))

    def _keep_arrays(self, layer: str, key: str, arrays: Mapping[str, Any]) -> None:
        buffer = io.BytesIO()
        np.savez(buffer, **arrays)
        content = sealed_bytes(f"{layer}/{key}", buffer.getvalue())
        self._put(self._path(layer, key, "npz"), content)

    def _put(self, path: Path, content: bytes) -> None:
        """Write a file; a folder that stands in its place is moved to scratch."""
        if path.is_dir():
            path.rename(self.scratch() / path.name)
        write_whole(path, content)

    def _path(self, layer: str, key: str, suffix: str) -> Path:
        return self.root / layer / key[:2] / f"{key}.{suffix}"


@functools.lru_cache(maxsize=4)
def _digests_in(path: Path, changed: int) -> dict[str, str]:  # tells files apart
    with io.TextIOWrapper(opened(path), encoding="utf-8") as file:
        lines = _undamaged(path, lambda: manifest.lines_of(file))
    return {case: hashlib.sha256(line.encode()).hexdigest() for case, line in lines.items()}


def _undamaged(path: Path, read: Callable[[], Found]) -> Found:
    """What is read of a manifest; raises OSError where that is damaged."""
    try:
        return read()
    except (ValueError, TypeError) as error:
        raise OSError(errno.EIO, f"no whole manifest: {error}", str(path)) from error

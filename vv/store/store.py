"""Stores runs, records and facts, each under a digest of all that it depends on.

Every file is written under a temporary name and renamed, so that a killed process leaves complete
files or none; two processes at once at worst write the same file twice. Every file is sealed with a
digest of its path and content: a file that is damaged or in the wrong place is reported and not
used. No file that is read contains code.
"""

from __future__ import annotations

import contextlib
import functools
import io
import os
import shutil
import tempfile
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from vv.ask import Run, Status
from vv.base.files import read_whole, write_whole
from vv.base.notices import notice
from vv.records import codec
from vv.records.fields import SPREAD
from vv.records.job_record import Record, RunSummary
from vv.records.manifest import Answer, TimedRun
from vv.records.quantity import MeasuredQuantity
from vv.scene import Vector
from vv.store.array_files import arrays_in
from vv.store.manifests import Manifests
from vv.store.run_arrays import arrays_of, run_from
from vv.store.seal import opened_bytes, opened_text, sealed_bytes, sealed_text
from vv.store.series_check import check_series

Found = TypeVar("Found")
Session = dict[str, TimedRun]  # the measurements of a timing session, by the keys of the runs
STALE = 7 * 86400.0  # s for which the logs of a failure are kept
ABSENT = (FileNotFoundError, NotADirectoryError)
UNREADABLE = (OSError, ValueError, KeyError, TypeError)


@dataclass(frozen=True, slots=True)
class _Kept:
    """The stored summary of a record, and the key it belongs to."""

    run: RunSummary = field(metadata={SPREAD: True})  # its fields are written beside the key
    key: str


@dataclass(frozen=True)
class Store:
    """The folder of stored results. No file in it is changed in place."""

    root: Path

    @property
    def manifests(self) -> Manifests:
        """The manifests of past invocations."""
        return Manifests(self.root / "manifests")

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
        """Whether a run of that key is stored; the file is not checked."""
        return self._path("runs", key, "npz").is_file()

    def keep_run(self, key: str, run: Run) -> None:
        """Store a run that reached its end; failures are never stored."""
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
        """The stored series of a record, from which its quantities were measured.

        None if there are none, or if they do not agree with the quantities.
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
        """A function that returns the series of one of these records by its key; empty if none."""
        measured = {one.key: one.quantities for one in records}
        return functools.cache(lambda key: self.series(key, measured[key]) or {})

    def state(self) -> tuple[int, ...]:
        """Sizes and change times of all stored records; they show any change of a file."""
        folders = [place for place in self.root.glob("records/*") if place.is_dir()]
        files = sorted(
            (one.name, one.stat(follow_symlinks=False))
            for place in folders
            for one in os.scandir(place)
        )
        return tuple(n for _, s in files for n in (s.st_size, s.st_mtime_ns, s.st_ctime_ns))

    def timings(self, session: str) -> Session | None:
        """The timing session with this digest of the timed runs and the machine."""
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
        """The stored answer to an invocation, by the digest of its inputs; None if none."""
        return self._read(Answer, "answers", key)

    def keep_answer(self, key: str, answer: Answer) -> None:
        """Store the answer to an invocation, so that it can be reused."""
        self._write("answers", key, answer)

    def facts(self, kind: type[Found], key: str) -> Found | None:
        """The stored facts derived from results, by the digest of their sources; None if none."""
        return self._read(kind, "facts", key)

    def keep_facts(self, key: str, facts: object) -> None:
        """Store facts derived from results."""
        self._write("facts", key, facts)

    def scratch(self) -> Path:
        """A new, empty folder for one worker."""
        (self.root / "scratch").mkdir(parents=True, exist_ok=True)
        return Path(tempfile.mkdtemp(dir=self.root / "scratch"))

    def clear_scratch(self) -> None:
        """Remove old files of workers that failed or were killed."""
        for folder in (self.root / "scratch").glob("*"):
            with contextlib.suppress(OSError):
                if time.time() - folder.stat().st_mtime > STALE:
                    shutil.rmtree(folder, ignore_errors=True)

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
        """Print a notice that a file is damaged, and ignored."""
        why = error.strerror if isinstance(error, OSError) else error
        notice(f"{self._path(layer, key, suffix)}: {why}; it is ignored and made again")

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

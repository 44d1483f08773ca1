"""Keeps results on disk: runs by what a solver sees, records by what judges them, manifests.

Every file is written beside its place and renamed, so that a killed process leaves whole files
or none, and two processes at once at worst write the same file twice. A run and a record name
the key they belong to, so that a file that got into the wrong place answers nothing.
"""

from __future__ import annotations

import contextlib
import dataclasses
import errno
import io
import json
import shutil
import tempfile
import time
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TextIO, TypeVar

import numpy as np

from vv.ask import (
    Cost,
    Displacement,
    Ledger,
    Model,
    Observable,
    Reaction,
    Run,
    Status,
    Strain,
    Velocity,
)
from vv.base.files import write_whole
from vv.scene import Form, Term, Vector
from vv.store import manifest

Found = TypeVar("Found")
STALE = 7 * 86400.0  # s that the logs of a failure are kept
UNREADABLE = (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile)
OBSERVABLES: Mapping[str, type[Displacement | Velocity | Reaction | Strain]] = {
    kind.__name__: kind for kind in (Displacement, Velocity, Reaction, Strain)
}


@dataclass(frozen=True)
class Store:
    """The folder of generated things. Nothing in it is ever changed in place."""

    root: Path

    def run(self, key: str) -> Run | None:
        """The stored run of that key; None if there is none or it cannot be read."""
        try:
            arrays = self._arrays("runs", key)
            meta = json.loads(str(arrays["meta"]))
            return _run_from(meta, arrays) if meta["key"] == key else None
        except UNREADABLE:
            return None

    def has_run(self, key: str) -> bool:
        """Whether something is stored as the run of that key."""
        return self._path("runs", key, "npz").is_file()

    def keep_run(self, key: str, run: Run) -> None:
        """Store a run that ran; failures are never kept."""
        if run.status is Status.RAN:
            arrays = {f"value{i}": value for i, value in enumerate(run.values.values())}
            arrays |= {f"energy {form.name}": value for form, value in run.energies.items()}
            meta = np.array(_meta(run, key))
            self._keep_arrays(
                "runs", key, {"meta": meta, "t": run.times, "tried": run.tried, **arrays}
            )

    def record(self, key: str) -> dict[str, Any] | None:
        """The stored record of that key, without its series; None if there is none."""
        found = self._json("records", key)
        return found if found and found.pop("key", None) == key else None

    def keep_record(
        self, key: str, record: Mapping[str, Any], series: Mapping[str, Vector]
    ) -> None:
        """Store a record, and beside it the arrays of its series."""
        self._keep_arrays("records", key, series)
        text = json.dumps({**record, "key": key}, allow_nan=False)
        write_whole(self._path("records", key, "json"), text.encode())

    def series(self, key: str) -> dict[str, Vector]:
        """The arrays kept beside a record; empty if there are none."""
        try:
            return self._arrays("records", key)
        except UNREADABLE:
            return {}

    def has_series(self, key: str) -> bool:
        """Whether there is a file of the arrays kept beside a record."""
        return self._path("records", key, "npz").is_file()

    def keep_manifest(self, name: str, what: Mapping[str, Any]) -> None:
        """Store what one invocation did under a name that sorts by time."""
        write_whole(self._manifest(name), manifest.render(what).encode())

    def manifests(self) -> list[str]:
        """The names of past invocations, oldest first."""
        return sorted(path.stem for path in (self.root / "manifests").glob("*.json"))

    def manifest(self, name: str) -> dict[str, Any]:
        """A past invocation; raises FileNotFoundError with the name, OSError if it is damaged."""
        return self._of_manifest(name, lambda file: manifest.whole(file.read()))

    def newest(self, most: int) -> list[dict[str, Any]]:
        """The newest past invocations, newest first; what is damaged is passed over."""
        found = []
        for name in reversed(self.manifests()[-most:]):
            with contextlib.suppress(OSError):
                found.append(self.manifest(name))
        return found

    def head(self, name: str) -> tuple[list[str], dict[str, Any]]:
        """The cases a past invocation holds, and its provenance; raises as `manifest`."""
        return self._of_manifest(name, manifest.head)

    def records_of(self, name: str, case: str) -> list[dict[str, Any]]:
        """The records of one case in a past invocation; raises as `manifest`."""
        return self._of_manifest(name, lambda file: manifest.records(file, case))

    def timings(self, session: str) -> dict[str, Any] | None:
        """A timing session, by the digest of what it timed and where."""
        return self._json("timings", session)

    def keep_timings(self, session: str, timings: Mapping[str, Any]) -> None:
        """Store a timing session."""
        write_whole(self._path("timings", session, "json"), json.dumps(timings).encode())

    def last_timings(self) -> tuple[str, dict[str, Any]] | None:
        """The newest timing session and its name; None if there is none."""
        files = sorted((self.root / "timings").glob("*/*.json"), key=lambda p: p.stat().st_mtime_ns)
        stored = self.timings(files[-1].stem) if files else None
        return (files[-1].stem, stored) if stored else None

    def answer(self, key: str) -> dict[str, Any] | None:
        """What is noted of an invocation, by the digest of all it depends on."""
        return self._json("answers", key)

    def keep_answer(self, key: str, answer: Mapping[str, Any]) -> None:
        """Note what an invocation came to."""
        write_whole(self._path("answers", key, "json"), json.dumps(answer).encode())

    def scratch(self) -> Path:
        """A new, empty folder for one worker."""
        (self.root / "scratch").mkdir(parents=True, exist_ok=True)
        return Path(tempfile.mkdtemp(dir=self.root / "scratch"))

    def templates(self) -> Path:
        """Where the report's templates are kept compiled."""
        folder = self.root / "templates"
        folder.mkdir(parents=True, exist_ok=True)
        return folder

    def clear_scratch(self) -> None:
        """Remove what workers that failed, or were killed, left behind long ago."""
        for folder in (self.root / "scratch").glob("*"):
            with contextlib.suppress(OSError):
                if time.time() - folder.stat().st_mtime > STALE:
                    shutil.rmtree(folder, ignore_errors=True)

    def _manifest(self, name: str) -> Path:
        return self.root / "manifests" / f"{name}.json"

    def _of_manifest(self, name: str, read: Callable[[TextIO], Found]) -> Found:
        path = self._manifest(name)
        if not path.is_file():
            raise FileNotFoundError(f"no run '{name}' in {path.parent}")
        try:
            with path.open(encoding="utf-8") as file:
                return read(file)
        except ValueError as error:
            raise OSError(errno.EIO, f"no whole manifest: {error}", str(path)) from error

    def _json(self, layer: str, key: str) -> dict[str, Any] | None:
        try:
            return dict(json.loads(self._path(layer, key, "json").read_text()))
        except (OSError, ValueError):
            return None

    def _arrays(self, layer: str, key: str) -> dict[str, Any]:
        path = self._path(layer, key, "npz")
        with path.open("rb") as file, np.load(file, allow_pickle=False) as arrays:
            return dict(arrays)

    def _keep_arrays(self, layer: str, key: str, arrays: Mapping[str, Any]) -> None:
        buffer = io.BytesIO()
        np.savez(buffer, **arrays)
        write_whole(self._path(layer, key, "npz"), buffer.getvalue())

    def _path(self, layer: str, key: str, suffix: str) -> Path:
        return self.root / layer / key[:2] / f"{key}.{suffix}"


def _meta(run: Run, key: str) -> str:
    """All of a run but its arrays, as JSON, and the key it belongs to."""
    model = run.model and {
        "unknowns": run.model.unknowns,
        "terms": sorted(term.name for term in run.model.terms),
        "note": run.model.note,
    }
    ledger = run.ledger and dataclasses.asdict(run.ledger)
    observables = [[type(o).__name__, o.body] for o in run.values]
    cost = dataclasses.asdict(run.cost)
    parts = {"observables": observables, "cost": cost, "model": model, "ledger": ledger}
    return json.dumps({**parts, "steps": run.steps, "reason": run.reason, "key": key})


def _run_from(meta: dict[str, Any], arrays: dict[str, Vector]) -> Run:
    model, ledger = meta["model"], meta["ledger"]
    if model:
        model = Model(**{**model, "terms": frozenset(Term[name] for name in model["terms"])})
    values: dict[Observable, Vector] = {
        OBSERVABLES[kind](body): arrays[f"value{i}"]
        for i, (kind, body) in enumerate(meta["observables"])
    }
    return Run(
        Status.RAN,
        meta["reason"],
        times=arrays["t"],
        values=values,
        cost=Cost(**meta["cost"]),
        steps=meta["steps"],
        model=model,
        ledger=Ledger(**ledger) if ledger else None,
        energies={form: arrays[name] for form in Form if (name := f"energy {form.name}") in arrays},
        tried=arrays["tried"],
    )

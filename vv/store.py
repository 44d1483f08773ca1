"""Keeps results on disk: runs by what a solver sees, records by what judges them, manifests.

Every file is written beside its place and renamed, so that a killed process leaves whole files
or none, and two processes at once at worst write the same file twice.
"""

from __future__ import annotations

import dataclasses
import io
import json
import os
import tempfile
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from vv.ask import Cost, Displacement, Ledger, Model, Observable, Run, Status, Velocity
from vv.scene import Term, Vector

UNREADABLE = (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile)
OBSERVABLES: Mapping[str, type[Displacement] | type[Velocity]] = {
    kind.__name__: kind for kind in (Displacement, Velocity)
}


@dataclass(frozen=True)
class Store:
    """The folder of generated things. Nothing in it is ever changed in place."""

    root: Path

    def run(self, key: str) -> Run | None:
        """The stored run of that key; None if there is none or it cannot be read."""
        try:
            arrays = self._arrays("runs", key)
            return _run_from(json.loads(str(arrays["meta"])), arrays)
        except UNREADABLE:
            return None

    def keep_run(self, key: str, run: Run) -> None:
        """Store a run that ran; failures are never kept."""
        if run.status is Status.RAN:
            arrays = {f"value{i}": value for i, value in enumerate(run.values.values())}
            self._keep_arrays("runs", key, {"meta": np.array(_meta(run)), "t": run.times, **arrays})

    def record(self, key: str) -> dict[str, Any] | None:
        """The stored record of that key, without its series; None if there is none."""
        return self._json("records", key)

    def keep_record(
        self, key: str, record: Mapping[str, Any], series: Mapping[str, Vector]
    ) -> None:
        """Store a record, and beside it the arrays of its series."""
        self._keep_arrays("records", key, series)
        write(self._path("records", key, "json"), json.dumps(record, allow_nan=False).encode())

    def series(self, key: str) -> dict[str, Vector]:
        """The arrays kept beside a record; empty if there are none."""
        try:
            return self._arrays("records", key)
        except UNREADABLE:
            return {}

    def keep_manifest(self, name: str, manifest: Mapping[str, Any]) -> None:
        """Store what one invocation did under a name that sorts by time."""
        text = json.dumps(manifest, allow_nan=False)
        write(self.root / "manifests" / f"{name}.json", text.encode())

    def manifests(self) -> list[str]:
        """The names of past invocations, oldest first."""
        return sorted(path.stem for path in (self.root / "manifests").glob("*.json"))

    def manifest(self, name: str) -> dict[str, Any]:
        """A past invocation; raises FileNotFoundError with the name."""
        path = self.root / "manifests" / f"{name}.json"
        if not path.is_file():
            raise FileNotFoundError(f"no run '{name}' in {path.parent}")
        return dict(json.loads(path.read_text()))

    def timings(self, session: str) -> dict[str, Any] | None:
        """A timing session, by the digest of what it timed and where."""
        return self._json("timings", session)

    def keep_timings(self, session: str, timings: Mapping[str, Any]) -> None:
        """Store a timing session."""
        write(self._path("timings", session, "json"), json.dumps(timings).encode())

    def scratch(self) -> Path:
        """A new, empty folder for one worker."""
        (self.root / "scratch").mkdir(parents=True, exist_ok=True)
        return Path(tempfile.mkdtemp(dir=self.root / "scratch"))

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
        write(self._path(layer, key, "npz"), buffer.getvalue())

    def _path(self, layer: str, key: str, suffix: str) -> Path:
        return self.root / layer / key[:2] / f"{key}.{suffix}"


def write(path: Path, content: bytes) -> None:
    """Put a whole file in its place in one step."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=".part-")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


def _meta(run: Run) -> str:
    """All of a run but its arrays, as JSON."""
    model = run.model and {
        "unknowns": run.model.unknowns,
        "terms": sorted(term.name for term in run.model.terms),
        "note": run.model.note,
    }
    ledger = run.ledger and {**dataclasses.asdict(run.ledger), "terms": dict(run.ledger.terms)}
    observables = [[type(o).__name__, o.body] for o in run.values]
    cost = dataclasses.asdict(run.cost)
    parts = {"observables": observables, "cost": cost, "model": model, "ledger": ledger}
    return json.dumps({**parts, "steps": run.steps})


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
        times=arrays["t"],
        values=values,
        cost=Cost(**meta["cost"]),
        steps=meta["steps"],
        model=model,
        ledger=Ledger(**ledger) if ledger else None,
    )

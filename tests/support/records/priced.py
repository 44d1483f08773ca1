"""Records and manifests of runs with a step, an error and a cost, made up for tests."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any

from tests.support import fabricated
from vv.insight.effort import Effort, efforts
from vv.records.job_record import Record
from vv.records.manifest import CodeFound, Manifest

Row = tuple[float | None, float | None, float | None, float | None]  # dt, kn, error, cpu


def record(code: str, row: Row, variant: str = "a", final: float = 1.0, **changes: Any) -> Record:
    dt, kn, error, cpu = row
    figures = {"final": final + (error or 0.0)}
    seen = fabricated.entry("pass", {"max": error}, figures=figures, end=1.0)
    spent = fabricated.cost(timed=cpu is not None, cpu=1e-3 if cpu is None else cpu)
    session = changes.pop("session", "one")
    return fabricated.record(
        f"{code}/default",
        variant,
        dt,
        case="made-up",
        rung={"dt": dt, "kn": kn},
        quantities=[seen],
        cost=dataclasses.replace(spent, session=session),
        **changes,
    )


def manifest(*records: Record) -> Manifest:
    files = {"theirs": {"/usr/bin/theirs": "digest"}}
    codes = {r.code: CodeFound("1", True, files.get(r.code, {})) for r in records}
    return fabricated.manifest(*records, codes=codes)


def one(rows: Sequence[Row], code: str = "ours") -> Effort:
    (found,) = efforts(manifest(*(record(code, row) for row in rows)))
    return found


SECOND = [(h, None, 100 * h * h, 1e-7 / h) for h in (1e-2, 1e-3, 1e-4)]

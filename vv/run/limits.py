"""Limits of an invocation: processes, seconds for a job, use of the store, what is timed."""

from __future__ import annotations

import enum
from dataclasses import dataclass
from pathlib import Path

from vv.run.executor import LOCAL


class Timing(enum.Enum):
    """Where timed costs come from: nowhere, the last session, one that is stored, or a new one."""

    NONE = enum.auto()
    LAST = enum.auto()
    STORED = enum.auto()
    NEW = enum.auto()


MEASURED = (Timing.STORED, Timing.NEW)  # where all that is to be timed should be


@dataclass(frozen=True)
class Limits:
    """How many processes, how many seconds for a job, and whether stored results are used.

    against: the folder of baselines that every result must have one in; None: the project's
    own, where a result without one is only noted. executor: `local`, or dask://HOST:PORT, the
    scheduler of a cluster that answers what is not stored.
    """

    workers: int
    timeout: float
    fresh: bool = False
    timing: Timing = Timing.NONE
    against: Path | None = None
    executor: str = LOCAL

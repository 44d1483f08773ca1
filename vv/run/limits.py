"""Limits of an invocation: processes, seconds for a job, use of the store, what is timed.

It also says that an ask had no answer in time, and finds those that cannot have one.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass
from pathlib import Path

from vv.ask import Ask, Run, Status

LOCAL = "local"  # the executor on this machine

# A velocity needs the last position, and a position the last velocity: a step is at least two
# multiplications with additions one after the other, of four cycles each, 1.3 ns at 6 GHz.
LEAST_STEP = 1e-9  # s


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


def late(ask: Ask, timeout: float) -> str:
    """Why an ask had no answer: the number of its steps, if it is known, and the limit [s]."""
    steps = _steps(ask)
    taken = f" for {steps:.3g} steps of {ask.dt:g} s" if steps else ""
    return f"no answer in time, --timeout {timeout:g} s{taken}"


def hopeless(ask: Ask, timeout: float) -> Run | None:
    """The timeout of an ask with more steps than fit into that time [s]; None if they may fit."""
    if _steps(ask) * LEAST_STEP <= timeout:
        return None
    return Run(Status.TIMEOUT, f"{late(ask, timeout)}; not begun, since a step takes over 1 ns")


def _steps(ask: Ask) -> int:
    """Number of steps of an ask; 0 where there is no step, or where a search chooses it."""
    known = ask.knobs.dt is not None and ask.search is None
    return ask.goal.steps(ask.dt) if known else 0

"""Compares speeds with accepted ones, as ratios to a calibration kernel of the same session.

No absolute time is ever judged. The kernel is a chain of dependent additions in numpy's compiled
loop: like the stepping loop of a small scene, it waits for one floating-point unit.
"""

from __future__ import annotations

import time
from collections.abc import Sequence

import numpy as np

from vv.codes import timed
from vv.gate.baseline import name_of
from vv.records.accepted import Baseline
from vv.records.finding import Aspect, Bit, Change, Finding
from vv.records.job_record import Record
from vv.records.reading import rung

TERMS = np.full(200_000, 1.0)
REPEATS = 5
TICKING = 0.04  # CPU seconds of repeats where the clock ticks: ten ticks of 4 ms
# two sessions on a busy machine differed by 1.05 at most in 52 ratios, the two rounds of one by
# 1.04 but in two of 76: 1.5 between intervals is no noise, and no absolute claim either
FACTOR = 1.5
ELSEWHERE = 3.0  # another processor's memory and units differ too; a guess, not measured


def calibration() -> float:
    """CPU seconds of the calibration kernel: the least of a few, about a millisecond each.

    In a process with a limit of CPU time the clock ticks (see `timed`) and the least is often 0:
    there the kernel is repeated until the clock has moved enough for a mean.
    """
    seen = []
    for _ in range(REPEATS):
        begun = time.process_time()
        _kernel()
        seen.append(time.process_time() - begun)
    return min(seen) or timed(_kernel, TICKING)[1].solve_cpu


def _kernel() -> None:
    np.cumsum(TERMS)


def compare(
    case: str,
    records: Sequence[Record],
    baseline: Baseline | None,
    processor: str,
    enforced: bool,
) -> list[Finding]:
    """Results of a case that became slower or faster than accepted, beyond noise.

    A ratio is an interval over rounds; only intervals that differ by more than the factor count.
    enforced: the ratios are of a new session, and the case enforces speed.
    """
    if baseline is None:
        return []
    given = [r for r in records if r.case == case and not r.modified]
    found = (_moved(record, baseline, processor, enforced) for record in given)
    return [finding for finding in found if finding]


def _moved(record: Record, baseline: Baseline, processor: str, enforced: bool) -> Finding | None:
    """The finding on a timed record; None if the change is within the factor, or not known."""
    then, now = baseline.results.get(name_of(record)), record.cost.relative
    if then is None or then.cost is None or now is None:
        return None
    same = baseline.acceptances[then.by].machine.processor == processor
    factor = FACTOR if same else ELSEWHERE
    change, size = _change(then.cost, now, factor)
    if change is None:
        return None
    text = (
        f"solve takes {now[0]:.3g} to {now[1]:.3g} calibration kernels, accepted "
        f"{then.cost[0]:.3g} to {then.cost[1]:.3g}; factor {factor:g} allowed "
        f"on {'the same' if same else 'another'} processor"
    )
    return Finding(
        check=Aspect.SPEED,
        kind=change.value,
        text=text,
        case=record.case,
        variant=record.variant,
        label=record.label,
        rung=rung(record),
        bit=Bit.SPEED if change is Change.SLOWER else Bit(0),
        enforced=enforced,
        size=size,
    )


def _change(
    then: Sequence[float], now: Sequence[float], factor: float
) -> tuple[Change | None, float]:
    if now[0] > factor * then[1]:
        return Change.SLOWER, now[0] / then[1]
    if now[1] * factor < then[0]:
        return Change.FASTER, then[0] / now[1]
    return None, 0.0

"""Speed, as a ratio to a calibration kernel timed in the same session, against what was accepted.

No absolute time is ever judged. The kernel is a chain of dependent additions in numpy's compiled
loop: like the stepping loop of a small scene, it waits for one floating-point unit.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from vv.gate.baseline import name_of
from vv.records.finding import Bit, Finding
from vv.records.reading import label, rung

TERMS = np.full(200_000, 1.0)
REPEATS = 5
# two sessions on a busy machine differed by 1.05 at most in 52 ratios, the two rounds of one by
# 1.04 but in two of 76: 1.5 between intervals is no noise, and no absolute claim either
FACTOR = 1.5
ELSEWHERE = 3.0  # another processor's memory and units differ too; a guess, not measured


def calibration() -> float:
    """CPU seconds of the calibration kernel: the least of a few, about a millisecond each."""
    seen = []
    for _ in range(REPEATS):
        begun = time.process_time()
        np.cumsum(TERMS)
        seen.append(time.process_time() - begun)
    return min(seen)


def compare(
    case: str,
    records: Sequence[Mapping[str, Any]],
    baseline: Mapping[str, Any] | None,
    processor: str,
    enforced: bool,
) -> list[Finding]:
    """Which results of a case became slower or faster than accepted, beyond what noise explains.

    A ratio is an interval over rounds; only intervals apart by more than the factor count.
    enforced: the ratios are of a new session, and the case does not take speed lightly.
    """
    if baseline is None:
        return []
    timed = [r for r in records if r["case"] == case and r["cost"].get("relative")]
    found = (_moved(r, baseline, processor, enforced) for r in timed if not r["modified"])
    return [finding for finding in found if finding]


def _moved(
    record: Mapping[str, Any], baseline: Mapping[str, Any], processor: str, enforced: bool
) -> Finding | None:
    """What there is to say of a timed record; None within the factor, or without a ratio to it."""
    then, now = baseline["results"].get(name_of(record), {}), record["cost"]["relative"]
    if "cost" not in then:
        return None
    same = baseline["acceptances"][then["by"]]["machine"]["processor"] == processor
    factor = FACTOR if same else ELSEWHERE
    kind, size = _change(then["cost"], now, factor)
    text = (
        f"solve takes {now[0]:.3g} to {now[1]:.3g} calibration kernels, accepted "
        f"{then['cost'][0]:.3g} to {then['cost'][1]:.3g}; factor {factor:g} allowed "
        f"on {'the same' if same else 'another'} processor"
    )
    finding = Finding(
        check="speed",
        kind=kind,
        text=text,
        case=record["case"],
        variant=record["variant"],
        label=label(record),
        rung=rung(record),
        bit=Bit.SPEED if kind == "slower" else Bit(0),
        enforced=enforced,
        size=size,
    )
    return finding if kind else None


def _change(then: Sequence[float], now: Sequence[float], factor: float) -> tuple[str, float]:
    if now[0] > factor * then[1]:
        return "slower", now[0] / then[1]
    if now[1] * factor < then[0]:
        return "faster", then[0] / now[1]
    return "", 0.0

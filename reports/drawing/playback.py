"""The motion of each scheme beside the exact one, as data that the page's script plays."""

from __future__ import annotations

import json
from collections.abc import Sequence

import numpy as np

from reports.drawing.collect import History
from vv.base.metrics import Vector
from vv.records.case_facts import VariantFacts

FRAMES = 40
PARTS = 1000  # of the exact motion, to which all motions are told: pixels show no more
FAR = 9.0  # times the exact motion: beyond it a code is only far away

Places = list[int | None] | int


def playback(curves: Sequence[History], facts: VariantFacts) -> str:
    """JSON of the frames; empty where nothing moves or there is no exact motion."""
    exact = next((h for h in curves if h.reference is not None), None)
    if exact is None or exact.reference is None or len(exact.t) < 4 or not facts.quantities:
        return ""
    size = float(np.nanmax(np.abs(exact.reference)))
    if not size > 0 or not np.isfinite(size):
        return ""
    frames = np.linspace(exact.t[0], exact.t[-1], min(FRAMES, len(exact.t)))
    first = facts.quantities[0]
    right = _parts(np.interp(frames, exact.t, exact.reference), size)
    codes = {h.mark.label: [h.mark.colour, _beside(right, h, frames, size)] for h in curves}
    parts = {
        "name": f"{first.symbol} [{first.unit}]" if first.unit else first.symbol,
        "size": float(f"{size:.4g}"),
        "ends": [float(f"{t:.6g}") for t in (exact.t[0], exact.t[-1])],
        "exact": right,
        "codes": codes,
    }
    text = json.dumps(parts, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("&", "\\u0026").replace(">", "\\u003e")


def _beside(right: Sequence[int | None], one: History, frames: Vector, size: float) -> Places:
    """The places of a scheme; 0 where it is never a pixel off the exact one."""
    found = _parts(np.interp(frames, one.t, one.value), size)
    pairs = zip(found, right, strict=True)
    near = all(a is not None and b is not None and abs(a - b) <= 1 for a, b in pairs)
    return 0 if near else found


def _parts(values: Vector, size: float) -> list[int | None]:
    """Values in parts of their size; None where one is not finite."""
    shown = np.clip(values / size, -FAR, FAR) * PARTS
    return [round(value) if np.isfinite(value) else None for value in shown.tolist()]

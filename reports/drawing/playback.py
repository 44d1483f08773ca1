"""The motion of each scheme beside the exact one, as data that the page's script plays."""

from __future__ import annotations

import json
from collections.abc import Sequence

import numpy as np

from reports.drawing.collect import History
from vv.base.metrics import Vector
from vv.records.case_facts import VariantFacts

FRAMES = 40
DIGITS = 3
FAR = 9.0  # times the exact motion: beyond it a code is only far away


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
    parts = {
        "name": f"{first.symbol} [{first.unit}]" if first.unit else first.symbol,
        "size": float(f"{size:.4g}"),
        "t": _rounded(frames, 1.0),
        "exact": _rounded(np.interp(frames, exact.t, exact.reference), size),
        "codes": {
            h.mark.label: [h.mark.colour, _rounded(np.interp(frames, h.t, h.value), size)]
            for h in curves
        },
    }
    text = json.dumps(parts, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("&", "\\u0026").replace(">", "\\u003e")


def _rounded(values: Vector, size: float) -> list[float | None]:
    """Values over their size, to as many digits as pixels show."""
    return [
        float(f"{value:.{DIGITS}g}") if np.isfinite(value) else None
        for value in np.clip(values / size, -FAR, FAR).tolist()
    ]

"""Writes the elements of drawings as short SVG."""

from __future__ import annotations

import functools
import math

import numpy as np
from markupsafe import Markup, escape

from vv.base.metrics import Vector

BUCKETS = 48  # of a curve, each with its lowest and highest point: pixels show no more
ROUGH = 18  # of an error over time, the noise of which says how large it is and no more
FEW, SLACK = 20, 0.3  # points that are all kept, and how far off a line may pass [px]


def number(value: float) -> str:
    """A coordinate with one digit after the point."""
    text = f"{value:.1f}"
    return text.removesuffix(".0") if text != "-0.0" else "0"


def path(x: Vector, y: Vector) -> str:
    """A path through points in relative coordinates, broken at points that are not finite."""
    parts: list[str] = []
    before: tuple[int, int] | None = None
    for px, py in zip(x.tolist(), y.tolist(), strict=True):
        if not math.isfinite(px + py):
            before = None
            continue
        here = round(px * 10), round(py * 10)
        if before is None:
            parts.append(f"M{_tenth(here[0])}{_joined(here[1], _tenth(here[0]))}l")
        elif here != before:
            across, up = here[0] - before[0], here[1] - before[1]
            parts.append(f"{_joined(across, parts[-1])}{_joined(up, _tenth(across))}")
        before = here
    return "".join(parts).replace("l ", "l").replace("lM", "M").removesuffix("l")


@functools.lru_cache(maxsize=8192)
def _tenth(tenths: int) -> str:
    """A number of tenths as the shortest decimal."""
    whole, rest = divmod(abs(tenths), 10)
    sign = "-" if tenths < 0 else ""
    return f"{sign}{whole or ('' if rest else 0)}{f'.{rest}' if rest else ''}"


def _joined(tenths: int, before: str) -> str:
    """As `_tenth`, with the blank that a number needs behind what ends with another.

    None stands before a sign, nor before a point where the other number has one already.
    """
    text = _tenth(tenths)
    ends = text[0] == "-" or (text[0] == "." and before[-2:-1] == ".")
    return text if ends else f" {text}"


def thinned(x: Vector, y: Vector, buckets: int = BUCKETS) -> tuple[Vector, Vector]:
    """The drawn points of a curve; of many points, the extremes of each bucket."""
    if len(x) <= 2 * buckets:
        ascends = len(x) > FEW and bool((np.diff(x) > 0).all())
        return straightened(x, y) if ascends else (x, y)
    kept = {0, len(x) - 1}
    for part in np.array_split(np.arange(len(x)), buckets):
        finite = part[np.isfinite(y[part])]
        if len(finite):
            kept |= {int(finite[y[finite].argmin()]), int(finite[y[finite].argmax()])}
    order = sorted(kept)
    return straightened(x[order], y[order])


def straightened(x: Vector, y: Vector) -> tuple[Vector, Vector]:
    """The points that a line needs to stay within SLACK above or below all of them.

    x ascends. From the point kept last a cone of slopes is narrowed, until one leaves it.
    """
    kept, low, high = [0], -math.inf, math.inf
    for i, (px, py) in enumerate(zip(x[1:].tolist(), y[1:].tolist(), strict=True), 1):
        run, rise = px - float(x[kept[-1]]), py - float(y[kept[-1]])
        if not (run > 0 and low * run <= rise <= high * run):
            kept += [i - 1] * (kept[-1] < i - 1)
            run, rise, low, high = px - float(x[i - 1]), py - float(y[i - 1]), -math.inf, math.inf
        if run > 0 and math.isfinite(rise):
            low, high = max(low, (rise - SLACK) / run), min(high, (rise + SLACK) / run)
        else:
            low, high = math.inf, -math.inf
    order = [*kept, len(x) - 1]
    return x[order], y[order]


def placed(x: Vector, y: Vector) -> str:
    """A line through places, all as they are; one place has a line of no length to itself."""
    spots = [f"{number(px)} {number(py)}" for px, py in zip(x.tolist(), y.tolist(), strict=True)]
    return f"M{' '.join(spots)}{'h0' if len(spots) == 1 else ''}"


def text(x: float, y: float, content: str, kind: str = "") -> str:
    """A text at a place; kind: its class."""
    shown = f' class="{escape(kind)}"' if kind else ""
    return f'<text x="{number(x)}" y="{number(y)}"{shown}>{escape(content)}</text>'


def title(content: str) -> str:
    """The tooltip of an element."""
    return f"<title>{escape(content)}</title>"


def drawing(
    width: float, height: float, parts: list[str], kind: str = "chart", attributes: str = ""
) -> Markup:
    """The parts as one picture, hidden from screen readers, for which a text stands beside it.

    attributes: attributes that say more of it to the page's script.
    """
    box = f"0 0 {number(width)} {number(height)}"
    head = f'<svg class="{escape(kind)}"{attributes} viewBox="{box}" aria-hidden="true">'
    return Markup(f"{head}{''.join(parts)}</svg>")

"""Data with which the page's script animates the motion of each scheme and the exact one."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from reports.drawing.collect import History
from vv.base.metrics import Vector
from vv.output.gallery.scene_drawing import SCALE
from vv.records.case_facts import VariantFacts
from vv.scene.picture.moved import Moved

FRAMES = 40
PARTS = 1000  # fraction of the exact motion to which motions are rounded: less than a pixel
FAR = 9.0  # multiple of the exact motion at which motions are cut off
FEW = 12  # the most quantities that move bodies; more are not played
SMALL, SEEN, LARGE = 12.0, 40.0, 100.0  # pixels of the drawing: motions of others are scaled

Places = list[int | None] | int
Over = Mapping[str, Sequence[History]]  # quantity -> its history in each scheme


@dataclass(frozen=True)
class _Exact:
    """The exact history of a quantity at the frames, in units of its largest value."""

    name: str
    size: float
    parts: list[int | None]


def playback(over: Over, facts: VariantFacts) -> str:
    """JSON of the frames; empty where nothing moves or there is no exact motion.

    over: of the first quantity, and of those that move a body. What bodies do stands beside it.
    """
    frames = _frames(over)
    if frames is None:
        return ""
    exact = {name: one for name in over if (one := _exact(name, over[name], frames, facts))}
    if not exact:
        return ""
    moved = {name: one for name, one in (facts.moved or {}).items() if name in exact}
    factor = _factor(moved, exact, facts)
    codes: dict[str, tuple[int, list[Places]]] = {}
    for name, one in exact.items():
        for h in over[name]:
            row = codes.setdefault(h.mark.label, (h.mark.colour, [0] * len(exact)))
            row[1][[*exact].index(name)] = _beside(one, h, frames)
    parts = {
        "ends": [float(f"{t:.6g}") for t in (frames[0], frames[-1])],
        "exact": [[one.name, float(f"{one.size:.4g}"), one.parts] for one in exact.values()],
        "codes": codes,
        "moves": [
            _move(move, [*exact].index(name), exact[name].size, factor, facts)
            for name, move in moved.items()
        ],
        "drawn": _in_words(factor) if moved else "",
    }
    text = json.dumps(parts, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("&", "\\u0026").replace(">", "\\u003e")


def moving(facts: VariantFacts) -> list[str]:
    """The animated quantities: the first, and those that move a body."""
    names = [q.name for q in facts.quantities[:1]]
    return [*dict.fromkeys([*names, *[*(facts.moved or {})][:FEW]])]


def _frames(over: Over) -> Vector | None:
    """The times [s] of the frames, at outputs of the first history that has an exact one."""
    long = (h.t for row in over.values() for h in row if h.reference is not None and len(h.t) > 3)
    t = next(long, None)
    return None if t is None else np.linspace(t[0], t[-1], min(FRAMES, len(t)))


def _exact(name: str, row: Sequence[History], frames: Vector, facts: VariantFacts) -> _Exact | None:
    one = next((h for h in row if h.reference is not None and len(h.t) > 3), None)
    if one is None or one.reference is None:
        return None
    size = float(np.nanmax(np.abs(one.reference)))
    if not (size > 0 and math.isfinite(size)):
        return None
    quantity = next(q for q in facts.quantities if q.name == name)
    shown = f"{quantity.symbol} [{quantity.unit}]" if quantity.unit else quantity.symbol
    return _Exact(shown, size, _parts(np.interp(frames, one.t, one.reference), size))


def _beside(exact: _Exact, one: History, frames: Vector) -> Places:
    """The places of a scheme; 0 where it is never a pixel off the exact one."""
    found = _parts(np.interp(frames, one.t, one.value), exact.size)
    pairs = zip(found, exact.parts, strict=True)
    near = all(a is not None and b is not None and abs(a - b) <= 1 for a, b in pairs)
    return 0 if near else found


def _parts(values: Vector, size: float) -> list[int | None]:
    """Values in units of PARTS per size; None for those that are not finite."""
    shown = np.clip(values / size, -FAR, FAR) * PARTS
    return [round(value) if np.isfinite(value) else None for value in shown.tolist()]


def _factor(moved: Mapping[str, Moved], exact: Mapping[str, _Exact], facts: VariantFacts) -> float:
    """The magnification of a motion, so that it is visible and stays inside the drawing."""
    if facts.sketch is None:
        return 1.0
    ways = [exact[name].size * math.hypot(*one.along) for name, one in moved.items()]
    far = max(ways, default=0.0) * SCALE / facts.sketch.size
    if SMALL <= far <= LARGE or far == 0.0:
        return 1.0
    return _round_down((SEEN if far < SMALL else LARGE) / far)


def _round_down(number: float) -> float:
    """The next number below that is 1, 2 or 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(number))
    return power * max(n for n in (1, 2, 5) if n <= number / power * (1 + 1e-9))


def _move(
    move: Moved, place: int, size: float, factor: float, facts: VariantFacts
) -> tuple[object, ...]:
    """Of which history, which circles and faces, how far per part [pixels], turn [degrees]."""
    scale = SCALE / facts.sketch.size if facts.sketch else 0.0
    x, y = (float(f"{part * size * factor * scale / PARTS:.4g}") for part in move.along)
    turn = math.degrees(-move.turn * size * max(1.0, factor)) / PARTS
    return place, *move.circles, *move.faces, x, -y, float(f"{turn:.4g}")


def _in_words(factor: float) -> str:
    """How motions are drawn, beside bodies."""
    if factor == 1.0:
        return "motion to the scale of the drawing"
    if factor > 1.0:
        return f"motion magnified {factor:g} times, bodies to scale"
    return f"motion reduced {1 / factor:g} times, bodies to scale"

"""How far a result may move from the accepted one, since platforms and builds round differently.

If an answer is wrong by more than its scale, or is larger than the scale and has no error that
would show it, its rounding is larger by the same factor, and so is its band. Where rounding grows
in time, as in impacts of many blocks, further runs show by how much: their masses, gravity and
corners of blocks differ in the last digits (`vv.plan.nudged`). Their largest distance from the
accepted run is stored with the result, and the band is a multiple of it.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from vv.records.accepted import AcceptedQuantity, AcceptedResult
from vv.records.quantity import MeasuredQuantity

LARGE = 1e99  # stands for an infinite change
NUMBERS = re.compile(r"[-+]?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?")
EVERY_STEP = 10.0  # bands over what one change moved: a platform rounds otherwise in every step


@dataclass(frozen=True)
class Band:
    """How far a value relative to its scale, and an error, may move, with the reason."""

    width: float
    reason: str


IN_HOUSE = Band(1e-9, "our own arithmetic: only the last bits may differ between platforms")
EXTERNAL = Band(
    1e-6, "an external program: another build of it may round otherwise in each of many steps"
)


def band_of(code: str, external: Collection[str]) -> Band:
    """The band of a code where rounding does not grow. external: codes that others made."""
    return EXTERNAL if code in external else IN_HOUSE


def widened(band: Band, then: AcceptedQuantity, beyond: float) -> Band:
    """The band of a quantity. beyond: its error or size over its scale."""
    width = band.width * max(1.0, beyond)
    rounding = then.rounding or 0.0
    if EVERY_STEP * rounding <= width:
        return Band(width, band.reason)
    nudge = f"a change of the scene in the last digits moved it by {rounding:.2g}"
    reason = f"{nudge}, and another platform rounds otherwise in every step"
    return Band(EVERY_STEP * rounding, reason)


def rounding_of(then: AcceptedQuantity, again: AcceptedQuantity | None) -> float:
    """By how much a quantity differs in another run, as bands count it; LARGE if it lacks it."""
    if again is None or (then.error is None) != (again.error is None):
        return LARGE
    moved = max(shift_of(then, again), abs((then.error or 0.0) - (again.error or 0.0)))
    return min(moved, LARGE)


def shift_of(then: AcceptedQuantity, now: AcceptedQuantity | MeasuredQuantity) -> float:
    """The largest change of a figure over the scale that was accepted."""
    names = then.figures.keys() | now.figures.keys()
    pairs = [(then.figures.get(name), now.figures.get(name)) for name in names]
    if any((a is None) != (b is None) for a, b in pairs):
        return float("inf")
    changes = [abs(a - b) for a, b in pairs if a is not None and b is not None]
    return max(changes, default=0.0) / (then.scale or 1.0)


def size_of(then: AcceptedQuantity) -> float:
    """The largest figure over the scale that was accepted."""
    figures = [abs(value) for value in then.figures.values() if value is not None]
    return max(figures, default=0.0) / (then.scale or 1.0)


def with_rounding(
    now: AcceptedResult, again: Sequence[AcceptedResult], band: Band
) -> AcceptedResult:
    """A result with the largest movements by rounding, where they may widen a band."""
    moved = {
        name: max((rounding_of(one, other.quantities.get(name)) for other in again), default=0.0)
        for name, one in now.quantities.items()
    }
    return _rounded(now, {n: r for n, r in moved.items() if EVERY_STEP * r > band.width})


def with_wider_rounding(before: AcceptedResult, now: AcceptedResult) -> AcceptedResult:
    """An accepted result with the larger of its own movements by rounding and those of `now`."""
    larger = {}
    for name, one in before.quantities.items():
        new = now.quantities.get(name)
        known = [each.rounding for each in (one, new) if each and each.rounding is not None]
        if known:
            larger[name] = max(known)
    return _rounded(before, larger)


def _rounded(result: AcceptedResult, roundings: Mapping[str, float]) -> AcceptedResult:
    """A result with these movements by rounding, to two digits."""
    quantities = {
        name: dataclasses.replace(
            one, rounding=float(f"{roundings[name]:.2g}") if name in roundings else None
        )
        for name, one in result.quantities.items()
    }
    return dataclasses.replace(result, quantities=quantities)


def shared(
    results: Mapping[str, AcceptedResult], counts: Collection[tuple[str, str]]
) -> dict[str, AcceptedResult]:
    """The results of a case; where rounding decides a count, all of the scheme move alike.

    counts: the results and quantities that are whole numbers. A few changed digits find a few of
    the settings at which a block slides or topples by rounding alone; another platform may find
    others. So the quantities of such a scheme that have the same name, numbers in it aside, share
    the largest movement that was found for any of them.
    """
    jumping = {
        _scheme(name)
        for name, quantity in counts
        if name in results and results[name].quantities[quantity].rounding is not None
    }
    largest: dict[tuple[str, str], float] = {}
    for name, result in results.items():
        for quantity, one in result.quantities.items():
            key = _scheme(name), NUMBERS.sub("", quantity)
            if one.rounding is not None and one.rounding < LARGE:
                largest[key] = max(one.rounding, largest.get(key, 0.0))
    return {
        name: _moved_alike(name, result, largest) if _scheme(name) in jumping else result
        for name, result in results.items()
    }


def _moved_alike(
    name: str, result: AcceptedResult, largest: Mapping[tuple[str, str], float]
) -> AcceptedResult:
    """A result with the movements that its scheme's quantities share."""
    moved = {}
    for quantity, one in result.quantities.items():
        key = _scheme(name), NUMBERS.sub("", quantity)
        if key in largest:
            moved[quantity] = max(largest[key], one.rounding or 0.0)
        elif one.rounding is not None:
            moved[quantity] = one.rounding
    return _rounded(result, moved)


def _scheme(name: str) -> str:
    """The code and scheme in the name of a result."""
    return name.split(" ")[1]

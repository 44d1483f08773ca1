"""Answers of references in two systems of units, whose scales are powers of two.

A product in place of a quotient, a size that an integrator takes for granted, or a tolerance in
metres rather than in parts of what moves, gives other digits in other units.
"""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Powers = tuple[float, float, float]  # of mass, length and time
MASS, LENGTH, TIME, SPEED, RATE, SPRING, DRAG, HERTZ, NONE = (
    (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 1.0, -1.0), (0.0, 0.0, -1.0),
    (1.0, 0.0, -2.0), (1.0, 0.0, -1.0), (1.0, -0.5, -2.0), (0.0, 0.0, 0.0),
)  # fmt: skip
GRAVITY, DENSITY, FORCE, STICKY = (
    (0.0, 1.0, -2.0), (1.0, -3.0, 0.0), (1.0, 1.0, -2.0), (1.0, -1.0, -1.0)
)  # fmt: skip
ROUNDING = 1e-13  # of the largest value of a result
INTEGRATED = 1e-9  # where an integrator or a search has absolute tolerances, below 1e-12 each
UNITS = (2.0**12, 2.0**20, 2.0**16)  # of mass, length and time: their roots are powers of two too

# values that several files of claims share
SPHERES = {
    "K": (2e9, HERTZ), "S": (1.8e9, HERTZ), "r1": (0.1, LENGTH), "m1": (11.3, MASS),
    "r2": (0.2, LENGTH), "m2": (90.0, MASS), "vn": (0.4, SPEED), "vt": (0.3, SPEED),
    "spin": (4.0, RATE), "partner_spin": (-1.0, RATE), "mu": (0.4, NONE),
}  # fmt: skip
STRUCK = (SPEED, SPEED, RATE, RATE, TIME, TIME)  # of what an impact of these spheres gives
GROOVE = {"dip": (30.0, NONE), "xi": (1.4, NONE), "mu": (0.3, NONE), "g": (9.81, GRAVITY)}
LADEN = {
    "t": (np.array([0.2, 0.9]), TIME), "wide": (0.02, LENGTH), "rate": (7.0, RATE),
    "v": (9.0, SPEED), "g": (9.81, GRAVITY),
}  # fmt: skip
LADEN_GIVES = (LENGTH, SPEED, GRAVITY)


def scale(powers: Powers) -> float:
    """What a quantity of these powers of mass, length and time is multiplied by."""
    return float(np.prod([unit**power for unit, power in zip(UNITS, powers, strict=True)]))


class Claim(NamedTuple):
    """An answer of values with their powers, and the powers of its results."""

    answer: Callable[..., Any]
    values: Mapping[str, tuple[Any, Powers]]
    powers: tuple[Powers, ...]


def parts(claim: Claim, other: bool) -> list[Array]:
    """The results, which are put back into the first units if they were obtained in the others."""
    values = {k: v * scale(p) if other else v for k, (v, p) in claim.values.items()}
    found = [np.asarray(part, float) for part in claim.answer(**values)]
    return [
        part / scale(p) if other else part
        for part, p in zip(found, claim.powers, strict=True)
    ]  # fmt: skip


def at(*times: float) -> dict[str, tuple[Any, Powers]]:
    """Times [s] as an argument t."""
    return {"t": (np.array(times), TIME)}


def alone(path: Callable[..., Any]) -> Callable[..., Any]:
    """An answer of one result as a tuple."""
    return lambda **values: (path(**values),)


def apart(claim: Claim) -> float:
    """The largest difference of a result in both systems, over its largest value if it has one."""
    pairs = zip(parts(claim, False), parts(claim, True), strict=True)
    return max(
        float(np.abs(one - other).max() / (np.abs(one).max() or 1.0)) for one, other in pairs
    )

"""How results are compared with references: norms, relative errors, observed order."""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Vector = npt.NDArray[np.float64]
MASK = 0.01  # the pointwise error is taken where |ref| is at least this part of its maximum


def max_error(value: Vector, reference: Vector) -> float:
    """max|value - reference| / max|reference|; arrays (k,) of one shape, reference not all zero."""
    return scaled_error(value, reference, _scale(reference))


def scaled_error(value: Vector, reference: Vector, scale: float) -> float:
    """max|value - reference| / scale, for a reference that may be zero throughout."""
    return float(np.abs(value - reference).max() / scale)


def l2_error(value: Vector, reference: Vector) -> float:
    """||value - reference||_2 / ||reference||_2."""
    _scale(reference)
    return float(np.linalg.norm(value - reference) / np.linalg.norm(reference))


def final_error(value: Vector, reference: Vector) -> float:
    """|value - reference| / |reference| at the last time; NaN where that reference is zero."""
    last = float(abs(reference[-1]))
    return float(abs(value[-1] - reference[-1]) / last) if last > 0 else math.nan


def pointwise_error(value: Vector, reference: Vector) -> float:
    """max |value/reference - 1| over the points where |reference| >= MASK max|reference|."""
    kept = np.abs(reference) >= MASK * _scale(reference)
    return float(np.abs((value[kept] - reference[kept]) / reference[kept]).max())


def pointwise_history(value: Vector, reference: Vector) -> Vector:
    """(k,) value/reference - 1, NaN where |reference| < MASK max|reference|."""
    kept = np.abs(reference) >= MASK * _scale(reference)
    history = np.full(len(reference), np.nan)
    history[kept] = (value[kept] - reference[kept]) / reference[kept]
    return history


def _scale(reference: Vector) -> float:
    scale = float(np.abs(reference).max())
    if not (math.isfinite(scale) and scale > 0):
        raise ValueError(f"max|reference| = {scale!r}; a relative error needs a positive scale")
    return scale


@dataclass(frozen=True)
class Order:
    """An observed order of convergence: the slope, its standard error, and the points used."""

    order: float
    spread: float
    points: int


def observed_order(steps: list[float], errors: list[float]) -> Order | None:
    """Slope of log error against log step by least squares; None below two usable points.

    spread is the standard error of the slope, zero when two points leave no freedom.
    """
    usable = [(h, e) for h, e in zip(steps, errors, strict=True) if math.isfinite(e) and e > 0]
    if len({h for h, _ in usable}) < 2:
        return None
    x, y = np.log(np.array(usable)).T
    x = x - x.mean()
    slope = float(x @ y / (x @ x))
    residual = y - y.mean() - slope * x
    freedom = len(x) - 2
    spread = math.sqrt(float(residual @ residual) / freedom / float(x @ x)) if freedom else 0.0
    return Order(slope, spread, len(x))


STALLED = 1.5  # refinements that improve by less, twice in a row, have met a floor


def before_floor(errors: Sequence[float]) -> int:
    """How many errors of a ladder, coarsest first, lie before its floor; all if it has none.

    A floor is where the last two refinements, or more, each improved less than STALLED times.
    """
    gains = [before >= STALLED * after for before, after in itertools.pairwise(errors)]
    stalls = len(list(itertools.takewhile(lambda gain: not gain, reversed(gains))))
    return len(errors) if stalls < 2 else len(gains) - stalls


def order_before_floor(steps: list[float], errors: list[float]) -> Order | None:
    """The observed order over the rungs, coarsest first, that lie before their floor."""
    free = before_floor(errors)
    return observed_order(steps[:free], errors[:free])


NOISE = 1e-12  # relative: differences below that are rounding, of which no order is told
SAFETY = 1.25  # the factor of the grid convergence index for three grids
ODD = 8.0  # no method here is of such an order: three values that show it have no law


@dataclass(frozen=True)
class Convergence:
    """What three resolutions say without an exact answer (Celik et al. 2008, J. Fluids Eng. 130).

    order: apparent; limit: extrapolated to zero size. SAFETY times the distance to it of a value
    is that value's grid convergence index.
    """

    order: float
    limit: float


@dataclass(frozen=True)
class Unsettled:
    """Why three resolutions have no limit to speak of."""

    why: str


def convergence(
    sizes: tuple[float, float, float], values: tuple[float, float, float]
) -> Convergence | Unsettled:
    """Richardson's limit; sizes and values finest first.

    Unsettled where the values swing, hardly differ, do not close in, or do so at an odd order.
    Solved for the order by iteration (Celik et al. 2008, Eqs. 3-7).
    """
    (h1, h2, h3), (f1, f2, f3) = sizes, values
    r21, r32, e21, e32 = h2 / h1, h3 / h2, f2 - f1, f3 - f2
    if why := _lawless(sizes, values):
        return Unsettled(why)
    order = _apparent_order(r21, r32, e32 / e21)
    if order > ODD:
        return Unsettled(f"an order above {ODD:g} is none that a method has")
    return Convergence(order, f1 - e21 / (r21**order - 1))


def _lawless(sizes: tuple[float, float, float], values: tuple[float, float, float]) -> str:
    """Why no power of the size with a positive exponent goes through three values; else ''."""
    (h1, h2, h3), (f1, f2, f3) = sizes, values
    e21, e32 = f2 - f1, f3 - f2
    if not h1 < h2 < h3:
        return f"sizes {h1:g}, {h2:g}, {h3:g} do not grow"
    if not min(abs(e21), abs(e32)) > NOISE * max(abs(f1), abs(f2), abs(f3)):
        return "the values differ by rounding alone"
    if e21 * e32 < 0:
        return "the values swing"
    closing = e32 / e21 > math.log(h3 / h2) / math.log(h2 / h1)
    return "" if closing else "the values do not close in"


def _apparent_order(r21: float, r32: float, ratio: float) -> float:
    """p > 0 of ratio = r21^p (r32^p - 1)/(r21^p - 1), or a little more than ODD if beyond it."""
    low, high = 0.0, 1.01 * ODD
    for _ in range(60):
        p = 0.5 * (low + high)
        made = p * math.log(r21) + math.log((r32**p - 1) / (r21**p - 1))
        low, high = (p, high) if made < math.log(ratio) else (low, p)
    return 0.5 * (low + high)

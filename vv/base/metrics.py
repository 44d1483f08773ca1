"""Compares results with references: norms, relative errors, observed order of convergence."""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Vector = npt.NDArray[np.float64]
POINTWISE_THRESHOLD = 0.01  # of max|ref|: points with a smaller |ref| are left out


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
    """max |value/reference - 1| where |reference| >= POINTWISE_THRESHOLD max|reference|."""
    kept = np.abs(reference) >= POINTWISE_THRESHOLD * _scale(reference)
    return float(np.abs((value[kept] - reference[kept]) / reference[kept]).max())


def pointwise_history(value: Vector, reference: Vector) -> Vector:
    """(k,) value/reference - 1; NaN where |reference| < POINTWISE_THRESHOLD max|reference|."""
    kept = np.abs(reference) >= POINTWISE_THRESHOLD * _scale(reference)
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
    """An observed order of convergence: slope, its standard error `spread`, number of points."""

    order: float
    spread: float
    points: int


def observed_order(steps: list[float], errors: list[float]) -> Order | None:
    """Slope of log error against log step by least squares; None with fewer than two steps.

    Errors that are zero or not finite are left out. The standard error of the slope is zero if
    there are only two points.
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


LEAST_IMPROVEMENT = 1.5  # factor; the error has reached a floor after two smaller improvements


def count_before_floor(errors: Sequence[float]) -> int:
    """How many errors of a ladder, coarsest first, come before its floor; all if it has none.

    The floor begins where the last two or more refinements each reduced the error by a factor
    of less than LEAST_IMPROVEMENT.
    """
    gains = [before >= LEAST_IMPROVEMENT * after for before, after in itertools.pairwise(errors)]
    stalls = len(list(itertools.takewhile(lambda gain: not gain, reversed(gains))))
    return len(errors) if stalls < 2 else len(gains) - stalls


def order_before_floor(steps: list[float], errors: list[float]) -> Order | None:
    """The observed order over the settings, coarsest first, that come before the floor."""
    free = count_before_floor(errors)
    return observed_order(steps[:free], errors[:free])


ROUNDING = 1e-12  # relative: smaller differences are rounding, from which no order is fitted
GCI_SAFETY_FACTOR = 1.25  # the factor of the grid convergence index for three grids
HIGHEST_ORDER = 8.0  # a larger apparent order is accidental: no method here has one


@dataclass(frozen=True)
class Convergence:
    """Result of Richardson extrapolation (Celik et al. 2008, J. Fluids Eng. 130).

    order: the apparent order; limit: the value extrapolated to zero size. The grid convergence
    index of a value is GCI_SAFETY_FACTOR times its distance to the limit.
    """

    order: float
    limit: float


@dataclass(frozen=True)
class NoLimit:
    """Why three resolutions do not determine a limit of small sizes."""

    reason: str


def convergence(
    sizes: tuple[float, float, float], values: tuple[float, float, float]
) -> Convergence | NoLimit:
    """Apparent order and limit of three values at three sizes, finest first.

    The order solves Celik et al. (2008), Eqs. 3-7, by bisection. Returns NoLimit if the values
    oscillate, differ by rounding only, do not converge, or show an order above HIGHEST_ORDER.
    """
    (h1, h2, h3), (f1, f2, f3) = sizes, values
    r21, r32, e21, e32 = h2 / h1, h3 / h2, f2 - f1, f3 - f2
    if why := _why_no_limit(sizes, values):
        return NoLimit(why)
    order = _apparent_order(r21, r32, e32 / e21)
    if order > HIGHEST_ORDER:
        return NoLimit(f"an order above {HIGHEST_ORDER:g}; no method has one")
    return Convergence(order, f1 - e21 / (r21**order - 1))


def _why_no_limit(sizes: tuple[float, float, float], values: tuple[float, float, float]) -> str:
    """Why limit + c size^p with p > 0 fits no three such values; empty if it does."""
    (h1, h2, h3), (f1, f2, f3) = sizes, values
    e21, e32 = f2 - f1, f3 - f2
    if not h1 < h2 < h3:
        return f"sizes {h1:g}, {h2:g}, {h3:g} do not increase; list them finest first"
    if not min(abs(e21), abs(e32)) > ROUNDING * max(abs(f1), abs(f2), abs(f3)):
        return "the values differ by rounding alone"
    if e21 * e32 < 0:
        return "the values oscillate"
    closing = e32 / e21 > math.log(h3 / h2) / math.log(h2 / h1)
    return "" if closing else "the values do not converge"


def _apparent_order(r21: float, r32: float, ratio: float) -> float:
    """p > 0 of ratio = r21^p (r32^p - 1)/(r21^p - 1), at most 1.01 HIGHEST_ORDER."""
    low, high = 0.0, 1.01 * HIGHEST_ORDER
    for _ in range(60):
        p = 0.5 * (low + high)
        made = p * math.log(r21) + math.log((r32**p - 1) / (r21**p - 1))
        low, high = (p, high) if made < math.log(ratio) else (low, p)
    return 0.5 * (low + high)

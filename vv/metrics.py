"""How results are compared with references: norms, relative errors, observed order."""

import math
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


NOISE = 1e-12  # relative: differences below that are rounding, of which no order is told
SAFETY = 1.25  # the factor of Celik et al. (2008) for three grids


@dataclass(frozen=True)
class Convergence:
    """What three resolutions say without an exact answer (Celik et al. 2008, J. Fluids Eng. 130).

    order: apparent; limit: extrapolated to zero size; fine, coarse: grid convergence indices of
    the finer and the coarser pair, relative.
    """

    order: float
    limit: float
    fine: float
    coarse: float


def convergence(
    sizes: tuple[float, float, float], values: tuple[float, float, float]
) -> Convergence | None:
    """Richardson's limit and the grid convergence index; sizes and values finest first.

    None where the values do not converge monotonically or hardly differ: then there is no limit to
    speak of. Solved for the order by iteration (Celik et al. 2008, Eqs. 3-7).
    """
    (h1, h2, h3), (f1, f2, f3) = sizes, values
    r21, r32, e21, e32 = h2 / h1, h3 / h2, f2 - f1, f3 - f2
    apart = min(abs(e21), abs(e32)) > NOISE * max(abs(f1), abs(f2), abs(f3))
    if not (r21 > 1 and r32 > 1 and e21 * e32 > 0 and f1 and f2 and apart):
        return None
    order = _apparent_order(r21, r32, e32 / e21)
    if order is None:
        return None
    near, far = r21**order - 1, r32**order - 1
    limit = f1 - e21 / near
    return Convergence(order, limit, SAFETY * abs(e21 / f1) / near, SAFETY * abs(e32 / f2) / far)


def _apparent_order(r21: float, r32: float, ratio: float) -> float | None:
    """p of ratio = r21^p (r32^p - 1)/(r21^p - 1); None where no positive p solves it."""
    low, high = 1e-3, 20.0

    def short(p: float) -> float:
        return math.log(ratio) - p * math.log(r21) - math.log((r32**p - 1) / (r21**p - 1))

    if short(low) * short(high) > 0:
        return None
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if short(low) * short(middle) > 0 else (low, middle)
    return 0.5 * (low + high)

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

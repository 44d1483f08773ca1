"""One step of w' = T - F w/|w| in a plane: a Radau IIA collocation of order 31.

The method is stiffly accurate, as a slip from rest, which is infinitely stiff, requires. It does
not evaluate the equation at the beginning of the step, where w/|w| is undefined for such a slip. w'
is a Legendre series on the step (Hairer and Wanner, Solving Ordinary Differential Equations II,
Sec. IV.5).
"""

from collections.abc import Iterator
from functools import cache
from math import hypot
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

Array = NDArray[np.float64]

NODES = 16
_ONE = np.eye(NODES)


class Basis(NamedTuple):
    """The Radau collocation on [0, 1] with its `nodes` (n,).

    `transform` (n, n) maps values at the nodes to Legendre coefficients, `integrals` (n, n) maps
    them to the integrals of the interpolant up to each node. `twice` (n + 2, n) maps Legendre
    coefficients to those of the double integral.
    """

    nodes: Array
    transform: Array
    integrals: Array
    twice: Array


@cache
def basis() -> Basis:
    """The collocation at Radau's nodes, the zeros of P_n - P_(n-1), of which the last is 1."""
    unit = np.eye(NODES + 1)
    z = legendre.legroots(unit[NODES] - unit[NODES - 1])
    transform = np.linalg.inv(legendre.legvander(z, NODES - 1)).astype(np.float64)
    once, twice = (legendre.legint(_ONE, m, lbnd=-1.0, scl=0.5).astype(np.float64) for m in (1, 2))
    return Basis((1.0 + z) / 2.0, transform, legendre.legvander(z, NODES) @ once @ transform, twice)


def advanced(x: Array, w: Array, length: float, rate: Array) -> tuple[Array, Array]:
    """x and w at the end of a step, where every Legendre polynomial is 1."""
    return x + length * (w + length * rate @ basis().twice.sum(axis=0)), w + length * rate[:, 0]


def along(tau: Array, length: Array, x: Array, w: Array, rate: Array) -> Array:
    """x (..., 2) [m] at times tau (...) [s] after the beginning of steps.

    Each step has its length (...), x and w (..., 2) at its beginning, and rate (..., 2, n).
    """
    z = 2.0 * np.divide(tau, length, out=np.zeros(tau.shape), where=length > 0.0) - 1.0
    twice = (legendre.legvander(z.ravel(), NODES + 1) @ basis().twice).reshape(*z.shape, NODES)
    curved = np.einsum("...n,...an->...a", twice, rate)
    moved: Array = x + tau[..., None] * w + length[..., None] ** 2 * curved
    return moved


def collocate(T: Array, F: Array, w: Array, length: float) -> Array | None:
    """The Legendre coefficients (2, n) [m/s2] of w' on a step; None if Newton's method fails.

    The step starts with the velocity w (2,) and has the `length` [s]; T (2, n) and F (n,) are the
    values at the nodes.
    """
    for guess in _guesses(T, F, w, length):
        v = _solved(T, F, w, length, guess)
        if v is not None:
            rate: Array = (T - F * v / np.hypot(*v)) @ basis().transform.T
            return rate
    return None


def _guesses(T: Array, F: Array, w: Array, length: float) -> Iterator[Array]:
    """Guesses of w at the nodes (2, n): for a constant direction of friction, and for w along T."""
    A, speed, pull = length * basis().integrals, hypot(*w), np.hypot(*T)
    if speed > 0.0:
        yield w[:, None] + (T - F * (w / speed)[:, None]) @ A.T
    yield T / pull * np.maximum(speed + A @ (pull - F), 1e-30)


def _solved(T: Array, F: Array, w: Array, length: float, v: Array) -> Array | None:
    """w at the nodes of a step, (2, n), by Newton's method from the guess v.

    Friction changes only along the normal n of w, so that each correction follows from its
    component along n at each node. The effect of rounding on w can only be judged relative to T and
    F.
    """
    A, rounding = length * basis().integrals, 1e-15 * length * F.max()
    for _ in range(8):
        speed = np.hypot(*v)
        if not speed.min() > 0.0:
            return None
        off = v - w[:, None] - (T - F * v / speed) @ A.T
        n = np.array([-v[1], v[0]]) / speed
        turned = F / speed * np.linalg.solve(_ONE + A * (n.T @ n) * (F / speed), (n * off).sum(0))
        change = off - (n * turned) @ A.T
        v = v - change
        if (np.hypot(*change) <= 1e-9 * speed + rounding).all():
            return v
    return None

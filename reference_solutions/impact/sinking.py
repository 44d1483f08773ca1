"""A sphere that sinks in a fluid with the drag of Schiller and Naumann (1933), by quadrature.

v' = a (1 - b) - v (1 + 0.15 (k v)^0.687)/s for the downward speed v, with s = rho d^2/(18 mu), k =
rho_f d/mu and b = rho_f/rho. With v = w + (v0 - w) exp(-x), w the terminal speed, time and depth
are integrals over x of functions that are smooth for all x.
"""

from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_positive, require_times

Array = NDArray[np.float64]
NODES, WIDTH = 16, 0.125  # Gauss points and width of each panel in x
POWER, FACTOR = 0.687, 0.15


class Sinking(NamedTuple):
    """Diameter [m], density [kg/m3], density and viscosity [Pa s] of the fluid, gravity, v0."""

    d: float
    rho: float
    rho_f: float
    mu: float
    g: float
    v0: float

    @property
    def time(self) -> float:
        """The relaxation time s [s] of drag at low speed."""
        return self.rho * self.d**2 / (18.0 * self.mu)

    def rate(self, v: ArrayLike) -> Array:
        """The acceleration v' [m/s2]."""
        speed = np.asarray(v, dtype=np.float64)
        reynolds = self.rho_f * self.d * speed / self.mu
        slowed = speed * (1.0 + FACTOR * reynolds**POWER) / self.time
        return np.asarray(self.g * (1.0 - self.rho_f / self.rho) - slowed)

    def slope(self, v: ArrayLike) -> Array:
        """The slope dv'/dv [1/s] at a speed."""
        reynolds = self.rho_f * self.d * np.asarray(v, dtype=np.float64) / self.mu
        return np.asarray(-(1.0 + (1.0 + POWER) * FACTOR * reynolds**POWER) / self.time)

    @property
    def quickest(self) -> float:
        """The largest rate -dv'/dv [1/s] at which two neighbouring speeds converge."""
        return float(-self.slope(max(self.v0, self.last)))

    @property
    def last(self) -> float:
        """The terminal speed w [m/s]."""
        from scipy.optimize import brentq

        most = self.g * self.time
        return float(brentq(lambda v: float(self.rate(v)), 0.0, most, xtol=1e-300, rtol=1e-15))


def motion(t: ArrayLike, sinking: Sinking) -> tuple[Array, Array]:
    """Depth [m] and speed [m/s] at times t >= 0 [s] of any shape.

    Raises ValueError for parameters that are not positive, or a fluid not lighter than the sphere.
    """
    require_positive("in SI units", **sinking._asdict())
    if sinking.rho_f >= sinking.rho:
        raise ValueError(f"rho_f = {sinking.rho_f}; the sphere must be heavier than the fluid")
    times = require_times(t)
    w = sinking.last
    lead = sinking.v0 - w
    ends, whole = _table(sinking, w, lead, float(times.max(initial=0.0)))
    panel = np.clip(np.searchsorted(ends, times, side="right") - 1, 0, len(ends) - 2)
    x = panel * WIDTH + WIDTH * (times - ends[panel]) / np.diff(ends)[panel]
    start = np.asarray(panel * WIDTH, dtype=np.float64)
    for _ in range(50):  # Newton's method for x(t); time increases with x
        late, deep = _between(start, x, sinking, w, lead)
        step = (ends[panel] + late - times) / _slope(x, sinking, w, lead)[0]
        x = x - step
        if np.abs(step).max(initial=0.0) <= 1e-15 * np.abs(x).max(initial=1.0):
            break
    late, deep = _between(start, x, sinking, w, lead)
    return whole[panel] + deep, w + lead * np.exp(-x)


def _slope(x: Array, sinking: Sinking, w: float, lead: float) -> Array:
    """dt/dx = (w - v)/v' and d(depth)/dx (2, ...), without cancellation where v is close to w."""
    ahead = lead * np.exp(-x)
    steep = (POWER + 1.0) / w * np.ones_like(ahead)
    grown = np.expm1((POWER + 1.0) * np.log1p(ahead / w))
    np.divide(grown, ahead, out=steep, where=ahead != 0.0)
    reynolds = sinking.rho_f * sinking.d * w / sinking.mu
    time = sinking.time / (1.0 + FACTOR * reynolds**POWER * w * steep)
    return np.asarray([time, (w + ahead) * time])


def _between(start: Array, end: Array, sinking: Sinking, w: float, lead: float) -> Array:
    """The increments of time and depth (2, ...) between two values of x."""
    nodes, weights = legendre.leggauss(NODES)
    half = 0.5 * (end - start)
    at = (0.5 * (end + start))[..., None] + half[..., None] * nodes
    return np.asarray(half * (_slope(at, sinking, w, lead) @ weights))


def _table(sinking: Sinking, w: float, lead: float, until: float) -> tuple[Array, Array]:
    """Time and depth (n,) at the ends of the panels that cover the times up to `until` [s]."""
    count = 8
    while True:
        edges: Array = WIDTH * np.arange(count + 1, dtype=np.float64)
        parts = _between(edges[:-1], edges[1:], sinking, w, lead)
        times, depths = np.concatenate([np.zeros((2, 1)), np.cumsum(parts, axis=1)], axis=1)
        if times[-1] > until:
            return times, depths
        count *= 2

"""What drives a loaded block on a shaking slope, and how far springs and steps lag behind that."""

from __future__ import annotations

import functools
from dataclasses import dataclass

import numpy as np

from vv.scene import Vector

SOFT, STEP = 1e8, 1e-3  # N/m, s: the softest springs, and the longest step
CORNERS = 4.0  # springs of a code with blocks; one with spheres has one spring


@dataclass(frozen=True)
class Driven:
    """A block's motion at times [s] and what drives it, at the parameters of a run.

    pressed (k,) [m/s2]: the pressure over mass, and steady: the part by dead loads. pulled (k, 2)
    [m/s2]: accelerations along the slip and the normal. drives (k, 3) [m/s2]: the parts of that
    along the slip by shaking and lift. way [m], speed [m/s]: the largest ones. gap [m]: at t = 0.
    late [s]: the step by half of which a motion may start late.
    """

    times: Vector
    pressed: Vector
    steady: float
    pulled: Vector
    drives: Vector
    mass: float
    mu: float
    way: float
    speed: float
    gap: float
    late: float

    @functools.cached_property
    def jerks(self) -> Vector:
        """The rates of change (k, 2) of the accelerations [m/s3]."""
        return np.asarray(np.gradient(self.pulled, self.times, axis=0))

    @property
    def w(self) -> float:
        """The frequency [1/s] of the block on one of the softest springs."""
        return float(np.sqrt(SOFT / self.mass))

    @functools.cached_property
    def rates(self) -> Vector:
        """The rates of change (k,) of the pressure over mass [m/s3]."""
        return np.asarray(np.gradient(self.pressed, self.times, edge_order=2))

    @property
    def rate(self) -> float:
        """The largest rate of change of the pressure over mass [m/s3]."""
        return float(np.abs(self.rates).max())

    @functools.cached_property
    def begins(self) -> float:
        """The largest velocity [m/s] of the oscillation on one of the softest springs.

        From integration by parts, a spring that carries the pressure p0 at the start oscillates
        with the velocity p'(0)/w^2, and by p''(0)/w^3 and p''(t)/w^3 more. A leapfrog whose first
        velocity is that of t = 0 is half a step late, by the acceleration a(0) dt/2 of the slope:
        steps of a cube are 0.2/w at most at each stiffness, so that this falls as 1/w too.
        """
        curved = np.abs(np.gradient(self.rates, self.times, edge_order=2))
        first = abs(self.rates[0]) / self.w**2 + abs(self.pulled[0, 1]) * self.late / 2.0
        return float(first + (curved[0] + curved.max()) / self.w**3)

    @functools.cached_property
    def sinks(self) -> tuple[float, float]:
        """The largest displacement [m] and velocity [m/s] of the block on its softest springs."""
        w, rate = self.w, self.rate
        sudden = abs(self.pressed[0] - self.steady)
        more, all_of_it = (np.abs(self.pressed - p).max() for p in (self.pressed[0], self.steady))
        several = np.sqrt(CORNERS) * w
        return (
            float(max(more / w**2 + self.begins / w,
                      (all_of_it + sudden) / several**2 + rate / several**3)),
            float(max(rate / w**2 + self.begins, sudden / several + 2 * rate / several**2)),
        )  # fmt: skip

    @functools.cached_property
    def lags(self) -> tuple[float, float]:
        """The errors of the displacement and the speed by a lag [m, m/s], over the step."""
        rubs, first = self.mu * np.abs(self.pressed - self.pressed[0]), self.mu * self.pressed[0]
        late = (np.abs(self.pulled[:, 0] - self.pulled[0, 0]) + rubs + first) / 2
        return float(np.trapezoid(late, self.times)), float(late.max())

    @functools.cached_property
    def means(self) -> float:
        """The error [m] along the slip of the longest step, with the forces at times of its own."""
        begins = np.abs(self.drives[1] - self.drives[0]) / self.times[1]
        moved = np.abs(self.drives - self.drives[0]) + self.times[:, None] * begins
        return float(moved.max(axis=0).sum()) * STEP**2 / 12

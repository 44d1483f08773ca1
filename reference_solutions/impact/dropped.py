"""A sphere dropped on a wall: free fall and contacts on a spring and a dashpot, in closed form.

While there is an overlap u [m], m u'' = m g - max(0, kn u + c u') with c = 2 z sqrt(kn m). A
contact ends where its force would become tensile; with `pulls` it lasts until the overlap is zero,
as in many codes. Heights [m] are those of the lowest point of the sphere over the wall. All
functions raise ValueError for parameters outside their ranges.
"""

from math import cos, exp, inf, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_positive, require_times

Array = NDArray[np.float64]


class Piece(NamedTuple):
    """A flight or a contact: its start [s], and the height [m] and upward velocity [m/s] then."""

    since: float
    height: float
    speed: float
    touching: bool


class Drop(NamedTuple):
    """m [kg], kn [N/m], z, g [m/s2], and whether the contact force may become tensile."""

    m: float
    kn: float
    z: float
    g: float
    pulls: bool = False

    def contact(self, t: float, speed: float) -> tuple[float, float]:
        """The height and velocity at t [s] after a contact began with this velocity."""
        w = sqrt(self.kn / self.m)
        sunk, wd = self.g / w**2, w * sqrt(1.0 - self.z**2)  # origin at equilibrium
        a, b = sunk, (speed + self.z * w * sunk) / wd
        fade = exp(-self.z * w * t)
        swing = fade * (a * cos(wd * t) + b * sin(wd * t))
        turned = fade * wd * (b * cos(wd * t) - a * sin(wd * t))
        return swing - sunk, turned - self.z * w * swing

    def flight(self, t: float, height: float, speed: float) -> tuple[float, float]:
        """The height and velocity at t [s] after a flight began at this height and velocity."""
        return height + speed * t - 0.5 * self.g * t * t, speed - self.g * t

    def lasting(self, speed: float) -> float:
        """The duration [s] of a contact that begins at this velocity; inf if it never ends."""
        from scipy.optimize import brentq

        def push(t: float) -> float:
            height, rate = self.contact(t, speed)
            force = -height if self.pulls else -height * self.kn - self.viscous * rate
            return float(force)

        half = pi / sqrt(self.kn / self.m * (1.0 - self.z**2))
        for k in range(
            40, 121
        ):  # the force starts above zero and falls to zero once, after the turning point
            if push(k * half / 60.0) <= 0.0:
                found = brentq(push, (k - 1) * half / 60.0, k * half / 60.0, xtol=1e-300)
                return float(found)
        return inf

    @property
    def viscous(self) -> float:
        """The coefficient of damping c [N s/m]."""
        return 2.0 * self.z * sqrt(self.kn * self.m)

    def pieces(self, height: float, bounces: int) -> list[Piece]:
        """The flight from rest at a height, and the given number of contacts and flights after it.

        Raises ValueError if a contact never ends.
        """
        require_positive("in SI units", m=self.m, kn=self.kn, g=self.g, height=height)
        if not 0.0 <= self.z < 1.0:
            raise ValueError(f"z = {self.z}; it must lie in [0, 1)")
        pieces = [Piece(0.0, height, 0.0, False)]
        for _ in range(bounces):
            since, start, speed, _ = pieces[-1]
            meets = (speed + sqrt(speed**2 + 2.0 * self.g * start)) / self.g
            hit = Piece(since + meets, 0.0, speed - self.g * meets, True)
            long = self.lasting(hit.speed)
            if long == inf:
                raise ValueError("the sphere stays on the wall after fewer bounces")
            pieces += [hit, Piece(hit.since + long, *self.contact(long, hit.speed), False)]
        return pieces

    def tops(self, height: float, bounces: int) -> list[float]:
        """The greatest height [m] after each bounce."""
        flights = self.pieces(height, bounces)[2::2]
        return [piece.height + piece.speed**2 / (2.0 * self.g) for piece in flights]


def path(t: ArrayLike, height: float, bounces: int, drop: Drop) -> Array:
    """Height [m] at times t [s] of any shape, up to the end of the flight after the last bounce."""
    t, pieces = require_times(t), drop.pieces(height, bounces)
    starts = np.array([piece.since for piece in pieces])
    which = np.searchsorted(starts, t, side="right") - 1
    heights = [
        _at(float(when), pieces[k], drop) for when, k in zip(t.flat, which.flat, strict=True)
    ]
    return np.array(heights).reshape(np.shape(t))


def _at(t: float, piece: Piece, drop: Drop) -> float:
    past = t - piece.since
    if piece.touching:
        return drop.contact(past, piece.speed)[0]
    return drop.flight(past, piece.height, piece.speed)[0]

"""A separate program: a block on a shaken slope whose shear spring friction limits."""

from __future__ import annotations

from typing import Any, NamedTuple

import numba
import numpy as np

SHEAR, MASS = 25.0, 2500.0  # ks over kn of the stand-in of a block, kg


class Slope(NamedTuple):
    """Weight along the slope and friction at rest over the mass [m/s2]; cos, sin of its dip; mu."""

    pull: float
    held: float
    cosine: float
    sine: float
    mu: float


def slope(dip: float, friction: float, g: float) -> Slope:
    """A slope of a dip [deg] with an angle of friction [deg]."""
    angle, mu = np.radians(dip), float(np.tan(np.radians(friction)))
    cosine, sine = float(np.cos(angle)), float(np.sin(angle))
    return Slope(g * sine, mu * g * cosine, cosine, sine, mu)


def frequency(kn: float) -> float:
    """w [1/s] of the shear spring at a normal stiffness [N/m]."""
    return float(np.sqrt(SHEAR * kn / MASS))


def _slid(
    w: float,
    angle: float,
    until: float,
    damping: float,
    on: Slope,
    along: tuple[float, float],
    aside: tuple[float, float],
) -> tuple[float, float]:
    """Where the block is after a time [s], in steps of w dt = angle.

    damping: at rest, over w. along, aside: amplitude [m/s2] and frequency [Hz] of the shaking.
    """
    dt = angle / w
    x, y, vx, vy, sx, sy = 0.0, 0.0, 0.0, 0.0, on.pull / w**2, 0.0
    for step in range(round(until / dt)):
        t = step * dt
        shaking = along[0] * np.sin(2 * np.pi * along[1] * t)
        over = w * w * np.hypot(sx, sy) / (on.held - on.mu * shaking * on.sine)
        slips = over > 1
        if slips:
            sx, sy = sx / over, sy / over
        drag = 0.0 if slips else damping * w
        vx += dt * (on.pull + shaking * on.cosine - w * w * sx - drag * vx)
        vy += dt * (aside[0] * np.sin(2 * np.pi * aside[1] * t) - w * w * sy - drag * vy)
        x, y, sx, sy = x + dt * vx, y + dt * vy, sx + dt * vx, sy + dt * vy
    return x, y


slid: Any = numba.njit(_slid)

"""Displacement of a block on an incline under gravity and harmonic accelerations.

The problem is that of Yagoda-Biran and Hatzor (2016), Secs. 3.1, 4.1 and 4.2: slope alpha and
friction angle phi [degrees], gravity g [m/s2], accelerations a = A sin(2 pi f t) [m/s2] with f
[Hz]. The displacement d along the dip, positive downwards, is 0 at t = 0, when the velocity is v0
[m/s]. A positive acceleration pushes the block out of the slope and down it. Per mass, the driving
force is T = g sin alpha + a cos alpha and the normal force N = g cos alpha - a sin alpha. The block
has d'' = T - N tan phi sliding down, d'' = T + N tan phi sliding up, and rests while |T| <= N tan
phi: it yields downwards at a = g tan(phi - alpha) and upwards at a = -g tan(phi + alpha).

Eq. 8 as printed lacks (A/w)(cos alpha + sin alpha tan phi) t; Eq. 10 holds inside each slip. A
block launched horizontally, as in Sec. 4.1.2, would leave the plane; therefore v0 is along the dip.
Every function raises ValueError for a parameter out of range, and for an acceleration with A
tan(alpha) >= g, which would lift the block off the plane.
"""

from functools import lru_cache
from math import cos, pi, radians, sin, tan

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.blocks import harmonic_slip, turning_slip
from reference_solutions.blocks.harmonic_slip import Law, Phase
from reference_solutions.blocks.turning_slip import Interval, Step
from reference_solutions.parameters import (
    require_acute,
    require_at_least_0,
    require_finite,
    require_positive,
    require_times,
)

Array = NDArray[np.float64]


def gravity(t: ArrayLike, *, alpha: float, phi: float, g: float, v0: float) -> Array:
    """The displacement d [m] under gravity alone at times t >= 0 [s] of any shape (Eqs. 14, 15).

    Downwards d = v0 t + (g/2)(sin alpha - cos alpha tan phi) t^2; a block that comes to rest stays
    at rest if phi >= alpha. A block launched upwards (v0 < 0) decelerates at g (sin alpha + cos
    alpha tan phi).
    """
    t = require_times(t)
    require_acute(alpha=alpha, phi=phi)
    require_positive("m/s2", g=g)
    require_finite("m/s", v0=v0)
    down, up = _forwards(alpha, phi, g), _backwards(alpha, phi, g)
    a = up if v0 < 0.0 else down
    stop = -v0 / a if a * v0 < 0.0 else (np.inf if v0 != 0.0 else 0.0)
    s, rest = np.minimum(t, stop), np.maximum(t - stop, 0.0)
    d: Array = v0 * s + a * s**2 / 2.0 + max(down, 0.0) * rest**2 / 2.0
    return d


def newmark(
    t: ArrayLike, *, alpha: float, phi: float, A: float, f: float, g: float, v0: float
) -> Array:
    """d [m] at times t >= 0 [s] of any shape under a horizontal A sin(2 pi f t) (Eqs. 8, 10).

    The block slides down or up, or rests, depending on the acceleration; see `harmonic_slip`.
    """
    t = require_times(t)
    drive = _drive(alpha, phi, A, f, g, v0)
    return harmonic_slip.displacement(
        t, drive, harmonic_slip.phases(drive, v0, float(t.max(initial=0.0)))
    )


def newmark_phases(
    duration: float, *, alpha: float, phi: float, A: float, f: float, g: float, v0: float
) -> tuple[Phase, ...]:
    """The slips and rests of `newmark` until `duration` [s]; direction 1 is down the dip."""
    end = float(require_times(duration))
    return harmonic_slip.phases(_drive(alpha, phi, A, f, g, v0), v0, end)


def two_directions(
    t: ArrayLike,
    *,
    alpha: float,
    phi: float,
    ax: float,
    fx: float,
    ay: float,
    fy: float,
    g: float,
) -> Array:
    """Displacements down the dip and along the strike [m], the last axis, at times t >= 0 [s].

    The block starts from rest under horizontal accelerations ax(t) = ax sin(2 pi fx t) along the
    dip and ay(t) = ay sin(2 pi fy t) along the strike (Sec. 4.2). With T = (g sin alpha + ax(t) cos
    alpha, ay(t)) and F = tan phi (g cos alpha - ax(t) sin alpha) it rests while its velocity w = 0
    and |T| <= F; otherwise w' = T - F w/|w|; see `turning_slip`.
    """
    t = require_times(t)
    steps = _steps(alpha, phi, ax, fx, ay, fy, g, float(t.max(initial=0.0)))
    return turning_slip.displacement(t, steps)


def two_directions_phases(
    duration: float,
    *,
    alpha: float,
    phi: float,
    ax: float,
    fx: float,
    ay: float,
    fy: float,
    g: float,
) -> tuple[Interval, ...]:
    """The slips and rests of `two_directions` until `duration` [s]."""
    end = float(require_times(duration))
    return turning_slip.intervals(_steps(alpha, phi, ax, fx, ay, fy, g, end))


@lru_cache(maxsize=16)
def _steps(
    alpha: float, phi: float, ax: float, fx: float, ay: float, fy: float, g: float, end: float
) -> tuple[Step, ...]:
    require_acute(alpha=alpha, phi=phi)
    require_at_least_0("m/s2", ax=ax, ay=ay)
    require_positive("Hz", fx=fx, fy=fy)
    require_positive("m/s2", g=g)
    _require_pressed("ax", ax, alpha, g)
    s, c, mu = sin(radians(alpha)), cos(radians(alpha)), tan(radians(phi))
    drive = turning_slip.Drive(
        omega=2.0 * pi * np.array([fx, fy]),
        constant=np.array([g * s, 0.0, mu * g * c]),
        sine=np.array([[ax * c, 0.0], [0.0, ay], [-mu * ax * s, 0.0]]),
        cosine=np.zeros((3, 2)),
    )
    return turning_slip.history(drive, end)


def _drive(
    alpha: float, phi: float, A: float, f: float, g: float, v0: float
) -> harmonic_slip.Drive:
    require_acute(alpha=alpha, phi=phi)
    require_at_least_0("m/s2", A=A)
    require_positive("Hz", f=f)
    require_positive("m/s2", g=g)
    require_finite("m/s", v0=v0)
    _require_pressed("A", A, alpha, g)
    apart, both, c = radians(alpha - phi), radians(alpha + phi), cos(radians(phi))
    forward = Law(_forwards(alpha, phi, g), A * cos(apart) / c)
    backward = Law(_backwards(alpha, phi, g), A * cos(both) / c)
    return harmonic_slip.Drive(2.0 * pi * f, 0.0, forward, backward)


def _forwards(alpha: float, phi: float, g: float) -> float:
    """g (sin alpha - cos alpha tan phi), of sliding down, which is exactly 0 at phi = alpha."""
    return g * sin(radians(alpha - phi)) / cos(radians(phi))


def _backwards(alpha: float, phi: float, g: float) -> float:
    """g (sin alpha + cos alpha tan phi), of sliding up."""
    return g * sin(radians(alpha + phi)) / cos(radians(phi))


def _require_pressed(name: str, value: float, alpha: float, g: float) -> None:
    if not value * tan(radians(alpha)) < g:
        raise ValueError(
            f"{name} = {value} m/s2; {name} tan(alpha) must be below g = {g} m/s2, "
            f"or the block leaves the plane of alpha = {alpha} degrees"
        )

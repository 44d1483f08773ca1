"""Errors of steps in the falls, presses and sinking of MFiX's tests, over steps without units."""

from __future__ import annotations

import math

import numpy as np

from reference_solutions.impact.dropped import Drop, Piece
from reference_solutions.impact.sinking import Sinking, motion
from vv.scene import Vector

HIGHER, LEAST = 1.1, 1e-4  # errors of higher order; a sphere may start at its terminal speed
FINE = 4000  # times at which the speed of a sinking sphere is computed


def delay(bounces: int, slow: float) -> float:
    """The error of the height of a leapfrog over the fall and (w dt)^2; slow: g/(w v).

    As a contact begins or ends at a fraction q of a step, the square of the speed v changes by
    q (1 - q) (w v dt)^2: each bounce changes the speed by up to (w dt)^2/8 of it, and the duration
    of each flight after it, 4 falls over v, as much. The heights of the last flight err by up to
    the sum of all flights before it, or by twice the sum of all changes of speed. A contact of the
    duration (pi + 2 atan(g/(w v)))/w is ahead by (w dt)^2/24 of that.
    """
    flights, speeds = bounces * (bounces - 1) / 4, bounces / 4
    return max(flights, speeds) + bounces * slow * (math.pi + 2 * math.atan(slow)) / 12


def half_steps(drop: Drop, pieces: list[Piece]) -> float:
    """The error of the height of methods of first order over its largest change and w dt.

    pieces: a fall of height h, contacts and flights. A start half a step late shifts all by dt/2,
    at a speed of up to sqrt(v^2 + (g/w)^2), v that of impact. The viscous force 2 z w m v of a
    contact begins up to half a step early or late, which changes the speed by z w dt, and acts half
    a step late, as if the mass were smaller by z w dt: that changes log e by pi z/2 times as much,
    and shortens the contact by pi z dt/2. Each bounce changes the speeds u of all flights after it,
    and so their durations 2 u/g; in a flight the height errs by the sum of these at its speed, or
    by the change of its top, u^2/g times that of the speed.
    """
    w, fall = math.sqrt(drop.kn / drop.m), pieces[0].height
    late, worst = 0.0, 0.0
    for n, flight in enumerate(pieces[2::2], 1):
        slowed = n * drop.z * (1 + math.pi * drop.z / 2)
        late += math.pi * drop.z / (2 * w)
        worst = max(worst, flight.speed * late, flight.speed**2 / drop.g * slowed)
        late += 2 * flight.speed / drop.g * slowed
    shifted = math.hypot(pieces[1].speed, drop.g / w) / (2 * w)
    return (shifted + worst) / (fall + deepest(drop, pieces))


def deepest(drop: Drop, pieces: list[Piece]) -> float:
    """The largest overlap [m], which is that of the first contact."""
    lasts = np.linspace(0.0, pieces[2].since - pieces[1].since, 1001)
    return float(-min(drop.contact(float(t), pieces[1].speed)[0] for t in lasts))


def ahead(angle: float) -> float:
    """The error of a leapfrog over (w dt)^2 after an angle w T [rad].

    Phases are ahead by (w dt)^2/24 of the angle, and amplitudes are (w dt)^2/8 too large; no less
    than 2, twice that of an angle of 24 - 3.
    """
    return max(2.0, 0.125 + angle / 24.0)


def lags(sinking: Sinking, until: float, unit: float) -> tuple[float, float]:
    """Errors of depth and speed of a leapfrog over their maxima and (dt/unit)^2.

    Speeds in the middle of steps start with an error of
    -(dt^2/8) v'' and follow V' = f(V) by the implicit midpoint rule, whose error E obeys
    E' = f' E - dt^2 (v'''/24 - f' v''/8), with v'' = f' v'. Its solution is a multiple of v': the
    mean of two such speeds differs from v by dt^2 v'/12 times f'(v) - f'(v0) + int f'^2 dt. The sum
    of the speeds differs from the depth by the integral of that and by dt^2/6 of the change of v'.
    """
    brief = np.linspace(0.0, min(until, 20 / sinking.quickest), FINE)
    t = np.union1d(brief, np.linspace(brief[-1], until, FINE))
    depth, v = motion(t, sinking)
    pull, slope = sinking.rate(v), sinking.slope(v)
    speed = pull / 12 * (slope - slope[0] + _integral(t, slope**2))
    below = _integral(t, speed) - (pull - pull[0]) / 6
    errors = (
        float(np.abs(error).max() / np.abs(whole).max()) * unit**2
        for error, whole in ((below, depth), (speed, v))
    )
    deep, fast = errors
    return max(HIGHER * deep, LEAST), max(HIGHER * fast, LEAST)


def _integral(t: Vector, rate: Vector) -> Vector:
    """The integral of a rate from the first time to each, by the trapezoidal rule."""
    return np.concatenate([[0.0], np.cumsum(np.diff(t) * (rate[1:] + rate[:-1]) / 2)])

"""Second route to the block on an incline: Coulomb's law integrated numerically, mode by mode.

In one direction velocity and displacement are integrals of gravity, drive and friction by Gauss
quadrature over pieces of an eighth of a period. A grid in each piece brackets the sign changes of
the velocity or the margin of friction, and Brent's method finds the event. In two directions speed
and heading are integrated by an explicit Runge-Kutta method from just after the beginning of each
slip, where the speed is the integral of |T| - F and the heading lags behind T by the first term of
its series. Parameters are those of `reference_solutions.blocks.incline`, whose code is not used
here.

A slip or rest shorter than the grid, 1/512 of a period, can be missed.
"""

from collections.abc import Callable
from math import atan2, cos, hypot, pi, radians, sin, tan

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Push = Callable[[Array], Array]

_GRID = 64
_EARLY = 0.5 ** np.arange(20, 0, -1)  # of a step: where a slip that stops within it is looked for
_MOST = 2000
_RTOL = 1e-11
_STOPPED = 1e-7  # of g over the greater angular frequency: the speed at which a slip ends
_X, _W = (0.5 * v for v in np.polynomial.legendre.leggauss(14))
_X = _X + 0.5


def newmark(
    t: ArrayLike, *, alpha: float, phi: float, A: float, f: float, g: float, v0: float
) -> Array:
    """d [m] at times t [s], by d'' = T - F sign(d'), or at rest while |T| <= F."""
    slope, mu = radians(alpha), tan(radians(phi))

    def pull(s: Array) -> Array:
        return g * sin(slope) + A * np.sin(2.0 * pi * f * s) * cos(slope)

    def limit(s: Array) -> Array:
        return mu * (g * cos(slope) - A * np.sin(2.0 * pi * f * s) * sin(slope))

    t = np.asarray(t, dtype=np.float64)
    y, now, d, v, way = np.full(t.shape, np.nan), 0.0, 0.0, v0, np.sign(v0)
    for _ in range(_MOST):
        s = np.linspace(now, now + 0.125 / f, _GRID)
        if way == 0.0:
            then, way = _rest(pull, limit, s)
            y[(now <= t) & (t <= then)] = d
        else:
            acceleration = _sliding(pull, limit, way)
            then, stopped = _slide(acceleration, s, v, way)
            here = (now <= t) & (t <= then)
            y[here] = d + _moved(acceleration, now, t[here], v)[1]
            v, moved = _moved(acceleration, now, np.array([then]), v)[:, 0]
            d += moved
            v, way = (0.0, 0.0) if stopped else (v, way)
        if then > t.max():
            return y
        now = then
    raise RuntimeError(f"{_MOST} pieces did not reach t = {t.max()} s")


def _sliding(pull: Push, limit: Push, way: float) -> Push:
    return lambda s: pull(s) - way * limit(s)


def _moved(acceleration: Push, begin: float, t: Array, v: float) -> Array:
    """The velocity at times t, and the displacement since `begin`, where it was v, (2, n)."""
    span = t - begin
    a = acceleration(begin + np.multiply.outer(span, _X))
    moved = v + span * (a @ _W), span * (v + span * (a @ (_W * (1.0 - _X))))
    return np.array(moved)


def _slide(acceleration: Push, s: Array, v: float, way: float) -> tuple[float, bool]:
    """The time until which a slip lasts, at most the end of s, and whether it stops then."""

    def speed(time: Array) -> Array:
        gained: Array = way * _moved(acceleration, s[0], time, v)[0]
        return gained

    s = np.concatenate([s[:1], s[0] + np.diff(s[:2]) * _EARLY, s[1:]])
    falls = np.flatnonzero((speed(s[:-1]) > 0.0) & (speed(s[1:]) <= 0.0))
    if not falls.size:
        return float(s[-1]), False
    low, high = s[falls[0]], s[falls[0] + 1]
    return _zero(speed, low, high), True


def _zero(function: Push, low: float, high: float) -> float:
    """The time between two at which a function changes its sign.

    Where forces cancel, at phi = alpha, it is rounding: at a single time it may have another sign
    than among many. The end at which the function is smaller is then the zero.
    """
    from scipy.optimize import brentq

    def at(time: float) -> float:
        return float(function(np.array(time)))

    if np.sign(at(low)) == np.sign(at(high)):
        return float(min(low, high, key=lambda time: abs(at(time))))
    return float(brentq(at, low, high, xtol=1e-15))


def _rest(pull: Push, limit: Push, s: Array) -> tuple[float, float]:
    """The time until which a rest lasts, at most the end of s, and the direction of slip."""

    def excess(time: Array) -> Array:
        return np.abs(pull(time)) - limit(time)

    if excess(s[0]) > 0.0:
        return float(s[0]), float(np.sign(pull(s[0])))
    over = np.flatnonzero(excess(s) > 0.0)
    if not over.size:
        return float(s[-1]), 0.0
    low, high = s[over[0] - 1], s[over[0]]
    return _zero(excess, low, high), float(np.sign(pull(high)))


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
    """x and y [m] at increasing times t (n,) [s], (n, 2), from speed and heading."""
    slope, mu = radians(alpha), tan(radians(phi))

    def drive(s: Array | float) -> tuple[Array, Array, Array]:
        along, across = ax * np.sin(2.0 * pi * fx * s), ay * np.sin(2.0 * pi * fy * s)
        normal = g * cos(slope) - along * sin(slope)
        return g * sin(slope) + along * cos(slope), across, mu * normal

    t = np.asarray(t, dtype=np.float64)
    scale = 1.0 / (2.0 * pi * max(fx, fy))
    y, now, here = np.full((len(t), 2), np.nan), 0.0, np.zeros(2)
    for _ in range(_MOST):
        then = _wake(drive, now, t[-1], scale)
        y[(now <= t) & (t <= then)] = here
        if then >= t[-1]:
            return y
        now, here = _turn(drive, then, here, t, y, scale, _STOPPED * g * scale)
        if now >= t[-1]:
            return y
    raise RuntimeError(f"{_MOST} slips did not reach t = {t[-1]} s")


Drive = Callable[[Array | float], tuple[Array, Array, Array]]


def _wake(drive: Drive, now: float, end: float, scale: float) -> float:
    """The first time at which |T| exceeds F, at most `end`."""

    def excess(s: Array) -> Array:
        tx, ty, limit = drive(s)
        spare: Array = np.hypot(tx, ty) - limit
        return spare

    s = np.arange(now, end + scale, 0.02 * scale)
    over = np.flatnonzero(excess(s) > 1e-12)
    if not over.size:
        return end
    if over[0] == 0:
        return now
    low, high = s[over[0] - 1], s[over[0]]
    return _zero(excess, low, high)


def _turn(
    drive: Drive, begin: float, x: Array, t: Array, y: Array, scale: float, stopped: float
) -> tuple[float, Array]:
    """Fill in y at the times t of a slip from rest at x; return the time and place of its end."""
    from scipy.integrate import solve_ivp

    def rate(s: float, z: Array) -> tuple[float, float, float, float]:
        (tx, ty, limit), c, n = drive(s), cos(z[3]), sin(z[3])
        turn = (ty * c - tx * n) / z[2]
        return z[2] * c, z[2] * n, float(tx * c + ty * n - limit), float(turn)

    def slow(_: float, z: Array) -> float:
        return float(z[2] - stopped)

    slow.terminal, slow.direction = True, -1  # type: ignore[attr-defined]
    first, z = _launched(drive, begin, x, scale)
    early, late = (begin <= t) & (t < first), t >= first
    y[early] = x
    run = solve_ivp(
        rate,
        (first, max(t[-1], first)),
        z,
        method="DOP853",
        t_eval=t[late],
        events=slow,
        rtol=_RTOL,
        atol=_RTOL * stopped,
    )
    y[np.flatnonzero(late)[: len(run.t)]] = np.reshape(run.y, (4, -1))[:2].T
    if run.status == 0 or run.t_events is None or run.y_events is None:
        return float(t[-1]), x
    return float(run.t_events[0][0]), run.y_events[0][0][:2]


def _launched(drive: Drive, begin: float, x: Array, scale: float) -> tuple[float, Array]:
    """The time and the state x, y, speed, heading just after a slip begins.

    The heading is that of T at the fraction |T|/(2|T| - F) of the time since the slip began.
    """
    tx, ty, limit = drive(begin)
    pull = hypot(float(tx), float(ty))
    span = scale * (1e-5 if pull - limit > 1e-3 * pull else 3e-3)
    px, py, held = drive(begin + span * _X)
    lx, ly, _ = drive(begin + span * pull / (2.0 * pull - float(limit)))
    net = np.hypot(px, py) - held
    heading = atan2(float(ly), float(lx))
    gone = span**2 * float(net @ (_W * (1.0 - _X)))
    place = x + gone * np.array([cos(heading), sin(heading)])
    return begin + span, np.array([*place, span * float(net @ _W), heading])

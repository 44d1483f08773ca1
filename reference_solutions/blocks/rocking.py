"""A block that rocks on a floor without slip under a sine of finite duration (Housner 1963).

A block of half sides b and h leans by theta about the corner it stands on, positive towards +x:
theta'' = p^2 (-sin(alpha - theta) + (a/g) cos(alpha - theta)) for theta > 0 and its mirror image
for theta < 0, with tan(alpha) = b/h, R^2 = b^2 + h^2, p^2 = 3 g/(4 R) and a = A sin(w t) until T.
The upright block stands until |a| > g tan(alpha). When the block lands, its rate is multiplied by
1 - 1.5 sin^2(alpha), which conserves the angular momentum about the other corner (Makris and
Roussos 2000). Every function raises ValueError for parameters outside their ranges.
"""

from math import asin, atan2, cos, exp, hypot, inf, pi, sin, sqrt, tan

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_positive, require_times

Array = NDArray[np.float64]

_LEAST = 1e-7  # of p: a rate below which the block counts as at rest
_SHARP = {"rtol": 1e-12, "atol": 1e-14}


def slenderness(b: float, h: float, g: float) -> tuple[float, float]:
    """The slenderness alpha [rad] and the frequency parameter p [1/s]."""
    require_positive("in SI units", b=b, h=h, g=g)
    return atan2(b, h), sqrt(0.75 * g / hypot(b, h))


def restitution(b: float, h: float) -> float:
    """The angular velocity after an impact over that before; 0 for a block too squat to rock on."""
    return max(0.0, 1.0 - 1.5 * sin(atan2(b, h)) ** 2)


def leans(
    t: ArrayLike, *, b: float, h: float, g: float,
    A: float = 0.0, w: float = 1.0, T: float = 0.0, theta: float = 0.0,
) -> Array:  # fmt: skip
    """theta (k,) [rad] at increasing times (k,) [s], from rest at theta [rad] or upright.

    A [m/s2], w [rad/s], T [s]: amplitude, angular frequency and end of the sine. Beyond alpha the
    block falls and stays at rest at pi/2.
    """
    return phases(t, b=b, h=h, g=g, A=A, w=w, T=T, theta=theta)[:, 0]


def phases(
    t: ArrayLike, *, b: float, h: float, g: float,
    A: float = 0.0, w: float = 1.0, T: float = 0.0, theta: float = 0.0,
) -> Array:  # fmt: skip
    """theta [rad] and its rate [1/s], (k, 2), for the arguments of `leans`.

    At an impact the rate is that before it.
    """
    times = require_times(t)
    alpha, p = slenderness(b, h, g)
    found = np.empty((len(times), 2))
    now, state = 0.0, (theta, 0.0)
    while now <= times[-1]:
        if state == (0.0, 0.0):
            begins = _tips(now, A, w, T, g * tan(alpha))
            found[times >= now] = 0.0
            if not begins < times[-1]:
                break
            now = begins
        side = 1.0 if state[0] > 0 or (state[0] == 0 and _way(state[1], A, w, now) > 0) else -1.0
        now, state = _swing(times, found, now, state, side, (alpha, p, A / g, w, T))
        rises = state[1] * restitution(b, h)
        state = (0.0, rises if abs(rises) > _LEAST * p else 0.0)
    return found


def _way(rate: float, A: float, w: float, now: float) -> float:
    """The direction in which an upright block starts to lean."""
    return rate if rate != 0.0 else A * sin(w * now)


def _tips(now: float, A: float, w: float, T: float, most: float) -> float:
    """The time when a block that is upright at `now` begins to lean; infinity if it does not."""
    if not most < A:
        return inf
    for k in range(int(w * T / pi) + 1):
        begins = (k * pi + asin(most / A)) / w
        if now <= begins < T:
            return begins
    return inf


def _swing(
    times: Array, found: Array, now: float, state: tuple[float, float], side: float,
    law: tuple[float, ...],
) -> tuple[float, tuple[float, float]]:  # fmt: skip
    """Fill in the leans until the block meets the floor; return the time and the state then."""
    from scipy.integrate import solve_ivp

    alpha, p, part, w, T = law

    def rate(t: float, y: Array, on: float) -> list[float]:
        pull = on * part * sin(w * t)
        return [y[1], p**2 * (-side * sin(alpha - side * y[0]) + pull * cos(alpha - side * y[0]))]

    def floor(t: float, y: Array, on: float) -> float:
        return side * float(y[0])

    def flat(t: float, y: Array, on: float) -> float:
        return side * float(y[0]) - pi / 2

    floor.terminal = flat.terminal = True  # type: ignore[attr-defined]
    floor.direction = -1  # type: ignore[attr-defined]
    last = float(times[-1])
    for end, on in ((T, 1.0), (inf, 0.0)):
        if not now < min(end, last * 1.000001):
            continue
        span = (now, min(end, last * 1.000001))
        one = solve_ivp(rate, span, state, "DOP853", events=(floor, flat), args=(on,),
                        dense_output=True, **_SHARP)  # fmt: skip
        here = (times >= now) & (times <= one.t[-1])
        found[here] = one.sol(times[here]).T if here.any() else 0.0
        now, state = float(one.t[-1]), (float(one.y[0, -1]), float(one.y[1, -1]))
        if len(one.t_events[1]):
            found[times > now] = side * pi / 2, 0.0
            return inf, state
        if len(one.t_events[0]):
            return now, (0.0, state[1])
    return inf, state


def excess(A: float, *, b: float, h: float, g: float, w: float) -> float:
    """theta'^2/2 [1/s2] at the end of a half sine, minus the value at which the block overturns."""
    from scipy.integrate import solve_ivp

    alpha, p = slenderness(b, h, g)
    if not g * tan(alpha) < A:
        raise ValueError(f"A = {A} m/s2; a block leans from g tan(alpha) = {g * tan(alpha)} on")
    begins = asin(g * tan(alpha) / A) / w

    def rate(t: float, y: Array) -> list[float]:
        lean = alpha - y[0]
        return [y[1], p**2 * (-sin(lean) + A / g * sin(w * t) * cos(lean))]

    end = solve_ivp(rate, (begins, pi / w), [0.0, 0.0], "DOP853", **_SHARP).y[:, -1]
    return float(end[1] ** 2 / 2 + p**2 * (cos(alpha - end[0]) - 1))


def overturns(*, b: float, h: float, g: float, A: float, w: float) -> float:
    """The time [s] at which a half sine has overturned the block.

    The block then leans by 2 alpha, where its centre is as low as in the upright position. Raises
    ValueError for a block that is no higher than wide, or that does not overturn.
    """
    from scipy.integrate import solve_ivp

    alpha, p = slenderness(b, h, g)
    if not b < h:
        raise ValueError(f"b = {b} m, h = {h} m; a block overturns only if it is higher than wide")
    if not excess(A, b=b, h=h, g=g, w=w) > 0.0:
        raise ValueError(f"A = {A} m/s2 does not overturn it")

    def rate(t: float, y: Array, on: float) -> list[float]:
        lean = alpha - y[0]
        return [y[1], p**2 * (-sin(lean) + on * A / g * sin(w * t) * cos(lean))]

    def over(t: float, y: Array, on: float) -> float:
        return float(y[0]) - 2.0 * alpha

    over.terminal = True  # type: ignore[attr-defined]
    now, state = asin(g * tan(alpha) / A) / w, np.zeros(2)
    for end, on in ((pi / w, 1.0), (inf, 0.0)):
        span = (now, min(end, now + 100.0 / p))
        one = solve_ivp(rate, span, state, "DOP853", events=over, args=(on,), **_SHARP)
        now, state = float(one.t[-1]), one.y[:, -1]
        if len(one.t_events[0]):
            break
    return now


def threshold(*, b: float, h: float, g: float, w: float) -> float:
    """The least amplitude [m/s2] of a half sine that overturns the block without an impact."""
    from scipy.optimize import brentq

    low = 1.0001 * g * tan(slenderness(b, h, g)[0])
    law = {"b": b, "h": h, "g": g, "w": w}
    if excess(low, **law) > 0.0:
        raise ValueError(
            f"w = {w} 1/s; such a slow sine overturns every block that it lifts, to 1e-4"
        )
    high = 1.05 * low
    while excess(high, **law) < 0.0:
        low, high = high, 1.05 * high
    return float(brentq(lambda A: excess(A, **law), low, high, xtol=1e-12, rtol=1e-14))


def linear_threshold(*, b: float, h: float, g: float, w: float) -> float:
    """The least amplitude [m/s2] by the equation that is linearised for small angles.

    It is alpha g/sin(psi), where (w/p) sin(psi) = cos(psi) + exp(-(p/w)(pi - psi)) (Makris and
    Roussos 2000).
    """
    from scipy.optimize import brentq

    alpha, p = slenderness(b, h, g)
    psi = brentq(
        lambda s: w / p * sin(s) - cos(s) - exp(-p / w * (pi - s)), 1e-9, pi / 2, xtol=1e-15
    )
    return alpha * g / sin(psi)

"""The velocity of a slip after a time in which the forces on it do not change, in closed form.

With dt = |w| dtau, the law w' = T - F w/|w| is dw/dtau = |w| T - F w, d|w|/dtau = T.w - F |w|. For
constant T along x and constant F this leaves two equations of one unknown each:

    p = |w| + w_x:  dp/dtau = (T - F) p,   q = |w| - w_x:  dq/dtau = -(T + F) q,   w_y^2 = p q

so that t = p0 (e^{(T - F) tau} - 1)/(2 (T - F)) + q0 (1 - e^{-(T + F) tau})/(2 (T + F)).
"""

from __future__ import annotations

import math

from vv.engines.exact.roots import EPS
from vv.engines.kernels.compiled import lent

MOST_ITERATIONS = 60
NEAR = 2e-3  # relative error in time from which a step of third order leaves no more than 1e-8
LEAST = 0.04  # of the square under the root of the first guess, which is negative near a stop
SMALL = 1e-4


@lent
def slowly_turned(
    u: float, v: float, x: float, y: float, friction: float, h: float
) -> tuple[float, float]:
    """The same as `frozen_slip` by the series in time of the direction n of slip, to third order.

    w = w0 + h T - F times the integral of n. With T_n, T_m along n and across it, n turns at the
    rate k = T_m/|w|, where k' = k (F - 2 T_n)/|w| and k'' = k' (2 F - 3 T_n)/|w| - 2 k^3.
    """
    over = 1.0 / math.sqrt(u * u + v * v)
    c, d = u * over, v * over
    along, turn = c * x + d * y, (c * y - d * x) * over
    bent = turn * (friction - 2 * along) * over
    jerk = bent * (2 * friction - 3 * along) * over - 3 * turn * turn * turn
    kept = h - h * h * h / 6 * turn * (turn + 0.75 * h * bent)
    aside = h * h * (0.5 * turn + h / 6 * (bent + 0.25 * h * jerk))
    return (
        u + h * x - friction * (kept * c - aside * d),
        v + h * y - friction * (kept * d + aside * c),
    )


@lent
def frozen_slip(
    u: float, v: float, x: float, y: float, friction: float, h: float
) -> tuple[float, float, float]:
    """The velocity of slip after h [s], from (u, v) [m/s] under (x, y) and friction [m/s2].

    A body that comes to rest stays there unless T exceeds F, and then starts along T. The third
    number is the time [s] in which the first slip ends, or h if it does not.
    """
    pull, speed = math.sqrt(x * x + y * y), math.sqrt(u * u + v * v)
    c, d = (x / pull, y / pull) if pull > 0.0 else (1.0, 0.0)
    grows, left = pull - friction, 0.0
    if speed > 0.0:
        along, across = u * c + v * d, v * c - u * d
        p = speed + along if along >= 0.0 else across * across / (speed - along)
        q = across * across / (speed + along) if along >= 0.0 else speed - along
        if p <= EPS * EPS * q:
            p = 0.0  # it moves against T and not across it, and so stops
        if p > 0.0 and grows >= 0.0:
            left = math.inf
        else:
            left = -0.5 * p / grows if p > 0.0 else 0.0
            left += 0.5 * q / (pull + friction) if q > 0.0 else 0.0
        if left > h:
            along, across = _slipped(p, q, across, grows, pull + friction, h / speed, h)
            return c * along - d * across, d * along + c * across, h
    along = max(grows, 0.0) * (h - left)
    return c * along, d * along, left


@lent
def _slipped(
    p: float, q: float, across: float, a: float, b: float, guess: float, h: float
) -> tuple[float, float]:
    """The components of a slip along T and across it after h [s]; a = T - F, b = T + F.

    guess: h/|w|, from which a parabola of t over tau begins.
    """
    bent = 1.0 + 2.0 * guess * (a * p - b * q) / (p + q)
    tau, low, high = 2.0 * guess / (1.0 + math.sqrt(max(bent, LEAST))), 0.0, math.inf
    if p > 0.0 and a > 0.0:
        high = math.log1p(2 * a * h / p) / a  # at which p alone takes that time
        tau = min(tau, high)
    done = False
    for _ in range(MOST_ITERATIONS):
        risen, fallen = _growth(a * tau), -_growth(-b * tau)
        first, second = p * (1.0 + risen), q * (1.0 - fallen)
        if done:
            break
        late = 0.5 * (p * (risen / a if a != 0.0 else tau)) - h
        late += 0.5 * (q * (fallen / b if b != 0.0 else tau))
        rate = 0.5 * (first + second)
        step = late / rate
        step /= max(1.0 - 0.25 * step * (a * first - b * second) / rate, 0.5)
        done = abs(late) <= NEAR * h
        if late > 0.0:
            high = tau
        else:
            low = tau
        tau -= step
        if not low <= tau <= high:
            tau = 0.5 * (low + high) if high < math.inf else 2 * low
    return 0.5 * (first - second), math.copysign(math.sqrt(first * second), across)


@lent
def _growth(x: float) -> float:
    """e^x - 1 to 1e-12, which expm1 takes half as long again to find to rounding."""
    return math.exp(x) - 1.0 if abs(x) > SMALL else x * (1.0 + 0.5 * x * (1.0 + x / 3))

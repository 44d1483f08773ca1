"""The oblique impact of a body on a wall with a spring, a dashpot and friction, by stages.

Along the normal m u'' = -N, N = kn u + c u' from u = 0, u' = v at t = 0 until N falls to zero, in
closed form; u [m] is the overlap, and z = c/(2 sqrt(kn m)) lies in [0, 1). Along the wall m x'' =
-T. While the contact sticks, T' = ks x'. |T| is at most mu N, N with its viscous part; once the
spring force would exceed this limit, the contact slips with T = +-mu N. It sticks again once x',
positive in the direction of slip, no longer exceeds the rate mu N'/ks at which the limit stretches
the spring. The body does not rotate. Each stage of stick or slip is integrated by an explicit
Runge-Kutta method of order 8 up to the event that ends it, which is located.
"""

from collections.abc import Callable
from math import asin, pi, sqrt
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
STICK, FORWARD, BACKWARD = 0, 1, -1  # modes: the sign of T in slip, 0 in stick


class Impact(NamedTuple):
    """kn, ks [N/m], mu, z as above; m [kg]; v, along: speeds [m/s] normal to the wall and along."""

    m: float
    kn: float
    ks: float
    mu: float
    z: float
    v: float
    along: float

    @property
    def end(self) -> float:
        """The time [s] at which the normal force falls to zero."""
        return (pi - 2.0 * asin(self.z)) / sqrt(self.kn / self.m * (1.0 - self.z**2))

    def normal(self, t: Array | float) -> tuple[Any, Any, Any]:
        """The overlap [m], the force N [N] and its rate [N/s] at times t [s] up to `end`."""
        w = sqrt(self.kn / self.m)
        fades, wd, c = self.z * w, w * sqrt(1.0 - self.z**2), 2.0 * self.z * sqrt(self.kn * self.m)
        swing = self.v / wd * np.exp(-fades * t)
        sine, cosine = np.sin(wd * t), np.cos(wd * t)
        u, rate = swing * sine, swing * (wd * cosine - fades * sine)
        force = self.kn * u + c * rate
        return u, force, self.kn * rate - c * force / self.m


def motion(t: ArrayLike, impact: Impact) -> tuple[Array, Array]:
    """Displacements along the wall and away from it [m] at times t (n,) [s] from 0 on."""
    t = np.asarray(t, dtype=np.float64)
    along, pressed = np.empty_like(t), np.minimum(t, impact.end)
    now, y, mode = 0.0, np.array([0.0, impact.along, 0.0]), STICK
    while now < impact.end:
        last, found, after = _mode(impact, now, y, mode)
        inside = (pressed >= now) & (pressed <= last)
        if inside.any():
            along[inside] = found.sol(pressed[inside])[0]
        now, y, mode = last, found.y[:, -1], after
    leaving = impact.normal(impact.end)
    u, speed = impact.normal(pressed)[0], -leaving[2] / impact.kn
    return along + y[1] * (t - pressed), -u + speed * (t - pressed)


def _mode(impact: Impact, now: float, y: Array, mode: int) -> tuple[float, Any, int]:
    """The end [s] of a mode, the integrated y = (x, x', T) up to it, and the next mode."""
    from scipy.integrate import solve_ivp

    def rate(t: float, y: Array) -> Array:
        if mode == STICK:
            return np.array([y[1], -y[2] / impact.m, impact.ks * y[1]])
        _, force, changes = impact.normal(t)
        return np.array([y[1], -mode * impact.mu * force / impact.m, mode * impact.mu * changes])

    def room(sign: int) -> Callable[[float, Array], float]:
        return lambda t, y: float(impact.mu * impact.normal(t)[1] - sign * y[2])

    def slips(t: float, y: Array) -> float:
        return float(mode * y[1] - impact.mu * impact.normal(t)[2] / impact.ks)

    ends = [(room(FORWARD), FORWARD), (room(BACKWARD), BACKWARD)] if mode == STICK else []
    events: list[Any] = [event for event, _ in ends] or [slips]
    for event in events:
        event.terminal, event.direction = True, -1
    unit = sqrt(impact.m / impact.kn)
    scale = np.array([impact.v * unit, impact.v, impact.v * sqrt(impact.kn * impact.m)])
    found = solve_ivp(
        rate, (now, impact.end), y, "DOP853", dense_output=True, events=events,
        rtol=1e-13, atol=1e-13 * scale, max_step=0.02 * unit,
    )  # fmt: skip
    after = [sign for (_, sign), times in zip(ends, found.t_events, strict=False) if len(times)]
    return float(found.t[-1]), found, after[0] if after else STICK

"""A sphere that bounces on a floor with friction and spin, solved stage by stage.

The sphere (radius r, density rho, I = 2/5 m r^2) starts at a gap above the floor under gravity g,
with v_n towards the floor, v_t along it, and the spin w; it rolls without slip if v_t = r w.
The normal force of the floor is kn U for an overlap U > 0. The friction F is that of a shear
spring: F' = -ks s with the slip velocity s = v_x - r w of the contact point and |F| <= mu kn U
(Li et al. 2018, Eqs. 4-8). F is zero when the contact closes.

The normal motion does not depend on friction. It is a parabola in flight. In contact, at the time
tau after it closed, U = (v/k) sin k tau + (g/k^2)(1 - cos k tau), k^2 = kn/m, where v is the speed
with which the sphere meets the floor and leaves it. As s' = 7/2 F/m, the spring oscillates at kt^2
= 7/2 ks/m while the contact sticks; while it slips, F = +-mu kn U is known. It slips once |F|
reaches mu kn U, and sticks again once, in the direction of F, the rate -ks s of the spring force no
longer exceeds the rate mu kn U' of the limit. The velocity of the centre changes by 2/7 of every
change of s.

Every function raises ValueError for parameters outside their ranges.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from math import atan2, copysign, pi, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import (
    require_finite,
    require_positive,
    require_times,
)

Array = NDArray[np.float64]

CELLS, MOST = 2000, 1000  # parts of a contact to find an event; most bounces
YIELD = 3.5  # m s'/F: 1 + m r^2/I


class Normal(NamedTuple):
    """The motion normal to the floor in a contact: rates k and kt [1/s], speed v [m/s], g, mu."""

    k: float
    kt: float
    v: float
    g: float
    mu: float

    def overlap(self, tau: Array) -> Array:
        """U [m] at tau [s] after the contact closed."""
        x = self.k * tau
        return self.v / self.k * np.sin(x) + 2.0 * self.g / self.k**2 * np.sin(x / 2.0) ** 2

    def rate(self, tau: Array) -> Array:
        """U' [m/s]."""
        x = self.k * tau
        return self.v * np.cos(x) + self.g / self.k * np.sin(x)

    def once(self, tau: Array) -> Array:
        """k^2 times the integral of U since the contact closed [m/s]."""
        x = self.k * tau
        return 2.0 * self.v * np.sin(x / 2.0) ** 2 + self.g * (tau - np.sin(x) / self.k)

    def twice(self, tau: Array) -> Array:
        """k^2 times the integral of that integral [m]."""
        x = self.k * tau
        swung = tau - np.sin(x) / self.k
        fell = tau**2 / 2.0 - 2.0 * np.sin(x / 2.0) ** 2 / self.k**2
        return self.v * swung + self.g * fell

    @property
    def duration(self) -> float:
        """The time in contact [s], at whose end the speed is v again."""
        return 2.0 * (pi - atan2(self.v * self.k, self.g)) / self.k


@dataclass(frozen=True)
class Stage:
    """A stage that begins at `begin` [s], the time `tau` [s] after the contact closed.

    way: 0 while the contact sticks, otherwise the sign of the friction. s: slip velocity [m/s]; f:
    friction over mass [m/s2]; x, v: displacement and velocity of the centre along the floor [m,
    m/s]; z, rise: those upwards at the start of a flight, in which `normal` is None.
    """

    begin: float
    x: float
    v: float
    z: float
    rise: float
    s: float = 0.0
    f: float = 0.0
    tau: float = 0.0
    way: float = 0.0
    normal: Normal | None = None

    @property
    def name(self) -> str:
        """The name of the stage."""
        return "flight" if self.normal is None else "slip" if self.way else "stick"


# The case passes its parameters by name, one for one.
def floor(
    t: ArrayLike,
    *,
    rho: float,
    r: float,
    kn: float,
    ks: float,
    mu: float,
    g: float,
    gap: float,
    v_n: float,
    v_t: float,
    w: float,
) -> Array:
    """Displacements (..., 2) [m] along the floor and up, at times t >= 0 [s] of any shape."""
    t = require_times(t)
    p = {"rho": rho, "r": r, "kn": kn, "ks": ks, "mu": mu, "g": g, "gap": gap}
    stages = floor_stages(float(t.max(initial=0.0)), v_n=v_n, v_t=v_t, w=w, **p)
    moved = np.empty((*t.shape, 2))
    which = np.searchsorted([stage.begin for stage in stages], t, side="right") - 1
    for i, stage in enumerate(stages):
        here = which == i
        moved[here] = _moved(stage, t[here] - stage.begin, g)
    return moved


@lru_cache(maxsize=64)
# The case passes its parameters by name, one for one.
def floor_stages(
    end: float,
    *,
    rho: float,
    r: float,
    kn: float,
    ks: float,
    mu: float,
    g: float,
    gap: float,
    v_n: float,
    v_t: float,
    w: float,
) -> tuple[Stage, ...]:
    """The stages that begin up to `end` [s], in order."""
    if not mu > 0.0:
        raise ValueError(f"mu = {mu}; it must be positive, since friction ends slip and begins it")
    require_positive("in SI units", rho=rho, r=r, kn=kn, ks=ks, mu=mu, g=g, gap=gap)
    require_finite("in SI units", v_n=v_n, v_t=v_t, w=w)
    m = rho * 4.0 / 3.0 * pi * r**3
    speed = sqrt(v_n**2 + 2.0 * g * gap)
    normal = Normal(sqrt(kn / m), sqrt(YIELD * ks / m), speed, g, mu)
    stages = [Stage(0.0, 0.0, v_t, 0.0, -v_n, v_t - r * w)]
    for _ in range(MOST):
        last = stages[-1]
        flown = (last.rise + speed) / g
        begin = last.begin + flown
        if begin > end:
            return tuple(stages)
        x = last.x + last.v * flown
        touching = Stage(begin, x, last.v, -gap, 0.0, last.s, normal=normal)
        stages += _contact(touching, normal)
    raise ValueError(f"g = {g} m/s2; the sphere bounces more than {MOST} times by {end} s")


def _contact(stage: Stage, normal: Normal) -> list[Stage]:
    """The stages of a contact, and the flight after it."""
    if abs(stage.s) * normal.kt**2 / YIELD > normal.mu * normal.k**2 * normal.v:
        stage = replace(stage, way=-copysign(1.0, stage.s))
    stages = [stage]
    while True:
        stage = stages[-1]
        tau = _first_fall(_margin(stage, normal), stage.tau, normal.duration)
        later = _later(stage, normal.duration if tau is None else tau)
        if tau is None:
            flight = replace(later, f=0.0, tau=0.0, way=0.0, rise=normal.v, normal=None)
            return [*stages, flight]
        stages.append(replace(later, way=0.0 if stage.way else copysign(1.0, later.f)))


def _margin(stage: Stage, normal: Normal) -> Callable[[Array], Array]:
    """The margin that falls below zero where the stage ends: of |F| in stick, of F' in slip."""
    k, mu = normal.k, normal.mu

    def of_cap(tau: Array) -> Array:
        return mu * k**2 * normal.overlap(tau) - np.abs(_sheared(stage, tau)[1])

    def of_rate(tau: Array) -> Array:
        trial = -stage.way * normal.kt**2 / YIELD * _sheared(stage, tau)[0]
        return np.asarray(trial - mu * k**2 * normal.rate(tau))

    return of_rate if stage.way else of_cap


def _sheared(stage: Stage, tau: Array) -> tuple[Array, Array, Array]:
    """Slip velocity [m/s], friction over mass [m/s2] and slip [m] since the stage began."""
    normal = stage.normal
    assert normal is not None
    k, kt, since = normal.k, normal.kt, tau - stage.tau
    if stage.way:
        pull = YIELD * stage.way * normal.mu
        start = np.asarray(stage.tau)
        s = stage.s + pull * (normal.once(tau) - normal.once(start))
        grown = normal.twice(tau) - normal.twice(start) - normal.once(start) * since
        f = stage.way * normal.mu * k**2 * normal.overlap(tau)
        return s, f, stage.s * since + pull * grown
    c, sn = np.cos(kt * since), np.sin(kt * since)
    s = stage.s * c + YIELD * stage.f / kt * sn
    f = stage.f * c - kt * stage.s / YIELD * sn
    slid = stage.s / kt * sn + 2.0 * YIELD * stage.f / kt**2 * np.sin(kt * since / 2.0) ** 2
    return s, f, slid


def _later(stage: Stage, tau: float) -> Stage:
    """The state at tau, as the start of the next stage."""
    s, f, slid = (float(value) for value in _sheared(stage, np.asarray(tau)))
    since = tau - stage.tau
    return replace(
        stage,
        begin=stage.begin + since,
        x=stage.x + stage.v * since + (slid - stage.s * since) / YIELD,
        v=stage.v + (s - stage.s) / YIELD,
        s=s,
        f=f,
        tau=tau,
    )


def _moved(stage: Stage, since: Array, g: float) -> Array:
    """Displacements (k, 2) [m] at the times `since` (k,) [s] after the stage began."""
    along = stage.x + stage.v * since
    if stage.normal is None:
        return np.stack([along, stage.z + stage.rise * since - g * since**2 / 2.0], axis=-1)
    tau = stage.tau + since
    slid = _sheared(stage, tau)[2]
    x = along + (slid - stage.s * since) / YIELD
    return np.stack([x, stage.z - stage.normal.overlap(tau)], axis=-1)


def _first_fall(margin: Callable[[Array], Array], begin: float, end: float) -> float | None:
    """The time at which a margin first turns negative after `begin`; None if it does not by `end`.

    The margin at `begin` is not evaluated: it may be zero there, with a sign due to rounding.
    """
    from scipy.optimize import brentq

    grid = np.linspace(begin, end, CELLS)[1:]
    below = np.flatnonzero(margin(grid) < 0.0)
    if not len(below):
        return None
    if below[0] == 0:
        raise ValueError(
            f"the contact sticks or slips for less than 1/{CELLS} of its duration, {begin:.3g} s "
            "after it closed; stages so short are not solved"
        )
    low, high = grid[below[0] - 1], grid[below[0]]
    return float(brentq(lambda x: float(margin(np.asarray(x))), low, high, xtol=1e-20, rtol=1e-15))

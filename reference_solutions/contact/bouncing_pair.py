"""Two free spheres that bounce on each other with friction and spin, from event to event.

Spheres of one density, radii r1 and r2, I = 2/5 m r^2, a gap apart along x, move in a plane and
spin about its normal, without gravity. The centre of the first is at rest and it spins at w1; the
second approaches at v_n, moves across at v_t and spins at w2. A constant load along x presses each
towards the other. An overlap U causes the repulsive force kn U along the line n of centres. Across
it, along e = z x n, a shear spring acts in the middle of the overlap, at the arms a = r - U/2, so
that angular momentum is conserved: F' = -ks s, s = (v2 - v1).e - (a1 w1 + a2 w2), |F| <= mu kn U
(Li et al. 2018, Eqs. 4-8). F rotates with n and is zero when the contact closes.

In flight both move along parabolas, and the time of contact is a root. In contact the equations of
motion are integrated to rounding, and the end of each stage is located as the root of a function:
the overlap, mu kn U - |F| in stick, or in slip the rate of the spring force less that of its limit.

Raises ValueError for parameters outside their ranges.
"""

from functools import lru_cache
from itertools import count
from math import copysign, pi, sqrt
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import (
    require_at_least_0,
    require_few,
    require_finite,
    require_positive,
    require_times,
)

Array = NDArray[np.float64]

RTOL = 3e-14  # the least that solve_ivp accepts is 2.2e-14
STEP = 0.05  # largest step times the rate of the normal spring
CELLS, MOST = 4000, 100  # parts of a flight to find its end; most stages
WORK = 10000  # most evaluations of the rates in a stage, which usually takes some hundred


class Pair(NamedTuple):
    """Radii [m], masses [kg], stiffnesses [N/m], friction, gap at t = 0 [m] and load [N]."""

    r: tuple[float, float]
    m: tuple[float, float]
    kn: float
    ks: float
    mu: float
    gap: float
    load: float

    def offset(self, z: Array) -> tuple[Array, Array, Array]:
        """The vector between the centres (2, k): its change since t = 0, its value, its rate."""
        start = np.array([self.gap + sum(self.r), 0.0]).reshape((2,) + (1,) * (z.ndim - 1))
        moved = z[2:4] - z[0:2]
        return moved, start + moved, z[6:8] - z[4:6]

    def overlap(self, z: Array) -> Array:
        """U [m], negative where the spheres are apart, computed without cancellation."""
        moved, d, _ = self.offset(z)
        start, length = self.gap + sum(self.r), np.hypot(*d)
        grown = moved[0] * (start + d[0]) + moved[1] * d[1]
        return np.asarray(-self.gap - grown / (start + length))

    def slip(self, z: Array) -> tuple[float, float]:
        """The rate U' of the overlap and the slip velocity s [m/s]."""
        _, d, rate = self.offset(z)
        n = d / np.hypot(*d)
        across = -n[1] * rate[0] + n[0] * rate[1]
        a1, a2 = self.arms(z)
        return float(-n @ rate), float(across - a1 * z[8] - a2 * z[9])

    def arms(self, z: Array) -> list[float]:
        """The distances from the centres to the middle of the overlap [m]."""
        return [r - float(self.overlap(z)) / 2.0 for r in self.r]

    def rates(self, z: Array, way: float) -> list[float]:
        """The rate of the state z in contact; way: 0 in stick, the sign of F in slip."""
        _, d, _ = self.offset(z)
        nx, ny = d / np.hypot(*d)
        closing, s = self.slip(z)
        pressed = self.kn * float(self.overlap(z))
        f = way * self.mu * pressed if way else z[10]
        px, py = pressed * nx - f * ny - self.load, pressed * ny + f * nx
        (m1, m2), (r1, r2), (a1, a2) = self.m, self.r, self.arms(z)
        spun = -2.5 * f * a1 / (m1 * r1**2), -2.5 * f * a2 / (m2 * r2**2)
        charged = way * self.mu * self.kn * closing if way else -self.ks * s
        return [*z[4:8], -px / m1, -py / m1, px / m2, py / m2, *spun, charged]

    def outrun(self, z: Array, way: float) -> float:
        """The rate of the spring force minus that of the friction limit [N/s]."""
        closing, s = self.slip(z)
        return -way * self.ks * s - self.mu * self.kn * closing

    def flown(self, z: Array, since: Array) -> Array:
        """The states (11, k) at the times `since` (k,) [s] after a flight began in the state z."""
        pull = np.array([self.load / self.m[0], 0.0, -self.load / self.m[1], 0.0])
        later = np.repeat(z[:, None], len(since), axis=1)
        later[:4] += np.outer(z[4:8], since) + np.outer(pull, since**2 / 2.0)
        later[4:8] += np.outer(pull, since)
        later[10] = 0.0
        return later


class Stage(NamedTuple):
    """A stage that begins at `begin` [s].

    z: the state at the begin of a flight, or at the end of a contact stage; states: a function of
    times (k,) [s] to states (11, k).
    """

    begin: float
    name: str
    z: Array
    states: Any


# The case passes its parameters by name, one for one.
def pair(
    t: ArrayLike,
    *,
    rho: float,
    r1: float,
    r2: float,
    kn: float,
    ks: float,
    mu: float,
    gap: float,
    v_n: float,
    v_t: float,
    w1: float,
    w2: float,
    load: float,
) -> Array:
    """Displacements (..., 4) [m] of the first sphere along x and y, and of the second."""
    t = require_times(t)
    stages = pair_stages(
        float(t.max(initial=0.0)), rho=rho, r1=r1, r2=r2, kn=kn, ks=ks, mu=mu, gap=gap,
        v_n=v_n, v_t=v_t, w1=w1, w2=w2, load=load,
    )  # fmt: skip
    moved = np.empty((*t.shape, 4))
    which = np.searchsorted([stage.begin for stage in stages], t, side="right") - 1
    for i, stage in enumerate(stages):
        here = which == i
        if here.any():
            moved[here] = stage.states(t[here])[:4].T
    return moved


@lru_cache(maxsize=64)
# The case passes its parameters by name, one for one.
def pair_stages(
    end: float,
    *,
    rho: float,
    r1: float,
    r2: float,
    kn: float,
    ks: float,
    mu: float,
    gap: float,
    v_n: float,
    v_t: float,
    w1: float,
    w2: float,
    load: float,
) -> tuple[Stage, ...]:
    """The stages that begin up to `end` [s], in order."""
    require_positive("in SI units", rho=rho, r1=r1, r2=r2, kn=kn, ks=ks, mu=mu, gap=gap)
    require_at_least_0("N", load=load)
    require_finite("in SI units", v_n=v_n, v_t=v_t, w1=w1, w2=w2)
    m = rho * 4.0 / 3.0 * pi
    two = Pair((r1, r2), (m * r1**3, m * r2**3), kn, ks, mu, gap, load)
    z = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -v_n, v_t, w1, w2, 0.0])
    stages = [_flight(two, 0.0, z)]
    for _ in range(MOST):
        last = stages[-1]
        after = _after_flight(two, last, end) if last.name == "flight" else _next(two, last)
        if after is None or after.begin > end:
            return tuple(stages)
        stages.append(after)
    raise ValueError(f"load = {load} N; more than {MOST} stages by {end} s")


def _flight(two: Pair, begin: float, z: Array) -> Stage:
    return Stage(begin, "flight", z, lambda t: two.flown(z, t - begin))


def _after_flight(two: Pair, flight: Stage, end: float) -> Stage | None:
    """The contact stage that ends a flight; None if there is none before `end` [s]."""
    from scipy.optimize import brentq

    def apart(since: Array) -> Array:
        return -two.overlap(two.flown(flight.z, np.atleast_1d(since)))

    grid = np.linspace(0.0, end - flight.begin, CELLS)[1:]
    below = np.flatnonzero(apart(grid) < 0.0)
    if not len(below):
        return None
    low, high = grid[below[0] - 1] if below[0] else 0.0, grid[below[0]]
    since = brentq(lambda x: float(apart(np.asarray(x))[0]), low, high, xtol=1e-20, rtol=1e-15)
    z = two.flown(flight.z, np.array([since]))[:, 0]
    closing, s = two.slip(z)
    way = -copysign(1.0, s) if two.ks * abs(s) > two.mu * two.kn * closing else 0.0
    return _contact(two, flight.begin + since, z, way)


def _contact(two: Pair, begin: float, z: Array, way: float) -> Stage:
    """A stick or slip stage, integrated up to its end."""
    from scipy.integrate import solve_ivp

    def opens(_: float, z: Array) -> float:
        return float(two.overlap(z))

    def ends(_: float, z: Array) -> float:
        if way:
            return two.outrun(z, way)
        return two.mu * two.kn * float(two.overlap(z)) - abs(float(z[10]))

    evaluations = count(1)

    def rates(_: float, z: Array) -> list[float]:
        require_few("evaluations of the rates in a contact", next(evaluations), WORK)
        return two.rates(z, way)

    for event in (opens, ends):
        event.terminal, event.direction = True, -1  # type: ignore[attr-defined]
    k = sqrt(two.kn * sum(1.0 / m for m in two.m))
    v = max(abs(two.slip(z)[0]), 1e-3 * float(np.abs(z[4:8]).max()))
    scale = [v / k] * 4 + [v] * 4 + [v / r for r in two.r] + [v * two.kn / k]
    run = solve_ivp(
        rates, (0.0, 20.0 * pi / k), z, method="DOP853", dense_output=True,
        events=(opens, ends), rtol=RTOL, atol=RTOL * np.array(scale), max_step=STEP / k,
    )  # fmt: skip
    if run.status != 1:
        raise RuntimeError(f"a contact from t = {begin} s; {run.message}")
    states = _Dense(begin, float(run.t[-1]), run.sol, way, bool(len(run.t_events[0])))
    return Stage(begin, "slip" if way else "stick", run.y[:, -1], states)


class _Dense(NamedTuple):
    """States (11, k) at times [s] of a contact stage; opens: whether a flight follows."""

    begin: float
    duration: float
    solution: Any
    way: float
    opens: bool

    def __call__(self, t: Array) -> Array:
        return np.asarray(self.solution(np.minimum(t - self.begin, self.duration)))


def _next(two: Pair, stage: Stage) -> Stage:
    """The stage that follows a contact stage."""
    begin, z = stage.begin + stage.states.duration, stage.z.copy()
    if stage.states.opens:
        z[10] = 0.0
        return _flight(two, begin, z)
    way = stage.states.way
    z[10] = copysign(two.mu * two.kn * float(two.overlap(z)), way or z[10])
    return _contact(two, begin, z, 0.0 if way else copysign(1.0, z[10]))

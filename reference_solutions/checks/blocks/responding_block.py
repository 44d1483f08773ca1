"""Second route to the responding block: piecewise linear velocity, and stiff integrators.

In one direction the velocity of a slipping block is linear in time. A grid in each period brackets
the event at which it equals that of the base, and Brent's method finds it. In two and three
directions the Cartesian components of the lag behind the base are integrated, from a negligible
relative speed until the speed is negligible again: by an implicit Runge-Kutta method where a slip
begins, since the equations are stiff there, and by a multistep method from then on. Parameters are
those of `reference_solutions.blocks.responding_block`, whose code is not used here.

A slip or rest shorter than the grid, 1/256 of a period, can be missed.
"""

from math import cos, hypot, sin, tau
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

_GRID = 257
_MOST = 20_000
_Routine = tuple[Literal["Radau", "LSODA"], float, float]  # relative and absolute tolerance
_ROUTINES: tuple[_Routine, ...] = (("Radau", 1e-9, 1e-14), ("LSODA", 1e-12, 1e-14))
_STARTED = 1e-12  # of the base's greatest speed: the relative speed at which a slip begins
_STOPPED = 1e-7  # of the base's greatest speed: the relative speed at which a slip ends


def one_direction(t: ArrayLike, *, D: float, f: float, mu: float, g: float) -> Array:
    """d2 [m] at times t [s]; times of events count from the last whole period, to stay accurate."""
    t, rate = np.asarray(t, dtype=np.float64), tau * f
    d2, now, x, v, way, periods = np.full(t.shape, np.nan), 0.0, 0.0, 0.0, 0.0, 0

    def base(s: Array | float) -> Array:
        moved: Array = D - D * np.cos(rate * np.asarray(s))
        return moved

    for _ in range(_MOST):
        past = t - periods / f
        if way == 0.0:
            then, way = _carried(now, D * rate**2, rate, mu * g)
            here = (now <= past) & (past <= then)
            d2[here] = x + base(past[here]) - base(now)
            x += float(base(then) - base(now))
            # Where friction reverses at once, the block keeps its velocity to the last digit.
            v = v if then == now else D * rate * sin(rate * then)
        else:
            a = way * mu * g
            then = _caught(now, v, a, D * rate, rate)
            here = (now <= past) & (past <= then)
            d2[here] = x + (past[here] - now) * (v + a * (past[here] - now) / 2.0)
            x, way = x + (then - now) * (v + a * (then - now) / 2.0), 0.0
            v += a * (then - now)
        if then > past.max():
            return d2
        whole = int(then * f)
        now, periods = then - whole / f, periods + whole
    raise RuntimeError(f"{_MOST} events did not reach t = {t.max()} s")


def _carried(now: float, most: float, rate: float, limit: float) -> tuple[float, float]:
    """The time when the base accelerates beyond friction, and the sign of its acceleration then."""
    from scipy.optimize import brentq

    def spare(s: float) -> float:
        return limit - most * abs(cos(rate * s))

    if spare(now) < 0.0:
        return now, float(np.sign(cos(rate * now)))
    s = np.linspace(now, now + tau / rate, _GRID)
    over = np.flatnonzero(limit < most * np.abs(np.cos(rate * s)))
    if not over.size:
        return float(s[-1]), 0.0
    then = float(brentq(spare, s[over[0] - 1], s[over[0]], xtol=1e-16))
    return then, float(np.sign(cos(rate * then)))


def _caught(now: float, v: float, a: float, fastest: float, rate: float) -> float:
    """The time when a block with velocity v and acceleration a has the base's velocity again."""
    from scipy.optimize import brentq

    def ahead(s: float) -> float:
        return a * (fastest * sin(rate * s) - v - a * (s - now))

    first = now
    for _ in range(_MOST):
        s = np.linspace(first, first + tau / rate, _GRID)
        gap = a * (fastest * np.sin(rate * s) - v - a * (s - now))
        met = np.flatnonzero((gap[:-1] > 0.0) & (gap[1:] <= 0.0))
        if met.size:
            return float(brentq(ahead, s[met[0]], s[met[0] + 1], xtol=1e-16))
        first = float(s[-1])
    raise RuntimeError(f"the base leaves the block behind from t = {now} s on")


def two_directions(
    t: ArrayLike, *, Dx: float, fx: float, Dy: float, fy: float, mu: float, g: float
) -> Array:
    """d2 [m] at increasing times t (n,) [s], (n, 2)."""
    all_three = three_directions(t, Dx=Dx, fx=fx, Dy=Dy, fy=fy, Dz=0.0, fz=1.0, mu=mu, g=g)
    return all_three[:, :2]


# The case passes its parameters by name, one for one.
def three_directions(
    t: ArrayLike,
    *,
    Dx: float,
    fx: float,
    Dy: float,
    fy: float,
    Dz: float,
    fz: float,
    mu: float,
    g: float,
) -> Array:
    """d2 [m] at increasing times t (n,) [s], (n, 3)."""
    t = np.asarray(t, dtype=np.float64)
    D, rate = np.array([Dx, Dy, Dz]), tau * np.array([fx, fy, fz])
    base = Base(D, rate, mu, g)
    lags, now, lag = np.zeros((len(t), 3)), 0.0, np.zeros(2)
    while now < t[-1]:
        then = base.outruns(now, t[-1])
        lags[(now <= t) & (t <= then), :2] = lag
        now, lag = _dragged(base, then, lag, t, lags) if then < t[-1] else (then, lag)
    d2: Array = D - D * np.cos(np.multiply.outer(t, rate)) + lags
    return d2


class Base(NamedTuple):
    """Amplitudes D (3,) [m], angular frequencies `rate` (3,) [rad/s]; friction mu, gravity g."""

    D: Array
    rate: Array
    mu: float
    g: float

    def acceleration(self, s: float) -> list[float]:
        """The accelerations a1x, a1y, a1z [m/s2] of the base."""
        each = zip(self.D.tolist(), self.rate.tolist(), strict=True)
        return [D * rate * rate * cos(rate * s) for D, rate in each]

    def outruns(self, now: float, end: float) -> float:
        """The next time at which the acceleration of the base exceeds the limit of friction."""
        from scipy.optimize import brentq

        def excess(s: float) -> float:
            ax, ay, az = self.acceleration(s)
            return hypot(ax, ay) - self.mu * (self.g + az)

        step = 0.02 / float(max(self.rate))
        for s in np.arange(now, end + step, step):
            if excess(s) > 1e-12:
                return float(brentq(excess, s - step, s, xtol=1e-16)) if s > now else now
        return end

    def drags(self, s: float, z: Array) -> tuple[float, float, float, float]:
        """The rates of the lag and the relative velocity, z (4,), of a slipping block."""
        ax, ay, az = self.acceleration(s)
        pull = self.mu * (self.g + az) / hypot(z[2], z[3])
        return z[2], z[3], -ax - pull * z[2], -ay - pull * z[3]

    def stiffness(self, s: float, z: Array) -> Array:
        """The derivatives (4, 4) of the rates of `drags` with respect to z."""
        speed, change = hypot(z[2], z[3]), np.eye(4, k=2)
        limit = self.mu * (self.g + self.acceleration(s)[2])
        normal = np.array([-z[3], z[2]]) / speed
        change[2:, 2:] = -limit / speed * np.outer(normal, normal)
        return change


def _dragged(base: Base, begin: float, lag: Array, t: Array, lags: Array) -> tuple[float, Array]:
    """Fill in the lags at the times t of a slip; return the time of its end and the lag there."""
    from scipy.integrate import solve_ivp

    fastest = float(np.hypot(*(base.D * base.rate)[:2]))

    def slow(_: float, z: Array) -> float:
        return hypot(z[2], z[3]) - _STOPPED * fastest

    slow.terminal, slow.direction = True, -1  # type: ignore[attr-defined]
    ax, ay, _ = base.acceleration(begin)
    z = np.array([*lag, -ax, -ay]) * [1.0, 1.0, *[_STARTED * fastest / hypot(ax, ay)] * 2]
    for method, rtol, atol in _ROUTINES:
        end = min(begin + 0.01 / max(base.rate), t[-1]) if method == "Radau" else t[-1]
        here = np.flatnonzero((begin <= t) & (t <= end))
        run = solve_ivp(
            base.drags,
            (begin, end),
            z,
            method=method,
            t_eval=np.union1d(t[here], [end]),
            events=slow,
            jac=base.stiffness,
            rtol=rtol,
            atol=atol * fastest,
        )
        filled = here[: len(run.t)]
        lags[filled, :2] = np.reshape(run.y, (4, -1))[:2, : len(filled)].T
        if run.status == 1 and run.t_events is not None and run.y_events is not None:
            return float(run.t_events[0][0]), run.y_events[0][0][:2]
        begin, z = end, run.y[:, -1]
    return float(t[-1]), z[:2]

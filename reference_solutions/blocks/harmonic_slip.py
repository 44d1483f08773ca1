"""Coulomb stick and slip along a line under a harmonic drive: closed forms between located events.

A point that slides has w' = p + q sin(omega t + lag), where p and q depend on the sign of w alone;
it rests while w could grow in neither direction. Every phase has a closed form in the angle x since
it began. A slip from rest begins at an angle given by an arcsine and ends at the only root of w
between two successive zeros of its acceleration, which is bracketed there and found to rounding.

A phase that begins at the angle b with displacement d, velocity v and acceleration a has, with
s = x - sin x, c = 1 - cos x and e = x^2/2 - c,

w = v + (a x + q (cos b c - sin b s))/omega
displacement = d + (v x + (a x^2/2 + q (cos b s - sin b e))/omega)/omega.

Unlike p x - q cos(b + x), these lose no digits in a short slip. Angles are kept within one turn: an
event at t = 100 s is as accurate as one at t = 0. Where a slip reverses at once, the part of the
velocity that is not due to the drive is carried over to the last digit.
"""

from collections.abc import Callable, Iterator
from math import asin, copysign, cos, factorial, inf, pi, sin
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from reference_solutions.parameters import require_few

Array = NDArray[np.float64]
Function = Callable[[float], float]
Number = TypeVar("Number", float, Array)

_TURN = 2.0 * pi
_MOST = 50_000  # cycles: a few seconds of calculation
_SNAP = 1e-9  # [rad]: tolerance on a zero of the drive; a slip this short has no displacement
_TOUCH = 1e-14  # of q/omega: a minimum of the speed that is 0 within rounding
_S_SERIES = tuple((-1.0) ** j / factorial(2 * j + 3) for j in range(9))
_E_SERIES = tuple((-1.0) ** j / factorial(2 * j + 4) for j in range(9))


class Law(NamedTuple):
    """The law w' = p + q sin(omega t + lag) [m/s2], which holds while w keeps its sign."""

    p: float
    q: float


class Drive(NamedTuple):
    """The laws of w > 0 (`forward`) and w < 0 (`backward`), `omega` [rad/s] and `lag` [rad]."""

    omega: float
    lag: float
    forward: Law
    backward: Law

    def law(self, direction: int) -> Law:
        """The law of w in a direction; direction 0 is rest, with w' = 0."""
        return (Law(0.0, 0.0), self.forward, self.backward)[direction]


class Phase(NamedTuple):
    """A slip or rest from `begin` to `end` [s]; its `direction` is 1 or -1 for a slip, 0 for rest.

    At `begin` the drive has the `angle` [rad] within a turn, and the point has the displacement `d`
    [m], velocity `v` [m/s] and acceleration `a` [m/s2].
    """

    begin: float
    end: float
    direction: int
    angle: float
    d: float
    v: float
    a: float


class _Slip(NamedTuple):
    """The slip that just ended: direction, q, and `steady` = w + q/omega cos(omega t + lag) [m/s].

    `steady` does not jump where a slip reverses, and w = 0 there apart from rounding of the angle.
    With a fast drive q/omega is so much larger than w that the remainder of w must be kept.
    """

    direction: int
    q: float
    steady: float


def phases(
    drive: Drive, v0: float, end: float, *, steady: float | None = None
) -> tuple[Phase, ...]:
    """The slips and rests from t = 0, w = v0 [m/s], d = 0; the last is cut at `end` [s].

    steady: v0 + q/omega cos(lag) [m/s], if it is known more accurately than the rounding of lag
    allows.

    A slip whose velocity touches zero ends there, and the next begins. Raises ValueError for
    more than _MOST cycles, RuntimeError for more phases than a harmonic drive can make.
    """
    require_few("cycles of the drive", drive.omega * end / _TURN, _MOST)
    found: list[Phase] = []
    start = angle = drive.lag % _TURN
    now, turns, d, v = 0.0, 0.0, 0.0, v0
    last = None if steady is None else _Slip(0, drive.forward.q, steady)
    for _ in range(16 + int(8.0 * drive.omega * end / _TURN)):
        direction, a, x, v = _mode(drive, angle, v, last, drive.omega * (end - now))
        more, after = divmod(angle + x, _TURN) if x < inf else (inf, 0.0)
        turns += more
        then = min((turns * _TURN + after - start) / drive.omega, end)
        found.append(Phase(now, then, direction, angle, d, v, a))
        if then >= end:
            return tuple(found)
        p, q = drive.law(direction)
        d = float(_moved(np.array(x), drive.omega, q, *found[-1][3:]))
        last = (
            _Slip(direction, q, v + (q * cos(angle) + p * x) / drive.omega) if direction else None
        )
        now, angle, v = then, after, 0.0
    raise RuntimeError(f"{len(found)} phases did not reach t = {end} s")


def displacement(t: Array, drive: Drive, history: tuple[Phase, ...]) -> Array:
    """d [m] at times t [s] of any shape, all within the phases of `history`."""
    begin, _, direction, *rest = np.array(history).T
    i = np.searchsorted(begin, t, side="right") - 1
    q = np.array([drive.law(int(way)).q for way in direction])
    x = drive.omega * (t - begin[i])
    return _moved(x, drive.omega, q[i], *(value[i] for value in rest))


def _moved(
    x: Array, omega: float, q: Number, angle: Number, d: Number, v: Number, a: Number
) -> Array:
    """The displacement at an angle x after a phase began."""
    short = x < 1.0
    s = np.where(short, x**3 * _series(x * x, _S_SERIES), x - np.sin(x))
    e = np.where(short, x**4 * _series(x * x, _E_SERIES), x**2 / 2.0 - 1.0 + np.cos(x))
    driven = a * x**2 / 2.0 + q * (np.cos(angle) * s - np.sin(angle) * e)
    moved: Array = d + (v * x + driven / omega) / omega
    return moved


def _mode(
    drive: Drive, angle: float, v: float, last: _Slip | None, left: float
) -> tuple[int, float, float, float]:
    """Direction, initial acceleration, angle until the end and velocity of a phase from v."""
    if v != 0.0:
        direction = int(copysign(1.0, v))
        law = drive.law(direction)
        a = law.p + law.q * sin(angle)
    else:
        wait, direction, a = min(_begin(drive.law(way), way, angle) for way in (1, -1))
        if wait > 0.0:
            return 0, 0.0, wait, 0.0
        q = drive.law(direction).q
        if last is not None and last.q == q and last.direction != direction:
            v = last.steady - q * cos(angle) / drive.omega
    return direction, a, _stop(drive, direction, angle, v, a, left), v


def _begin(law: Law, direction: int, angle: float) -> tuple[float, int, float]:
    """The angle until a point at rest slips in a direction, the direction, and the acceleration."""
    p, q = direction * law.p, direction * law.q
    push = p + q * sin(angle)
    if push > 1e-12 * (abs(p) + abs(q)):
        return 0.0, direction, direction * push
    if not abs(p) < abs(q):
        return inf, direction, 0.0
    wait = (_rise(p, q) - angle) % _TURN
    return (0.0 if min(wait, _TURN - wait) < _SNAP else wait), direction, direction * push


def _rise(p: float, q: float) -> float:
    """The angle where p + q sin(angle) rises through 0; it falls through 0 at pi minus that."""
    return asin(-p / q) if q > 0.0 else pi - asin(-p / q)


def _stop(drive: Drive, direction: int, angle: float, v: float, a: float, last: float) -> float:
    """The angle after which a slip comes to rest; infinite if that is beyond `last`."""
    (p, q), omega, cos_b, sin_b = drive.law(direction), drive.omega, cos(angle), sin(angle)

    def speed(x: float) -> float:
        c = 2.0 * sin(x / 2.0) ** 2
        s = x**3 * _series(x * x, _S_SERIES) if x < 1.0 else x - sin(x)
        return direction * (v + (a * x + q * (cos_b * c - sin_b * s)) / omega)

    def slope(x: float) -> float:
        return direction * (p + q * sin(angle + x)) / omega

    for low, high in _descents(drive.law(direction), direction, angle, last):
        least = speed(high)
        if abs(least) <= _TOUCH * abs(q) / omega:
            return high
        if least < 0.0:
            return _root(speed, slope, low, high)
    return inf


def _descents(law: Law, direction: int, angle: float, last: float) -> Iterator[tuple[float, float]]:
    """The intervals of the angle, counted from `angle`, in which the speed of a slip decreases."""
    p, q = direction * law.p, direction * law.q
    if not abs(p) < abs(q):
        if p < 0.0:
            yield 0.0, last
        return
    rise = _rise(p, q)
    high = (rise - angle - _SNAP) % _TURN + _SNAP
    while high - _TURN < last:
        yield max(0.0, high - (2.0 * rise - pi) % _TURN), high
        high += _TURN


def _root(f: Function, slope: Function, low: float, high: float) -> float:
    """Where f falls through 0 between f(low) > 0 and f(high) < 0, by bracketed Newton iteration."""
    x = (low + high) / 2.0
    for _ in range(100):
        y, descent = f(x), slope(x)
        low, high = (x, high) if y > 0.0 else (low, x)
        new = x - y / descent if descent < 0.0 else low
        new = new if low < new < high else (low + high) / 2.0
        if abs(new - x) <= 4e-16 * x:
            return new
        x = new
    raise RuntimeError(f"no root between the angles {low} and {high} rad")


def _series(y: Number, coefficients: tuple[float, ...]) -> Number:
    """The polynomial in y with the given coefficients, from the lowest power up."""
    total = y * 0.0
    for coefficient in reversed(coefficients):
        total = total * y + coefficient
    return total

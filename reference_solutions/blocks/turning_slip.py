"""Coulomb stick and slip in a plane under a harmonic drive: steps between located events.

A point that is initially at rest has w' = T - F w/|w|; it rests while w = 0 and |T| <= F. The drive
T and the friction limit F >= 0 are sums of harmonics. A slip is integrated by `slip_collocation`; a
step is accepted if the Legendre series of w' on it has decayed. The end of the step is then exact
to rounding, since the order there is twice that of the series.

Near its end a slip follows the solution for constant T and F, in which F |w| + T.w falls at the
rate F^2 - |T|^2: this gives the last step, from a ten millionth of the greatest speed. A rest ends
where |T| rises above F. The steps approach that time from below, since a bound on the second
derivative of |T|^2 - F^2 limits their length.
"""

from collections.abc import Iterator
from math import hypot, inf, pi, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from reference_solutions.blocks.slip_collocation import NODES, advanced, along, basis, collocate
from reference_solutions.parameters import require_few

Array = NDArray[np.float64]

TURN = 8 * np.arctan(np.longdouble(1))  # 2 pi, by which angles are reduced in extended precision
MOST_CYCLES = 500  # some seconds of calculation
_DECAYED = 1e-10  # of the slip's greatest speed: limit on w from the last two Legendre terms
_SLOW = 1e-7  # of the slip's greatest speed: below it the slip ends by the closed form
_SOON = 1e-2  # [rad] of the fastest harmonic: T and F count as constant for that long
_NEARER = 0.7  # longest step over the time to rest at this deceleration; w/|w| is singular there
_NOISE = 4e-16  # of the greatest F times the length of a step: rounding error of w
_LEVEL = 1e-12  # of a bound of |T|^2 + F^2: excess of |T|^2 over F^2 where a rest ends
_MOST = 500  # greatest number of steps in a slip or a rest, per period of the fastest harmonic


class Drive(NamedTuple):
    """The drive Tx, Ty and the friction limit F [m/s2], in rows, as sums of harmonics.

    They are `constant` (3,) + `sine` (3, k) sin(omega t) + `cosine` (3, k) cos(omega t), with
    `omega` (k,) [rad/s].
    """

    omega: Array
    constant: Array
    sine: Array
    cosine: Array

    def at(self, t: Array | float) -> Array:
        """Tx, Ty and F at times t, (3, ...)."""
        turns = np.multiply.outer(self.omega.astype(np.longdouble), t) / TURN
        angle = (TURN * (turns - np.floor(turns))).astype(float)
        varying = self.sine @ np.sin(angle) + self.cosine @ np.cos(angle)
        values: Array = (self.constant + varying.T).T
        return values

    def change(self) -> "Drive":
        """The time derivative, as another drive."""
        sine, cosine = -self.omega * self.cosine, self.omega * self.sine
        return Drive(self.omega, np.zeros(3), sine, cosine)

    def bound(self) -> Array:
        """Upper bounds of |Tx|, |Ty| and F."""
        total: Array = np.abs(self.constant) + np.hypot(self.sine, self.cosine).sum(axis=1)
        return total


class Step(NamedTuple):
    """A step of a slip (`slips`) or of a rest, with a `length` [s] from `begin` [s] on.

    x (2,) [m] and w (2,) [m/s] are those at `begin`; `rate` (2, n) [m/s2] are the Legendre
    coefficients of w' on the step.
    """

    begin: float
    length: float
    slips: bool
    x: Array
    w: Array
    rate: Array

    def after(self) -> tuple[float, Array, Array]:
        """The time, x and w at the end of the step."""
        return self.begin + self.length, *advanced(self.x, self.w, self.length, self.rate)


class Interval(NamedTuple):
    """`begin` and `end` [s] of a slip (`slips`) or a rest."""

    begin: float
    end: float
    slips: bool


def history(drive: Drive, end: float) -> tuple[Step, ...]:
    """The steps of the motion from rest at t = 0 until `end` [s].

    Raises ValueError for more than MOST_CYCLES, RuntimeError if the steps do not reach `end`.
    """
    cycles = float(drive.omega.max()) * end / (2.0 * pi)
    require_few("cycles of the drive", cycles, MOST_CYCLES)
    steps: list[Step] = []
    t, x, still = 0.0, np.zeros(2), np.zeros((2, NODES))
    for _ in range(16 + int(8.0 * drive.omega.max() * end / (2.0 * pi))):
        begin = _rest(drive, t, end)
        if begin > t or begin >= end:
            steps.append(Step(t, begin - t, False, x, np.zeros(2), still))
        if begin < end:
            steps.extend(_slip(drive, begin, x, end))
        t, x, _ = steps[-1].after()
        if t >= end:
            return tuple(steps)
    raise RuntimeError(f"{len(steps)} steps did not reach t = {end} s")


def displacement(t: Array, steps: tuple[Step, ...]) -> Array:
    """x [m] at times t (...) [s] within the steps, as an array (..., 2)."""
    begin, length, _, x, w, rate = (np.array(column) for column in zip(*steps, strict=True))
    i = np.searchsorted(begin, t, side="right") - 1
    return along(t - begin[i], length[i], x[i], w[i], rate[i])


def intervals(steps: tuple[Step, ...]) -> tuple[Interval, ...]:
    """The slips and rests of a history, in order."""
    found: list[Interval] = []
    for step in steps:
        end = float(step.begin + step.length)
        if found and step.slips == found[-1].slips and (step.w.any() or not step.slips):
            found[-1] = found[-1]._replace(end=end)
        else:
            found.append(Interval(float(step.begin), end, step.slips))
    return tuple(found)


def _rest(drive: Drive, t: float, end: float) -> float:
    """The time when the rest at t ends, at most `end`.

    Each step leads to the zero of a parabola that is an upper bound of |T|^2 - F^2.
    """
    change, signs = drive.change(), np.array([1.0, 1.0, -1.0])
    most, rate, curve = drive.bound(), change.bound(), change.change().bound()
    level, bend = _LEVEL * float(most @ most), 2.0 * float(most @ curve + rate @ rate)
    for _ in range(_most(drive, end - t)):
        value = drive.at(t)
        excess = float(signs @ value**2) - level
        if t >= end or excess > -level / 2.0:
            return min(t, end)
        if bend == 0.0:
            return end
        rise = 2.0 * float(signs @ (value * change.at(t)))
        root = sqrt(rise**2 - 2.0 * bend * excess)
        t += -2.0 * excess / (rise + root) if rise > 0.0 else (root - rise) / bend
    raise RuntimeError(f"the rest before t = {t} s does not end, with such accelerations")


def _slip(drive: Drive, t: float, x: Array, end: float) -> Iterator[Step]:
    """The steps of a slip from rest, until it is at rest again or at `end`."""
    nodes, w, top, length = basis().nodes, np.zeros(2), 0.0, 0.05 / drive.omega.max()
    for _ in range(_most(drive, end - t)):
        length = (t + min(length, end - t)) - t  # so that t + length is not rounded
        *T, F = drive.at(np.longdouble(t) + length * nodes)
        rate = collocate(np.array(T), F, w, length)
        if rate is None:
            length /= 4.0
            continue
        step = Step(t, length, True, x, w, rate)
        then, x_then, w_then = step.after()
        allowed = _DECAYED * max(top, hypot(*w_then)) + _NOISE * length * F.max()
        moved = length * float(np.abs(rate[:, -2:]).max()) / allowed
        growth = 0.8 * (moved + 1e-30) ** (-1.0 / (NODES - 1))
        length *= min(max(growth, 0.2), 4.0)
        if moved > 1.0:
            continue
        yield step
        if then >= end:
            return
        t, x, w = then, x_then, w_then
        top = max(top, hypot(*w))
        brake, left = _braking(drive, t, w)
        if hypot(*w) < _SLOW * top and 0.0 < left < _SOON / drive.omega.max():
            yield Step(t, left, True, x, w, np.outer(-w / left, np.eye(NODES)[0]))
            return
        length = min(length, _NEARER * brake)
    raise RuntimeError(f"the slip at t = {t} s does not end, with such accelerations")


def _braking(drive: Drive, t: float, w: Array) -> tuple[float, float]:
    """The times to rest at constant deceleration and at constant T and F; infinite if never."""
    T, F = drive.at(t)[:2], float(drive.at(t)[2])
    speed, along, spare = hypot(*w), float(w @ T), F * F - float(T @ T)
    if F * speed <= along or spare == 0.0:
        return inf, inf
    return speed**2 / (F * speed - along), (F * speed + along) / spare


def _most(drive: Drive, duration: float) -> int:
    return _MOST + int(_MOST * duration * drive.omega.max() / (2.0 * pi))

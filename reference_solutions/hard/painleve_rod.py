"""Painleve's paradox: the lower end of a uniform rod of length 2l slides along a rough floor.

The rod is inclined to the floor by theta. At first it does not rotate, and its end moves at -V,
away from its middle. While it slides, N = m (g + l cos(theta) theta'' - l sin(theta) theta'^2), the
friction is mu N and theta'' = (g - l sin(theta) theta'^2) b/(l (1/3 - cos(theta) b)) with b = mu
sin(theta) - cos(theta). From mu = (1 + 3 cos^2)/(3 sin cos) on, which is 4/3 at tan(theta) = 2, no
finite N keeps the end on the floor: it jams (Painleve 1895; Genot and Brogliato 1999, European
Journal of Mechanics A 18, 653-677). An impulse on the boundary of the friction cone then stops the
end at once and conserves the angular momentum about it. Once the end is at rest, the rod rotates
about it. Every function raises ValueError for parameters outside their ranges.
"""

from math import atan2, cos, sin

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_positive, require_times

Array = NDArray[np.float64]

_BEYOND = 1.000001  # end of the integration over the last time
_SHARP = {"rtol": 1e-12, "atol": 1e-14}


def critical(slope: float) -> float:
    """The coefficient of friction from which on a rod without spin jams; slope = tan(theta)."""
    require_positive("", slope=slope)
    theta = atan2(slope, 1.0)
    return (1.0 + 3.0 * cos(theta) ** 2) / (3.0 * sin(theta) * cos(theta))


def middle(t: ArrayLike, *, mu: float, slope: float, half: float, V: float, g: float) -> Array:
    """Displacement (k, 2) [m] of the middle, along the floor and up, at rising times (k,) [s].

    half: half the length of the rod, l [m].
    """
    require_positive("in SI units", mu=mu, slope=slope, half=half, V=V, g=g)
    times, theta = require_times(t), atan2(slope, 1.0)
    place = np.array([half * cos(theta), theta, -V, 0.0])
    stop, moved = 0.0, np.empty((len(times), 2))
    if not times.any():
        return np.zeros((len(times), 2))
    if mu < critical(slope):
        stop, place, slid = _slide(place, times, mu, half, g)
        moved[times < stop] = slid
    moved[times >= stop] = _turn(times[times >= stop] - stop, place, mu, half, g)
    return np.asarray(moved - half * np.array([cos(theta), sin(theta)]))


def _slide(
    start: Array, times: Array, mu: float, half: float, g: float
) -> tuple[float, Array, Array]:
    """The time [s] at which the end stops, the state then, and the positions of the middle before.

    A state consists of the x of the middle, theta and their rates.
    """
    from scipy.integrate import solve_ivp

    def rate(t: float, y: Array) -> list[float]:
        s, c = sin(y[1]), cos(y[1])
        b = mu * s - c
        turn = (g - half * s * y[3] ** 2) * b / (half * (1.0 / 3.0 - c * b))
        push = g + half * c * turn - half * s * y[3] ** 2
        return [y[2], y[3], mu * push, turn]

    def slips(t: float, y: Array) -> float:
        return float(y[2] + half * sin(y[1]) * y[3])

    slips.terminal = True  # type: ignore[attr-defined]
    end = (0.0, _BEYOND * float(times.max()))
    found = solve_ivp(rate, end, start, "DOP853", events=slips, dense_output=True, **_SHARP)
    stop = float(found.t[-1])
    slid = np.array([found.sol(t)[:2] for t in times[times < stop]]).reshape(
        len(times[times < stop]), 2
    )
    return stop, found.y[:, -1], np.stack([slid[:, 0], half * np.sin(slid[:, 1])], axis=1)


def _turn(times: Array, start: Array, mu: float, half: float, g: float) -> Array:
    """Positions of the middle after the end stopped in the state `start`, while it is at rest.

    Raises ValueError where friction does not hold the end.
    """
    from scipy.integrate import solve_ivp

    x, theta, v, w = (float(value) for value in start)
    arm = 0.75 / half**2  # m over the moment of inertia about the end, 4/3 m l^2
    rises = half * cos(theta) * w
    w = arm * (half * cos(theta) * rises - half * sin(theta) * v + half**2 / 3.0 * w)
    if not len(times):
        return np.empty((0, 2))

    def rate(t: float, y: Array) -> list[float]:
        return [y[1], -arm * g * half * cos(y[0])]

    span = (0.0, _BEYOND * float(times.max()))
    found = solve_ivp(rate, span, [theta, w], "DOP853", dense_output=True, **_SHARP)
    angle, spin = found.sol(times)
    _require_hold(angle, spin, mu, half, g)
    foot = x - half * cos(theta)
    return np.stack([foot + half * np.cos(angle), half * np.sin(angle)], axis=1)


def _require_hold(angle: Array, spin: Array, mu: float, half: float, g: float) -> None:
    s, c = np.sin(angle), np.cos(angle)
    turn = -0.75 * g / half * c
    rub = half * (-s * turn - c * spin**2)
    push = g + half * (c * turn - s * spin**2)
    if (np.abs(rub) > mu * push).any():
        raise ValueError(f"mu = {mu}; the end slides again, which is not followed")

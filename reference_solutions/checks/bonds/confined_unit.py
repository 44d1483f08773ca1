"""Second route to the confined unit of four bonded elements: its equilibrium in rates, integrated.

The loads grow, then the top moves down, then the bonds of the base lose their force, then the top
moves down further. In each stage one parameter changes the equilibrium of a base element at the
radius r, and the rates of r and of the shear S follow from the condition that
F(r, z, S, f, base) = 0 persists. Derivatives of F are finite differences. Lengths are in diameters,
forces in kn d.
"""

from collections.abc import Callable
from math import atan2, cos, hypot, sin, sqrt

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Margin = Callable[[Array, Array], float]
STEP = 1e-6
MOST = 3000  # largest number of evaluations of the rates in a stage
HEIGHT = sqrt(2.0 / 3.0)
Z, F, BASE = 0, 1, 2  # indices of the parameters that change


def sliding_failure(
    *,
    kn: float,
    ks: float,
    xb: float,
    fs0: float,
    mu_p: float,
    d: float,
    fx: float,
    overshoot: float = 1.0,
) -> tuple[float, ...]:
    """The pressure [Pa] and the strain at which inclined bonds slide, under inward loads fx [N].

    Seven values follow: the strain and the pressure [Pa] at which the base opens, the pressure in
    the new equilibrium, and the loads of inclined bonds, over those at which they slide: before the
    base opens, in the new equilibrium, and where the unit swings beyond it by a share (overshoot)
    of its distance from it; and their stretch there over xb.
    """
    g, limit = ks / kn, fs0 / (kn * d)

    def opens(state: Array, at: Array) -> float:
        return float(sqrt(3.0) * state[0] - 1.0 - xb / d)

    def slides(state: Array, at: Array) -> float:
        stretch = hypot(state[0], at[Z]) - 1.0
        return float(g * abs(state[1]) - limit + mu_p * stretch)

    def pressure(state: Array, at: Array) -> float:
        angle, stretch = atan2(state[0], at[Z]), hypot(state[0], at[Z]) - 1.0
        fz = 3.0 * kn * d * (stretch * cos(angle) + g * state[1] * sin(angle))
        return float(-2.0 * fz / (sqrt(3.0) * d * d))

    def load(r: float, s: float, z: float) -> float:
        return float((g * abs(s) + mu_p * (hypot(r, z) - 1.0)) / limit)

    at, state = np.array([HEIGHT, 0.0, 1.0]), np.array([1.0 / sqrt(3.0), 0.0])
    at, state = _driven(state, at, F, fx / (kn * d), g)
    at, state = _driven(state, at, Z, 0.95 * HEIGHT, g, opens)
    opened, held, begun = float(at[Z]) / HEIGHT - 1.0, pressure(state, at), state
    at, state = _driven(state, at, BASE, 0.0, g)
    settled, z = pressure(state, at), float(at[Z])
    far = state[0] + overshoot * (state[0] - begun[0])
    swung = begun[1] - _slipped(float(begun[0]), float(far), z)
    loads = (
        load(begun[0], begun[1], z),
        load(state[0], state[1], z),
        load(far, swung, z),
        (hypot(far, z) - 1.0) * d / xb,
    )
    at, state = _driven(state, at, Z, 0.95 * HEIGHT, g, slides)
    strain = float(at[Z]) / HEIGHT - 1.0
    return pressure(state, at), strain, opened, held, settled, *loads


def _slipped(begin: float, end: float, z: float) -> float:
    """What the shear loses while a base element moves outwards at the height z of the top."""
    from scipy.integrate import quad

    return float(quad(lambda r: z / hypot(r, z), begin, end, epsabs=1e-15, epsrel=1e-12)[0])


def _unbalanced(r: float, s: float, at: Array, g: float) -> float:
    """The inward force on a base element."""
    angle, length = atan2(r, at[Z]), hypot(r, at[Z])
    rub = (length - 1.0) * sin(angle) - g * s * cos(angle)
    return float(rub + at[BASE] * sqrt(3.0) * (sqrt(3.0) * r - 1.0) + at[F])


def _driven(
    state: Array, at: Array, which: int, target: float, g: float, until: Margin | None = None
) -> tuple[Array, Array]:
    """(at, state) after one number of `at` reached its target, or a value with `until` = 0."""
    from scipy.integrate import solve_ivp

    begin = float(at[which])

    def placed(part: float) -> Array:
        now = np.array(at)
        now[which] = begin + part * (target - begin)
        return now

    asked = iter(range(MOST))

    def rates(part: float, y: Array) -> list[float]:
        if next(asked, None) is None:
            raise ValueError(f"the balance cannot be followed with {MOST} rates")
        now, (r, s) = placed(part), y
        slope = np.zeros(3)
        slope[which] = target - begin

        def along(dr: float, ds: float, dat: Array) -> float:
            ahead = _unbalanced(r + STEP * dr, s + STEP * ds, now + STEP * dat, g)
            behind = _unbalanced(r - STEP * dr, s - STEP * ds, now - STEP * dat, g)
            return (ahead - behind) / (2 * STEP)

        length, sinks = hypot(r, now[Z]), slope[Z]
        turned, still = -now[Z] / length, r * sinks / length  # S' = turned r' + still
        speed = -(along(0.0, still, slope)) / along(1.0, turned, np.zeros(3))
        return [speed, turned * speed + still]

    def event(part: float, y: Array) -> float:
        return until(y, placed(part)) if until else 1.0

    event.terminal = True  # type: ignore[attr-defined]
    found = solve_ivp(rates, (0.0, 1.0), state, "DOP853", rtol=1e-9, atol=1e-12, events=event)
    if until and not len(found.t_events[0]):
        raise ValueError("the stage ends before what it waits for")
    return placed(found.t[-1]), found.y[:, -1]

"""A block that slips in one direction along a shaken wall, by integration: the second route.

The equation of motion is integrated by an explicit Runge-Kutta method of order 8; parameters are
those of `reference_solutions.blocks.laden_block`, whose code is not used here.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Sine = tuple[float, float, float]  # amplitude, omega [rad/s], phase [rad]


def pressure(
    t: Array, *, constant: tuple[float, float], shaking: tuple[Sine, Sine], lifting: Sine
) -> Array:
    """The normal force per mass [m/s2] at times t (n,) [s]."""
    (a, w, phi), (size, omega, phase) = shaking[1], lifting
    lift = (1j * omega) ** 2 * size * np.exp(1j * (omega * t + phase))
    return np.asarray((lift - a * np.exp(1j * (w * t + phi))).imag - constant[1])


def motion(
    t: Array,
    *,
    v: float,
    mu: float,
    constant: tuple[float, float],
    shaking: tuple[Sine, Sine],
    lifting: Sine,
    sliding: Sine,
) -> tuple[Array, Array]:
    """Displacement [m] and velocity [m/s] along the slip at increasing times t (n,) [s] from 0.

    They end where the block no longer moves faster than the wall, or loses contact with it.
    """
    from scipy.integrate import solve_ivp

    def press(now: float) -> float:
        told = pressure(np.array(now), constant=constant, shaking=shaking, lifting=lifting)
        return float(told)

    def rates(now: float, state: Array) -> list[float]:
        a, w, phi = shaking[0]
        return [state[1], constant[0] + a * np.sin(w * now + phi) - mu * press(now)]

    def slips_on(now: float, state: Array) -> float:
        size, omega, phase = sliding
        return float(min(state[1] - size * omega * np.cos(omega * now + phase), press(now)))

    slips_on.terminal = True  # type: ignore[attr-defined]
    found = solve_ivp(
        rates, (0.0, t[-1]), [0.0, v], "DOP853", t, events=slips_on, rtol=1e-13, atol=1e-15
    )
    return found.y[0], found.y[1]

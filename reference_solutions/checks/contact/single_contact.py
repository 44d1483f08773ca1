"""Second route to T1 to T4 of Li et al. (2018): the equations of motion, integrated numerically.

Nothing is assumed about the sequence of stages. The mode (touching or apart, stuck or slipping)
follows from the state at the end of the last one, and each end is located as the root of a guard
function: the overlap of a contact that cannot pull, the margin mu Fn - |F| of Coulomb's limit, the
power -F v of sliding friction. Parameters are those of the first route, whose code is not used
here: the mass is that of the hexagon around the disc, and dx follows from integrating T4's first
stage.

A guard is evaluated after every step, so that a slip shorter than a step, 0.1/k, can be missed.
T4's slip is longer below eta = 0.9 (2 m k).
"""

from collections.abc import Callable
from math import copysign, pi, tan
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

_RTOL = 3e-14  # the least that solve_ivp accepts is 2.2e-14
_STEP = 0.1  # largest step times k, at which the interpolant is as accurate as the steps
_MOST_MODES = 400


class Mode(NamedTuple):
    """A mode of the contact, which lasts until `guard` falls to zero.

    rate: that of the state (displacement, velocity, shear force); settle: the state at the end,
    with the guard exactly zero.
    """

    rate: Callable[[float, Array], list[float]]
    guard: Callable[[Array], float]
    settle: Callable[[Array], list[float]]


def overlap(
    *, rho: float, r: float, kn: float, ks: float, mu: float, eta: float, v_b: float
) -> float:
    """dx [m] with mu kn dx = ks |y| an eighth of the damped half-period after T4's start."""
    m = _mass(rho, r)
    damped_rate = abs(np.roots([m, eta, ks])[0].imag)
    stuck = _stuck(m, ks, eta, np.inf)
    y = _march(pi / 8.0 / damped_rate, _scale(m, ks, v_b), lambda z: stuck)
    return float(ks * abs(y) / (mu * kn))


def t1(t: ArrayLike, *, rho: float, r: float, kn: float, v_a: float) -> Array:
    """y [m] of T1 at times t [s]: m y'' = kn max(-y, 0)."""
    return _head_on(t, _mass(rho, r), kn, 0.0, v_a)


def t2(t: ArrayLike, *, rho: float, r: float, kn: float, eta: float, v_a: float) -> Array:
    """y [m] of T2 at times t [s]: m y'' = kn max(-y, 0) - eta y'."""
    return _head_on(t, _mass(rho, r), kn, eta, v_a)


def t3(
    t: ArrayLike, *, rho: float, r: float, kn: float, ks: float, mu: float, eta: float, v_b: float
) -> Array:
    """y [m] of T3 at times t [s]: m y'' = F, F' = -ks y' while |F| <= mu kn dx."""
    cap = mu * kn * overlap(rho=rho, r=r, kn=kn, ks=ks, mu=mu, eta=eta, v_b=v_b)
    return _along_wall(t, v_b, m=_mass(rho, r), ks=ks, eta=0.0, cap=cap)


def t4(
    t: ArrayLike, *, rho: float, r: float, kn: float, ks: float, mu: float, eta: float, v_b: float
) -> Array:
    """y [m] of T4 at times t [s]: m y'' = F - eta y', F' = -ks y' while |F| <= mu kn dx."""
    cap = mu * kn * overlap(rho=rho, r=r, kn=kn, ks=ks, mu=mu, eta=eta, v_b=v_b)
    return _along_wall(t, v_b, m=_mass(rho, r), ks=ks, eta=eta, cap=cap)


def _mass(rho: float, r: float) -> float:
    """The mass [kg/m] of the regular hexagon around a disc of radius r."""
    return rho * 6.0 * r * r * tan(pi / 6.0)


def _head_on(t: ArrayLike, m: float, kn: float, eta: float, v: float) -> Array:
    touching = Mode(
        rate=lambda _, z: [z[1], (-kn * z[0] - eta * z[1]) / m, 0.0],
        guard=lambda z: -z[0],
        settle=lambda z: [0.0, z[1], 0.0],
    )
    apart = Mode(
        rate=lambda _, z: [z[1], -eta * z[1] / m, 0.0],
        guard=lambda z: z[0],
        settle=lambda z: [0.0, z[1], 0.0],
    )

    def choose(z: Array) -> Mode:
        return touching if z[0] < 0.0 or (z[0] == 0.0 and z[1] < 0.0) else apart

    return _march(t, _scale(m, kn, v), choose)


def _along_wall(t: ArrayLike, v: float, *, m: float, ks: float, eta: float, cap: float) -> Array:
    stuck = _stuck(m, ks, eta, cap)
    slipping = Mode(
        rate=lambda _, z: [z[1], (z[2] - eta * z[1]) / m, 0.0],
        guard=lambda z: -z[2] * z[1],
        settle=lambda z: [z[0], 0.0, z[2]],
    )

    def choose(z: Array) -> Mode:
        return slipping if abs(z[2]) >= cap and z[2] * z[1] < 0.0 else stuck

    return _march(t, _scale(m, ks, v), choose)


def _stuck(m: float, ks: float, eta: float, cap: float) -> Mode:
    return Mode(
        rate=lambda _, z: [z[1], (z[2] - eta * z[1]) / m, -ks * z[1]],
        guard=lambda z: cap - abs(z[2]),
        settle=lambda z: [z[0], z[1], copysign(cap, z[2])],
    )


def _scale(m: float, stiffness: float, v: float) -> Array:
    """Displacement [m], velocity [m/s] and force [N] of the undamped spring; v keeps its sign."""
    k = (stiffness / m) ** 0.5
    return np.array([abs(v) / k, v, m * k * abs(v)])


def _march(t: ArrayLike, scale: Array, choose: Callable[[Array], Mode]) -> Array:
    """The displacement [m] at times t [s] from the state (0, v, 0), mode after mode."""
    from scipy.integrate import solve_ivp

    t, now = np.asarray(t, dtype=np.float64), 0.0
    y, z = np.full(t.shape, np.nan), scale * [0.0, 1.0, 0.0]
    step = _STEP * scale[0] / abs(scale[1])
    for _ in range(_MOST_MODES):
        mode = choose(z)
        run = solve_ivp(
            mode.rate,
            (now, t.max() + step),
            z,
            method="DOP853",
            dense_output=True,
            events=_falling(mode.guard),
            rtol=_RTOL,
            atol=_RTOL * np.abs(scale),
            max_step=step,
        )
        here = (now <= t) & (t <= run.t[-1])
        if run.sol is not None and here.any():
            y[here] = run.sol(t[here])[0]
        if run.status == 0:
            return y
        if run.status < 0:
            raise RuntimeError(f"{mode} from t = {now} s; {run.message}")
        now, z = run.t[-1], np.array(mode.settle(run.y[:, -1]))
    raise RuntimeError(f"{_MOST_MODES} modes did not reach t = {t.max()} s")


def _falling(guard: Callable[[Array], float]) -> Callable[[float, Array], float]:
    """The guard as a terminal event of solve_ivp."""

    def event(_: float, z: Array) -> float:
        return guard(z)

    event.terminal, event.direction = True, -1  # type: ignore[attr-defined]
    return event

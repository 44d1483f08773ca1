"""Shear waves in a column of height H [m] on a base that moves, with a free top.

The base moves by f(t) = D (1 - cos 2 pi F t) from t = 0 on; c [m/s] is the speed of shear waves.
The waves run up the column and are reflected at its top (d'Alembert):

u(y, t) = sum over k of (-1)^k (f(t - (2 k H + y)/c) + f(t - (2 (k + 1) H - y)/c)).

Under a steady sine, the motion of the column at y over that of the base is cos(q (H - y))/cos(q H),
q = w/c. In n layers that strain uniformly, q of a layer of h = H/n follows from cos q h = (1 - W^2
h^2/3c^2)/(1 + W^2 h^2/6c^2), W = w, as for linear finite elements with consistent mass. DDA's step
dt has W^2 = (4/dt^2) sin(w dt/2) tan(w dt/2) exp(-i w dt/2) in place of w^2, which damps. SHAKE has
a constant damping ratio z: q = w/(c sqrt(1 - 2 z^2 + 2 i z sqrt(1 - z^2))). Layers with different
properties, of stiffness matrices (a, -b; -b, a), are treated from the top down: the impedance at
the lower end of a layer is Z = a - b^2/(a + Z'), where Z' is that of the layer above, and the
motion of its upper end over that of its lower end is b/(a + Z'). Uniform strain has a = G/h - W^2
rho h/3 and b = G/h + W^2 rho h/6, a wave has a = G q cot q h and b = G q/sin q h. Every function
raises ValueError for a parameter out of range.
"""

from cmath import acos, exp
from cmath import cos as ccos
from cmath import sin as csin
from cmath import sqrt as csqrt
from cmath import tan as ctan
from collections.abc import Sequence
from math import ceil, pi, sin, sqrt, tan
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import (
    require_at_least_0,
    require_few,
    require_positive,
    require_times,
)

Array = NDArray[np.float64]
_MOST = 20000  # reflections, or steps: less than a second of calculation


def displacement(t: ArrayLike, *, y: float, height: float, c: float, D: float, F: float) -> Array:
    """The displacement u [m] at the height y [m] at times t >= 0 [s]; D [m], F [Hz]."""
    t = require_times(t)
    require_positive("in SI units", height=height, c=c, F=F)
    if not 0.0 <= y <= height:
        raise ValueError(f"y = {y} m; it must lie between 0 and the height, {height} m")

    def base(late: Array) -> Array:
        return np.where(late > 0.0, D * (1.0 - np.cos(2.0 * pi * F * late)), 0.0)

    returns = c * float(t.max(initial=0.0)) / (2.0 * height)
    require_few("reflections of the wave", returns, _MOST)
    u = np.zeros_like(t)
    for k in range(ceil(returns) + 1):
        up, down = 2.0 * k * height + y, 2.0 * (k + 1) * height - y
        u += (-1.0) ** k * (base(t - up / c) + base(t - down / c))
    return u


class _Chain(NamedTuple):
    """Modes of layers on their base: w [rad/s], excitation by the base, value at a layer's centre.

    They are sin(q i) at the joints i of n layers, q = (2j - 1) pi/2n, w^2 = (6 c^2/h^2)(1 - cos
    q)/(2 + cos q). The modal mass is n (2 + cos q)/6 times the mass of a layer, and the
    acceleration of the base acts on cot(q/2)/2 times the mass of a layer.
    """

    w: Array
    pushed: Array
    seen: Array


def _chain(number: int, layers: int, height: float, c: float) -> _Chain:
    require_positive("in SI units", height=height, c=c)
    if not 1 <= number <= layers:
        raise ValueError(f"number = {number}; it must lie between 1 and {layers} layers")
    q = (2.0 * np.arange(1, layers + 1) - 1.0) * pi / (2.0 * layers)
    w = layers * c / height * np.sqrt(6.0 * (1.0 - np.cos(q)) / (2.0 + np.cos(q)))
    pushed = 3.0 / (np.tan(q / 2.0) * layers * (2.0 + np.cos(q)))
    return _Chain(w, pushed, np.sin(q * (number - 0.5)) * np.cos(q / 2.0))


def layered_displacement(
    t: ArrayLike, *, number: int, layers: int, height: float, c: float, D: float, F: float
) -> Array:
    """The displacement u [m] of the centre of layer `number` from the base at times t >= 0 [s].

    A mode of w_j responds to the motion of the base with D w^2 (cos w t - cos w_j t)/(w_j^2 - w^2).
    """
    t, own = require_times(t), _chain(number, layers, height, c)
    require_positive("Hz", F=F)
    w, late = 2.0 * pi * F, t[:, None] / 2.0
    # The difference of cosines over that of squares has a finite limit at resonance.
    swing = 2.0 * late**2 * np.sinc(late * (own.w + w) / pi) * np.sinc(late * (own.w - w) / pi)
    driven = D * w * w * swing @ (own.pushed * own.seen)
    return np.asarray(D * (1.0 - np.cos(w * t)) - driven)


def stepped_displacement(
    steps: int, *, dt: float, number: int, layers: int, height: float, c: float, D: float, F: float
) -> Array:
    """u [m] (steps + 1,) of the same centre in steps dt [s] of DDA.

    A step has the increment d, the acceleration (2/dt^2)(d - dt v) and the end velocity 2 d/dt - v.
    """
    own = _chain(number, layers, height, c)
    require_positive("in SI units", dt=dt, F=F)
    require_few("steps", steps, _MOST)
    base = D * (1.0 - np.cos(2.0 * pi * F * dt * np.arange(steps + 1)))
    u, stiff = np.zeros(steps + 1), 1.0 + (own.w * dt) ** 2 / 2.0
    swing, speed, pace = np.zeros(layers), np.zeros(layers), 0.0  # velocities in m per step
    for i in range(steps):
        moved = base[i + 1] - base[i]
        way = (speed - own.pushed * (moved - pace) - (stiff - 1.0) * swing) / stiff
        swing, speed, pace = swing + way, 2.0 * way - speed, 2.0 * moved - pace
        u[i + 1] = base[i + 1] + own.seen @ swing
    return u


def layered_ratio(*, F: float, dt: float, layers: int, height: float, c: float) -> complex:
    """The amplitude of the top layer's centre over that of the base, in steps of dt [s]."""
    require_positive("in SI units", F=F, dt=dt, height=height, c=c)
    half = pi * F * dt
    if not half < pi / 2.0:
        raise ValueError(f"F = {F} Hz; steps of {dt} s resolve no sine from {0.5 / dt:.6g} Hz on")
    square = 4.0 / dt**2 * sin(half) * tan(half) * exp(-1j * half)
    s = square * (height / layers / c) ** 2
    turn = acos((1.0 - s / 3.0) / (1.0 + s / 6.0))  # phase over one layer
    return 0.5 * (1.0 + ccos(turn)) / ccos(layers * turn)


def continuous_ratio(*, F: float, y: float, height: float, c: float, damping: float) -> float:
    """The amplitude at the height y [m] over that of the base, at a constant damping ratio."""
    require_positive("in SI units", F=F, height=height, c=c)
    require_at_least_0("", damping=damping)
    z = damping
    if not z < 1.0:
        raise ValueError(f"damping = {z}; a ratio of damping must be below 1")
    q = 2.0 * pi * F / (c * csqrt(1.0 - 2.0 * z * z + 2.0j * z * sqrt(1.0 - z * z)))
    return abs(ccos(q * (height - y)) / ccos(q * height))


class Layer(NamedTuple):
    """The thickness [m], shear modulus [Pa] and density [kg/m3] of a layer."""

    thick: float
    G: float
    rho: float


def unlike_ratio(*, F: float, dt: float, layers: Sequence[Layer]) -> complex:
    """The ratio of `layered_ratio` for different layers, listed from the base up."""
    require_positive("in SI units", F=F, dt=dt)
    half = pi * F * dt
    if not half < pi / 2.0:
        raise ValueError(f"F = {F} Hz; steps of {dt} s resolve no sine from {0.5 / dt:.6g} Hz on")
    square = 4.0 / dt**2 * sin(half) * tan(half) * exp(-1j * half)
    springs = [(one.G / one.thick, square * one.rho * one.thick) for one in layers]
    below, top = _carried([(k - m / 3.0, k + m / 6.0) for k, m in springs])
    return 0.5 * (below + top)


def unlike_continuous_ratio(*, F: float, layers: Sequence[Layer], damping: float) -> float:
    """The amplitude of the top layer's centre over the base's, at a constant damping ratio."""
    require_positive("in SI units", F=F)
    require_at_least_0("", damping=damping)
    z = damping
    if not z < 1.0:
        raise ValueError(f"damping = {z}; a ratio of damping must be below 1")
    soft = 1.0 - 2.0 * z * z + 2.0j * z * sqrt(1.0 - z * z)
    waves = [(one.G * soft, 2.0 * pi * F * csqrt(one.rho / (one.G * soft))) for one in layers]
    turns = [(G * q, q * one.thick) for (G, q), one in zip(waves, layers, strict=True)]
    below, top = _carried([(stiff / ctan(x), stiff / csin(x)) for stiff, x in turns])
    return abs(0.5 * (below + top) / ccos(0.5 * turns[-1][1]))


def _carried(layers: list[tuple[complex, complex]]) -> tuple[complex, complex]:
    """The motions of the ends of the top layer over that of the base.

    layers: the coefficients a and b of each, from the base up.
    """
    above, shares = 0j, []
    for a, b in reversed(layers):
        shares.append(b / (a + above))
        above = a - b * b / (a + above)
    below = complex(1.0)
    for share in shares[:0:-1]:
        below *= share
    return below, below * shares[0]

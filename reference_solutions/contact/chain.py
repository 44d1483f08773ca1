"""Modes and waves of a chain of N masses and equal springs K on a base, in closed form.

The masses move along the chain: m_i u_i'' = K (u_{i-1} - 2 u_i + u_{i+1}), u_0 = 0 at the base,
and the last mass has a free end. With equal masses m the j-th angular frequency is
2 sqrt(K/m) sin(q_j/2) and its mode sin(i q_j), q_j = (2j - 1) pi/(2N + 1) (e.g. Brillouin 1946,
Wave propagation in periodic structures, ch. 3). A wave with the phase q per mass has the group
velocity sqrt(K/m) cos(q/2) masses per second. Where the masses change from m to M, the reflected
part of its amplitude is |sin((q - Q)/2)/sin((q + Q)/2)|, from u = e^{iqn} + R e^{-iqn} up to the
change and T e^{iQn} beyond; for long waves it is |sqrt m - sqrt M|/(sqrt m + sqrt M). Every
function raises ValueError for parameters outside their ranges.
"""

from math import asin, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_positive, require_times

Array = NDArray[np.float64]


def frequency(j: int, N: int, m: float, K: float) -> float:
    """The j-th angular frequency [1/s], with j from 1 to N."""
    require_positive("kg, N/m", m=m, K=K)
    return 2.0 * sqrt(K / m) * sin(_phase(j, N) / 2.0)


def shape(j: int, N: int) -> Array:
    """The j-th mode (N,), ordered from the base; its largest component is near 1."""
    return np.sin(_phase(j, N) * np.arange(1.0, N + 1.0))


def reflected(q: float, m: float, M: float, K: float) -> float:
    """The part of its energy that a wave of phase q per mass reflects where m changes to M."""
    require_positive("kg, N/m", m=m, M=M, K=K)
    if not 0.0 < q < pi:
        raise ValueError(f"q = {q} rad; a wave has a phase between 0 and pi a mass")
    beyond = sqrt(M / m) * sin(q / 2.0)
    if beyond >= 1.0:
        return 1.0
    Q = 2.0 * asin(beyond)
    return (sin((q - Q) / 2.0) / sin((q + Q) / 2.0)) ** 2


def motion(t: ArrayLike, thrown: ArrayLike, masses: ArrayLike, K: float) -> tuple[Array, Array]:
    """Displacements and velocities (k, N) [m, m/s] at times (k,) [s], by superposition of modes.

    thrown: initial velocities (N,) [m/s] at zero displacement; masses: (N,) [kg], which may differ.
    """
    times, modes = require_times(t), _modes(thrown, masses, K)
    turned = np.outer(times, modes.w)
    moved, moving = np.sin(turned) * modes.parts / modes.w, np.cos(turned) * modes.parts
    return np.asarray(moved @ modes.back), np.asarray(moving @ modes.back)


def leapfrog(
    t: ArrayLike, thrown: ArrayLike, masses: ArrayLike, K: float, dt: float
) -> tuple[Array, Array]:
    """What `motion` is in a leapfrog of step dt [s] that begins with the velocity at t = 0.

    Its velocity is the mean of those before and after a whole step. A mode v cos(w t) becomes
    v cos(W t) and its displacement v dt/sin(W dt) sin(W t), with sin(W dt/2) = w dt/2: so the
    velocities of a wave that stays a sum of modes have other phases alone. Raises ValueError where
    a mode has w dt >= 2, since the leapfrog then diverges.
    """
    times, modes = require_times(t), _modes(thrown, masses, K)
    require_positive("s", dt=dt)
    halves = modes.w * dt / 2.0
    if not halves.max() < 1.0:
        raise ValueError(f"dt = {dt} s; a leapfrog diverges from {2.0 / modes.w.max()} s on")
    phase = 2.0 * np.arcsin(halves)  # per step
    turned = np.outer(times / dt, phase)
    moved = np.sin(turned) * modes.parts * dt / np.sin(phase)
    return np.asarray(moved @ modes.back), np.asarray(np.cos(turned) * modes.parts @ modes.back)


class _Modes(NamedTuple):
    """Frequencies [1/s], the velocity that each mode begins with, and the shapes (N, N) in rows."""

    w: Array
    parts: Array
    back: Array


def _modes(thrown: ArrayLike, masses: ArrayLike, K: float) -> _Modes:
    v, m = np.asarray(thrown, float), np.asarray(masses, float)
    if m.shape != v.shape or not (m > 0.0).all():
        raise ValueError(f"masses has shape {m.shape}; one positive mass for each velocity")
    squares, shapes = np.linalg.eigh(_stiffness(len(m), K) / np.sqrt(np.outer(m, m)))
    return _Modes(np.sqrt(squares), shapes.T @ (np.sqrt(m) * v), shapes.T / np.sqrt(m))


def _stiffness(N: int, K: float) -> Array:
    require_positive("N/m", K=K)
    next_to = np.eye(N, k=1)
    matrix = 2.0 * np.eye(N) - (next_to + next_to.T)
    matrix[-1, -1] = 1.0
    return np.asarray(K * matrix)


def _phase(j: int, N: int) -> float:
    if not 1 <= j <= N:
        raise ValueError(f"j = {j}; a chain of {N} has modes 1 to {N}")
    return (2 * j - 1) * pi / (2 * N + 1)

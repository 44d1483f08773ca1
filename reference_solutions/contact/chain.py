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
    times, v = require_times(t), np.asarray(thrown, float)
    m = np.asarray(masses, float)
    if m.shape != v.shape or not (m > 0.0).all():
        raise ValueError(f"masses has shape {m.shape}; one positive mass for each velocity")
    squares, shapes = np.linalg.eigh(_stiffness(len(m), K) / np.sqrt(np.outer(m, m)))
    w = np.sqrt(squares)
    parts, back = shapes.T @ (np.sqrt(m) * v), shapes.T / np.sqrt(m)
    turned = np.outer(times, w)
    return np.asarray((np.sin(turned) * parts / w) @ back), np.asarray(
        (np.cos(turned) * parts) @ back
    )


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

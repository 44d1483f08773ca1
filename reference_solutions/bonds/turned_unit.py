"""The path of a unit that rotates as a whole by any angle, integrated by a scheme of high order.

Four elements, which cannot rotate, are bonded in pairs at the distance d. A bond b pulls with
kn (L - d) along its unit vector n. Its shear spring has the force F with F' = ks v - n (F . n') and
the relative velocity v across n (Cundall and Strack 1979): F grows at the rate ks v and rotates
with the bond. For small angles a the energy is 2 ks d^2 a^2 and the unit oscillates at
2 sqrt(ks/m); at larger angles the rotation stretches the unit too.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Path = Callable[[Array], Array]
ROUNDED = 1e-12


def path(
    position: Array, pairs: NDArray[np.intp], velocity: Array, *, m: float, kn: float, ks: float
) -> Path:
    """Displacements (k, 4, 3) [m] at times (k,) [s] of elements that start with `velocity`.

    position, velocity: (4, 3) [m], [m/s]; pairs: (6, 2) elements. Bonds are free of force at t = 0.
    """
    i, j = pairs.T
    length = np.linalg.norm(position[j] - position[i], axis=1)
    rate = np.sqrt(kn / m)
    size = np.abs(velocity).max() / rate  # scale of displacements in the equations

    def change(_: float, state: Array) -> Array:
        u, v = state[:12].reshape(4, 3), state[12:24].reshape(4, 3)
        shear = state[24:].reshape(-1, 3)
        apart = position[j] - position[i] + size * (u[j] - u[i])
        now = np.linalg.norm(apart, axis=1)
        n = apart / now[:, None]
        relative = v[j] - v[i]
        across = relative - _along(relative, n)
        longer = _longer(position[j] - position[i], size * (u[j] - u[i]), length) / size
        force = kn / m * longer[:, None] * n + shear
        push = np.zeros((4, 3))
        np.add.at(push, i, force)
        np.add.at(push, j, -force)
        turning = size * across / now[:, None]  # n'
        loaded = ks / m * across - n * np.einsum("bk,bk->b", shear, turning)[:, None]
        return np.concatenate([v.ravel(), push.ravel(), loaded.ravel()])

    start = np.concatenate([np.zeros(12), (velocity / size).ravel(), np.zeros(3 * len(pairs))])
    scale = np.concatenate([np.ones(12), np.full(12, rate), np.full(3 * len(pairs), rate**2)])

    def at(t: Array) -> Array:
        if not t.any():
            return np.zeros((len(t), 4, 3))
        states = _integrated(change, t, start, ROUNDED * scale)
        return np.asarray(size * states[:12].T.reshape(-1, 4, 3))

    return at


def _integrated(
    change: Callable[[float, Array], Array], t: Array, start: Array, rounded: Array
) -> Array:
    """The states (n, k) at times (k,) [s]; rounded: the absolute tolerance of each component."""
    from scipy.integrate import solve_ivp

    solved = solve_ivp(
        change, (0.0, float(t.max())), start, "DOP853", t, rtol=ROUNDED, atol=rounded
    )
    return np.asarray(solved.y)


def _along(vectors: Array, n: Array) -> Array:
    """The components, as vectors (b, 3), of `vectors` (b, 3) along unit vectors n (b, 3)."""
    return np.asarray(np.einsum("bk,bk->b", vectors, n)[:, None] * n)


def _longer(offset: Array, moved: Array, length: Array) -> Array:
    """|offset + moved| - |offset|, evaluated without cancellation of digits."""
    now = np.linalg.norm(offset + moved, axis=1)
    return np.asarray(np.einsum("bk,bk->b", 2 * offset + moved, moved) / (now + length))

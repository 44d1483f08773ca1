"""Motion of unlike spheres in a row on unlike bonds, exact along it and of first order across it.

N spheres of masses m [kg] at positions x [m] on a line are joined by bonds (B, 2) between spheres i
and j; a bond has the stiffness kn along it and ks across it [N/m]. Every function raises ValueError
for parameters outside their ranges.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reference_solutions.parameters import require_positive, require_times

Array = NDArray[np.float64]
Pairs = NDArray[np.int64]


@dataclass(frozen=True)
class Row:
    """Masses (N,) [kg], positions along the line (N,) [m], and bonds: (B, 2), kn (B,) [N/m]."""

    m: Array
    x: Array
    bonds: Pairs
    kn: Array

    def __post_init__(self) -> None:
        for mass, stiffness in zip(self.m, self.kn, strict=False):
            require_positive("in SI units", m=float(mass), kn=float(stiffness))


def along(
    t: Array, row: Row, *, length: Array, v: Array, g: float, held: bool
) -> tuple[Array, Array]:
    """Displacements (k, N) [m] at times t (k,) [s], and the reaction (k,) [N] of the first sphere.

    length: (B,) [m] of the unstretched bonds; v: (N,) [m/s] at t = 0; g [m/s2] along the row.
    held: whether the first sphere is fixed; the reaction then balances its weight and its bonds.
    """
    times, (stiffness, pulled) = require_times(t), _springs(row, length)
    push = row.m * g + pulled
    free = np.arange(int(held), len(row.m))
    root = np.sqrt(row.m[free])
    square, modes = np.linalg.eigh(stiffness[np.ix_(free, free)] / np.outer(root, root))
    speed, load = modes.T @ (root * v[free]), modes.T @ (push[free] / root)
    moved = np.stack([_mode(times, *one) for one in zip(square, speed, load, strict=True)])
    u = np.zeros((len(times), len(row.m)))
    u[:, free] = moved.T @ modes.T / root
    return u, -(push - u @ stiffness)[:, 0]


def slowed(t: Array, row: Row, *, length: Array, v: Array, eta: float) -> Array:
    """Displacements (k, N) [m] at times t (k,) [s] with a drag -eta v [N s/m] on every sphere.

    length: (B,) [m] of the unstretched bonds; v: (N,) [m/s] at t = 0. The drag is the same for all
    spheres and their masses differ, so that it couples the modes; the solution is that of y' = A y
    for the vector y of displacements, velocities and the number 1.
    """
    require_positive("N s/m", eta=eta)
    stiffness, pulled = _springs(row, length)
    drag, square = np.diag(eta / row.m), stiffness / row.m[:, None]
    return _linear(require_times(t), drag, square, pulled / row.m, v)


def leapt(t: Array, row: Row, *, length: Array, v: Array, eta: float, dt: float) -> Array:
    """What a leapfrog with drag at the middle of its steps dt [s] gives for `slowed`, up to dt^4.

    Its central differences solve x'' + C x' + A x = f - dt^2/12 (x'''' + 2 C x'''), started with
    the velocity v - dt^2/6 x'''; in the terms of dt^2, derivatives follow from x'' = f - C x' - A x
    (Warming and Hyett 1974, The modified equation approach to the stability and accuracy analysis
    of finite-difference methods, Journal of Computational Physics 14, 159-179).
    """
    require_positive("N s/m, s", eta=eta, dt=dt)
    stiffness, pulled = _springs(row, length)
    drag, square, load = np.diag(eta / row.m), stiffness / row.m[:, None], pulled / row.m
    more = dt**2 / 12 * (drag @ drag + square)
    third = -drag @ (load - drag @ v) - square @ v
    return _linear(
        require_times(t),
        drag + more @ drag - dt**2 / 12 * drag @ square,
        square + more @ square,
        load + more @ load,
        v - dt**2 / 6 * third,
    )


def _linear(times: Array, drag: Array, square: Array, load: Array, v: Array) -> Array:
    """Displacements (k, N) at times (k,) of u'' = load - drag u' - square u, from u = 0, u' = v."""
    from scipy.linalg import expm

    n = len(v)
    rate = np.zeros((2 * n + 1, 2 * n + 1))
    rate[:n, n:-1] = np.eye(n)
    rate[n:-1, :n], rate[n:-1, n:-1], rate[n:-1, -1] = -square, -drag, load
    start = np.concatenate([np.zeros(n), v, [1.0]])
    return np.asarray((expm(rate * times[:, None, None]) @ start)[:, :n])


def accelerations(row: Row, *, length: Array, v: Array, g: float = 0.0, eta: float = 0.0) -> Array:
    """The accelerations (N,) [m/s2] along the row at t = 0; arguments as those of both motions."""
    return np.asarray(g + (_springs(row, length)[1] - eta * v) / row.m)


def highest_frequency(row: Row) -> float:
    """The angular frequency [1/s] of the fastest oscillation along the row of free spheres."""
    stiffness, root = _springs(row, np.zeros(len(row.kn)))[0], np.sqrt(row.m)
    return float(np.sqrt(np.linalg.eigvalsh(stiffness / np.outer(root, root)).max()))


def _springs(row: Row, length: Array) -> tuple[Array, Array]:
    """The stiffness (N, N) [N/m] along the row, and the forces (N,) [N] of bonds at t = 0."""
    i, j = row.bonds.T
    pull = np.zeros((len(row.kn), len(row.m)))  # elongation of each bond by displacements
    pull[np.arange(len(i)), i] -= np.sign(row.x[j] - row.x[i])
    pull[np.arange(len(i)), j] += np.sign(row.x[j] - row.x[i])
    first = row.kn * (np.abs(row.x[j] - row.x[i]) - length)
    return pull.T @ (row.kn[:, None] * pull), -pull.T @ first


def _mode(t: Array, square: float, speed: float, load: float) -> Array:
    """q of q'' + square q = load with q = 0, q' = speed at t = 0; without stiffness it drifts."""
    if square < 1e-9 * max(1.0, abs(square)):
        return np.asarray(speed * t + 0.5 * load * t**2)
    w = np.sqrt(square)
    return np.asarray(load / square * (1.0 - np.cos(w * t)) + speed / w * np.sin(w * t))


def across(t: Array, row: Row, *, r: Array, ks: Array, spin: Array, v: Array) -> Array:
    """Displacements (k, N, 2) [m] across the row, to first order, of spheres that spin about it.

    r: radii (N,) [m]; ks: (B,) [N/m]; spin: (N,) [1/s] about the line; v: (N, 2) [m/s] at t = 0.
    Bonds are unstretched at t = 0, and inertias are 2/5 m r2. Displacements across x are complex,
    z = u_y + i u_z, as are the spins p across x; W are the spins about x. The surfaces of a bond of
    length L with the shear s meet at distances a from the centres:
    s' = d' - i (a1 W1 + a2 W2) d/L + i (a1 p1 + a2 p2) + i (W1 + W2)/2 s, d = z2 - z1,
    m z'' = +- ks s, 2/5 m r2 p' = i a ks s.
    """
    from scipy.linalg import expm

    times, n, b = require_times(t), len(row.m), len(row.bonds)
    rate = np.zeros((3 * n + b, 3 * n + b), complex)  # of z, z', p and s in turn
    places, speeds, spins = (np.arange(k * n, (k + 1) * n) for k in range(3))
    rate[places, speeds] = 1.0
    inertia = 0.4 * row.m * r**2
    for k, (i, j) in enumerate(row.bonds):
        sense = np.sign(row.x[j] - row.x[i])
        whole, s = abs(row.x[j] - row.x[i]), 3 * n + k
        beyond = 0.5 * (whole - r[i] - r[j])
        arm = {i: r[i] + beyond, j: r[j] + beyond}
        roll = sum(arm[e] * spin[e] for e in (i, j)) / whole
        rate[s, s] = 0.5j * (spin[i] + spin[j])
        for e, sign in ((i, -1.0), (j, 1.0)):
            rate[s, speeds[e]], rate[s, places[e]] = sign, -1j * roll * sign
            rate[s, spins[e]] = 1j * sense * arm[e]
            rate[speeds[e], s] = -sign * ks[k] / row.m[e]
            rate[spins[e], s] = 1j * sense * arm[e] * ks[k] / inertia[e]
    start = np.zeros(3 * n + b, complex)
    start[speeds] = v[:, 0] + 1j * v[:, 1]
    found = (expm(rate * times[:, None, None]) @ start)[:, places]
    return np.stack([found.real, found.imag], axis=-1)

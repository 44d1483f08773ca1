"""Second routes to shear waves in a column: sums of modes, and finite elements in steps of DDA."""

from collections.abc import Sequence
from math import pi

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def displacement(t: Array, *, y: float, height: float, c: float, D: float, F: float) -> Array:
    """u [m] as a sum over 4000 modes of a column fixed below, driven by the inertia force."""
    odd = 2.0 * np.arange(1, 4001) - 1.0
    w, drive = odd * pi * c / (2.0 * height), 2.0 * pi * F
    shape = np.sin(odd * pi * y / (2.0 * height)) * 4.0 / (odd * pi)
    swing = np.cos(drive * t[:, None]) - np.cos(t[:, None] * w)
    relative = -(swing * (drive**2 / (w**2 - drive**2))) @ shape
    return np.asarray(D * (1.0 - np.cos(drive * t) + relative))


def layered_displacement(
    t: Array, *, number: int, layers: int, height: float, c: float, D: float, F: float
) -> Array:
    """u [m] of the centre of a layer as a sum over the modes of the element matrices."""
    from scipy.linalg import eigh

    mass, stiff = _elements(layers, height, c)
    squares, swings = eigh(stiff[1:, 1:], mass[1:, 1:])
    drive = 2.0 * pi * F
    felt = swings.T @ mass[1:].sum(axis=1) * drive**2 / (squares - drive**2)
    turned = np.cos(drive * t[:, None]) - np.cos(t[:, None] * np.sqrt(squares))
    joints = np.column_stack([np.zeros(len(t)), -(turned * felt) @ swings.T])
    moved = (joints[:, number] + joints[:, number - 1]) / 2.0
    return np.asarray(D * (1.0 - np.cos(drive * t) + moved))


def stepped_displacement(
    steps: int, *, dt: float, number: int, layers: int, height: float, c: float, D: float, F: float
) -> Array:
    """u [m] of that centre in steps of DDA, by matrices that include the base among the joints."""
    mass, stiff = _elements(layers, height, c)
    matrix = 2.0 / dt**2 * mass + stiff
    u, v, seen = np.zeros(layers + 1), np.zeros(layers + 1), [0.0]
    for i in range(steps):
        ahead = D * (1.0 - np.cos(2.0 * pi * F * dt * (i + 1)))
        pull = 2.0 / dt * mass @ v - stiff @ u
        d = np.full(layers + 1, ahead - u[0])
        d[1:] = np.linalg.solve(matrix[1:, 1:], (pull - matrix[:, 0] * d[0])[1:])
        u, v = u + d, 2.0 / dt * d - v
        seen.append((u[number] + u[number - 1]) / 2.0)
    return np.array(seen)


def layered_ratio(*, F: float, dt: float, layers: int, height: float, c: float) -> complex:
    """The steady-state motion of a chain of linear elements, by the equations of the step.

    With u and v of all nodes as exp(i w t) and e = exp(i w dt), v (e + 1) = (2/dt)(e - 1) u, and
    (2/dt^2) M ((e - 1) u - dt v) + K e u = 0 on all nodes but the base.
    """
    mass, stiff = _elements(layers, height, c)
    e = np.exp(2j * pi * F * dt)
    moved = (e - 1.0) - 2.0 * (e - 1.0) / (e + 1.0)
    matrix = (2.0 / dt**2 * moved * mass + e * stiff)[1:]
    u = np.linalg.solve(matrix[:, 1:], -matrix[:, 0])
    below = u[-2] if layers > 1 else 1.0
    return complex(u[-1] + below) / 2.0


def continuous_ratio(*, F: float, height: float, c: float, damping: float) -> float:
    """The amplitude of the top over that of the base, by 300 elements of SHAKE's material."""
    mass, stiff = _elements(300, height, c)
    turned = np.exp(2j * np.arcsin(damping)) * stiff
    matrix = (turned - (2.0 * pi * F) ** 2 * mass)[1:]
    return float(abs(np.linalg.solve(matrix[:, 1:], -matrix[:, 0])[-1]))


def unlike_ratio(*, F: float, dt: float, layers: Sequence[tuple[float, float, float]]) -> complex:
    """The ratio of `layered_ratio` for layers (thickness, modulus G, density) from the base up."""
    mass, stiff = _unlike(layers)
    e = np.exp(2j * pi * F * dt)
    moved = (e - 1.0) - 2.0 * (e - 1.0) / (e + 1.0)
    matrix = (2.0 / dt**2 * moved * mass + e * stiff)[1:]
    u = np.concatenate([[1.0], np.linalg.solve(matrix[:, 1:], -matrix[:, 0])])
    return complex(u[-1] + u[-2]) / 2.0


def unlike_continuous_ratio(
    *, F: float, layers: Sequence[tuple[float, float, float]], damping: float, parts: int = 100
) -> float:
    """The amplitude at the top layer's centre over the base's, by elements of SHAKE's material."""
    fine = [(thick / parts, G, rho) for thick, G, rho in layers for _ in range(parts)]
    mass, stiff = _unlike(fine)
    matrix = (np.exp(2j * np.arcsin(damping)) * stiff - (2.0 * pi * F) ** 2 * mass)[1:]
    return float(abs(np.linalg.solve(matrix[:, 1:], -matrix[:, 0])[-1 - parts // 2]))


def _unlike(layers: Sequence[tuple[float, float, float]]) -> tuple[Array, Array]:
    """The consistent mass and stiffness (n, n) of linear elements of different layers."""
    n = len(layers) + 1
    mass, stiff = np.zeros((n, n)), np.zeros((n, n))
    for i, (thick, G, rho) in enumerate(layers):
        mass[i : i + 2, i : i + 2] += rho * thick / 6.0 * np.array([[2.0, 1.0], [1.0, 2.0]])
        stiff[i : i + 2, i : i + 2] += G / thick * np.array([[1.0, -1.0], [-1.0, 1.0]])
    return mass, stiff


def _elements(count: int, height: float, c: float) -> tuple[Array, Array]:
    """The consistent mass and stiffness (n, n) of equal linear elements, over the density."""
    h, n = height / count, count + 1
    mass, stiff = np.zeros((n, n)), np.zeros((n, n))
    for i in range(count):
        mass[i : i + 2, i : i + 2] += h / 6.0 * np.array([[2.0, 1.0], [1.0, 2.0]])
        stiff[i : i + 2, i : i + 2] += c * c / h * np.array([[1.0, -1.0], [-1.0, 1.0]])
    return mass, stiff

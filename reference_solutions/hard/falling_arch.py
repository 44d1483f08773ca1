"""The fall from rest of an arch too thin to stand, as a mechanism with five hinges.

Half of a symmetric arch of n voussoirs with straight edges consists of two bodies. The lower
rotates about the outer edge of the springing. The upper is hinged to it at the inner edge of the
joint between them, and its outer edge at the crown stays in the plane of symmetry (the mechanism of
Heyman 1969). At each time of the integration a linear system gives the accelerations and the forces
in these hinges. Raises ValueError for arches that stand.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_positive, require_times

Array = NDArray[np.float64]


class _Half:
    """Half of an arch as two bodies, (mass, centroid, moment of inertia) each, and its hinges."""

    def __init__(self, n: int, thick: float, size: float, g: float, joint: int) -> None:
        angle = np.linspace(0.0, np.pi, n + 1)
        edge = size * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        inner, outer = (1.0 - 0.5 * thick) * edge, (1.0 + 0.5 * thick) * edge
        self.lower = _joined(inner, outer, range(joint))
        self.upper = _joined(inner, outer, range(joint, n // 2))
        self.last = _joined(inner, outer, range(n // 2 - 1, n // 2))[1] - self.upper[1]
        self.foot, self.pin, self.crown = outer[0], inner[joint], outer[n // 2]
        (one, _, turn), (two, _, spin) = self.lower, self.upper
        self.mass = np.array([one, one, turn, two, two, spin])
        self.weight = -g * self.mass * np.array([0, 1, 0, 0, 1, 0])
        self.start = np.concatenate((self.lower[1], [0.0], self.upper[1], [0.0], np.zeros(6)))

    def rate(self, _: float, y: Array) -> Array:
        """The rate of positions, angles and their rates (12,): M a = weight + hinge forces."""
        v, (one, two) = y[6:], (y[2], y[5])
        rows, back = np.zeros((5, 6)), np.zeros(5)
        for row, arm, body, spun, sign in (
            (0, _turned(self.foot - self.lower[1], one), 0, v[2], 1.0),
            (2, _turned(self.pin - self.lower[1], one), 0, v[2], 1.0),
            (2, _turned(self.pin - self.upper[1], two), 3, v[5], -1.0),
        ):
            rows[row : row + 2, body : body + 2] = sign * np.eye(2)
            rows[row : row + 2, body + 2] = sign * np.array([-arm[1], arm[0]])
            back[row : row + 2] += sign * spun**2 * arm
        arm = _turned(self.crown - self.upper[1], two)
        rows[4, 3], rows[4, 5], back[4] = 1.0, -arm[1], v[5] ** 2 * arm[0]
        light = rows / self.mass
        pins = np.linalg.solve(light @ rows.T, back - light @ self.weight)
        return np.concatenate((v, (self.weight + rows.T @ pins) / self.mass))

    def begins(self) -> float:
        """The initial downward acceleration [m/s2] of the voussoir beside the crown."""
        push = self.rate(0.0, self.start)[6:]
        return float(-push[4] - push[5] * self.last[0])


def crown_drop(t: ArrayLike, *, n: int, thick: float, size: float, g: float) -> Array:
    """The drop [m] of the voussoir beside the crown at increasing times t (k,) [s]."""
    from scipy.integrate import solve_ivp

    require_positive("in SI units", thick=thick, size=size, g=g)
    t = require_times(t)
    half = max((_Half(n, thick, size, g, j) for j in range(1, n // 2)), key=_Half.begins)
    if half.begins() <= 0.0:
        raise ValueError(f"thick = {thick}; such an arch of n = {n} stands")
    span, small = (0.0, 1e-6 + float(t[-1])), 1e-14 * size  # a span even if t = 0
    y = solve_ivp(half.rate, span, half.start, "DOP853", t, rtol=1e-12, atol=small).y
    arm = half.last
    return np.asarray(half.start[4] + arm[1] - y[4] - np.sin(y[5]) * arm[0] - np.cos(y[5]) * arm[1])


def _joined(inner: Array, outer: Array, ks: range) -> tuple[float, Array, float]:
    """Mass for unit density, centroid (2,) and moment of inertia about it, of some voussoirs."""
    parts = [_triangle(*corners) for k in ks for corners in (
        (inner[k], outer[k], outer[k + 1]), (inner[k], outer[k + 1], inner[k + 1]))]  # fmt: skip
    mass = sum(area for area, _, _ in parts)
    middle = np.asarray(sum(area * at for area, at, _ in parts) / mass)
    return (
        mass,
        middle,
        sum(j + area * float((at - middle) @ (at - middle)) for area, at, j in parts),
    )


def _triangle(a: Array, b: Array, c: Array) -> tuple[float, Array, float]:
    area = 0.5 * abs(float(np.linalg.det(np.stack([b - a, c - a]))))
    sides = sum(float(side @ side) for side in (b - a, c - b, a - c))
    return area, (a + b + c) / 3.0, area * sides / 36.0


def _turned(arm: Array, angle: float) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]])

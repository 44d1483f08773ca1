"""Second route to the unit of four bonded elements of Liu et al. (2017): rates in space.

No symmetry is assumed. The four elements have twelve coordinates; each bond has a stretch and a
shear displacement in space that rotates with it. Along a path of equilibria the rates of all forces
on free coordinates vanish, which is a linear system for the velocities, and the path is integrated
from zero. The springs depend on the path, so that there is no energy to minimise. The force of a
bond that opens is multiplied by a factor that decreases to 0. Lengths are in diameters, forces in
kn d. The integrated variable is displacement over strain, so that small strains lose no digits.
With springs that do not depend on the path, equilibria are roots of the forces.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

RTOL = 3e-14  # the least that solve_ivp accepts is 2.2e-14
START = np.array(
    [
        [0.0, 0.0, np.sqrt(2.0 / 3.0)],
        [1.0 / np.sqrt(3.0), 0.0, 0.0],
        [-0.5 / np.sqrt(3.0), 0.5, 0.0],
        [-0.5 / np.sqrt(3.0), -0.5, 0.0],
    ]
)
BONDS = np.array([[1, 0], [2, 0], [3, 0], [1, 2], [2, 3], [3, 1]])
HELD = np.array([2, 5, 8, 11])  # the z coordinates of all elements; x and y are free
FREE = np.setdiff1d(np.arange(12), HELD)
OFFSET = START[BONDS[:, 1]] - START[BONDS[:, 0]]


@dataclass(frozen=True)
class Unit:
    """Displacements u (4, 3), shear s (6, 3) of bonds; base: the factor on forces of base bonds."""

    u: Array
    s: Array
    base: float = 1.0

    def geometry(self) -> tuple[Array, Array, Array]:
        """The length, stretch and direction of the bonds."""
        moved = self.u[BONDS[:, 1]] - self.u[BONDS[:, 0]]
        now = OFFSET + moved
        length = np.sqrt((now**2).sum(axis=1))
        stretch = (moved * (2.0 * OFFSET + moved)).sum(axis=1) / (length + 1.0)
        return length, stretch, now / length[:, None]

    def pulls(self, gamma: float) -> Array:
        """The force (6, 3) that the springs of each whole bond exert on its first element."""
        _, stretch, n = self.geometry()
        pull: Array = stretch[:, None] * n + gamma * self.s
        return pull

    def forces(self, gamma: float) -> Array:
        """The sum of forces (4, 3) on the elements."""
        pull = self.pulls(gamma) * self.kept[:, None]
        summed = np.zeros((4, 3))
        np.add.at(summed, BONDS[:, 0], pull)
        np.add.at(summed, BONDS[:, 1], -pull)
        return summed

    @property
    def kept(self) -> Array:
        """The factor (6,) on the force of each bond, below 1 as base bonds open."""
        return np.where(np.arange(6) < 3, 1.0, self.base)


def equilibrium(strain: float, gamma: float) -> dict[str, float]:
    """The measured quantities (`_measured`) of the unit at an axial strain."""
    return _measured(_strained(NEW, strain, gamma), gamma)


def equilibrium_total(strain: float, gamma: float) -> dict[str, float]:
    """The same with springs of the total displacement across the present direction of the bond."""
    from scipy.optimize import root

    def unit(x: Array) -> Unit:
        u = np.zeros(12)
        u[2], u[FREE] = strain * START[0, 2], strain * x
        moved = u.reshape(4, 3)[BONDS[:, 1]] - u.reshape(4, 3)[BONDS[:, 0]]
        n = Unit(u.reshape(4, 3), moved).geometry()[2]
        return Unit(u.reshape(4, 3), moved - n * (n * moved).sum(axis=1)[:, None])

    def unbalanced(x: Array) -> Array:
        forces: Array = unit(x).forces(gamma).ravel()[FREE] / strain
        return forces

    found = root(unbalanced, np.zeros(8), method="lm", options={"xtol": 1e-15, "ftol": 1e-15})
    return _measured(unit(found.x), gamma)


def failure(kind: str, gamma: float, xb: float, fs0: float, mu_p: float) -> dict[str, float]:
    """The state at which bonds fail by 'tension', 'opening' or 'sliding'; xb in d, fs0 in kn d."""
    from scipy.optimize import brentq

    def first(begin: Unit, margin: Callable[[Unit], float], near: float, far: float) -> Unit:
        end = brentq(
            lambda e: margin(_strained(begin, e, gamma)), near, far, xtol=1e-18, rtol=1e-14
        )
        return _strained(begin, end, gamma)

    if kind == "tension":
        unit = first(NEW, lambda unit: unit.geometry()[1][0] - xb, 0.1 * xb, 5 * xb)
        return _measured(unit, gamma)
    unit = first(NEW, lambda unit: unit.geometry()[1][3] - xb, -xb, -30 * xb)
    if kind == "sliding":

        def margin(unit: Unit) -> float:
            limit = fs0 - mu_p * unit.geometry()[1][0]
            return float(gamma * np.linalg.norm(unit.s[0]) - limit)

        unit = _let_go(unit, gamma)
        unit = first(unit, margin, _strain(unit), 5 * _strain(unit))
    return _measured(unit, gamma)


NEW = Unit(np.zeros((4, 3)), np.zeros((6, 3)))


def _measured(unit: Unit, gamma: float) -> dict[str, float]:
    """The strain, force on the top, stretches, shear, and the largest residual force."""
    total = unit.forces(gamma)
    _, stretch, _ = unit.geometry()
    return {
        "strain": _strain(unit),
        "fz": -float(total[0, 2]),
        "xn1": float(stretch[0]),
        "xs1": float(np.linalg.norm(unit.s[0])),
        "xn2": float(stretch[3]),
        "unbalanced": float(np.abs(total.ravel()[FREE]).max()),
    }


def _strain(unit: Unit) -> float:
    return float(unit.u[0, 2] / START[0, 2])


def _strained(begin: Unit, strain: float, gamma: float) -> Unit:
    """Follow the path of equilibria from a state to another axial strain."""
    more = strain - _strain(begin)
    return _followed(begin, more * START[0, 2], 0.0, gamma) if more else begin


def _let_go(begin: Unit, gamma: float) -> Unit:
    """Follow the path of equilibria at a fixed height while base bonds lose their force."""
    return replace(_followed(begin, 0.0, -1.0, gamma), base=0.0)


def _followed(begin: Unit, lift: float, loss: float, gamma: float) -> Unit:
    from scipy.integrate import solve_ivp

    size = abs(lift) or float(np.abs(begin.u).max())
    origin = np.concatenate([begin.u.ravel(), begin.s.ravel()])

    def unit(t: float, change: Array) -> Unit:
        now = origin + size * change
        return Unit(now[:12].reshape(4, 3), now[12:].reshape(6, 3), begin.base + loss * t)

    def rate(t: float, change: Array) -> Array:
        v, turned = _rates(unit(t, change), lift, loss, gamma)
        return np.concatenate([v.ravel(), turned.ravel()]) / size

    zeros = np.zeros(30)
    done = solve_ivp(rate, (0.0, 1.0), zeros, method="DOP853", rtol=RTOL, atol=1e-15)
    return unit(1.0, done.y[:, -1])


def _rates(unit: Unit, lift: float, loss: float, gamma: float) -> tuple[Array, Array]:
    """The velocities (4, 3) that maintain equilibrium, and the rates of shear (6, 3)."""
    length, stretch, n = unit.geometry()
    eye = np.eye(3)
    across = eye - n[:, :, None] * n[:, None, :]
    shear = across - n[:, :, None] * unit.s[:, None, :] / length[:, None, None]
    stiffness = (eye - across) + (stretch / length)[:, None, None] * across + gamma * shear
    stiffness *= unit.kept[:, None, None]
    whole = np.zeros((4, 3, 4, 3))
    pushed = np.zeros((4, 3))
    fading = loss * unit.pulls(gamma)
    for k, (i, j) in enumerate(BONDS):
        for a, b, sign in ((i, i, 1.0), (j, j, 1.0), (i, j, -1.0), (j, i, -1.0)):
            whole[a, :, b, :] += sign * stiffness[k]
        if k >= 3:
            pushed[i] += fading[k]
            pushed[j] -= fading[k]
    v = np.zeros(12)
    v[2] = lift
    matrix = whole.reshape(12, 12)
    right = pushed.ravel()[FREE] - matrix[np.ix_(FREE, HELD)] @ v[HELD]
    v[FREE] = np.linalg.lstsq(matrix[np.ix_(FREE, FREE)], right, rcond=1e-10)[0]
    w = v.reshape(4, 3)
    return w, np.einsum("kij,kj->ki", shear, w[BONDS[:, 1]] - w[BONDS[:, 0]])

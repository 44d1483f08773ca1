"""A box with uniform strain: on a smooth base under suddenly applied weight, or spinning freely.

The displacement is linear in x (Shi 1992). With sides s_i, volume V and mass m, normal strains e_i
follow m s_i^2/12 e_i'' + V sum_j C_ij e_j = F_i, with C from Hooke's law. On a base the centroid
moves by half the shortening, so that the inertia along z is m s_z^2/3 and F_z = -m g s_z/2. A box
that spins by w about z has F_i = m w^2 s_i^2/12 along x and y. From e = e' = 0 every mode
oscillates as 1 - cos. A free bar has w^2 = 12 E/(rho s^2), and a bar on a base 3 E/(rho s^2); the
first modes of the continuum have pi^2 and pi^2/4 in place of 12 and 3, and are slower by
sqrt(12)/pi = 1.103. Every function raises ValueError for parameters outside their ranges.
"""

from math import pi, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_finite, require_positive, require_times

Array = NDArray[np.float64]
Sides = tuple[float, float, float]
STIFFER = sqrt(12.0) / pi
"""The first frequency of a bar that strains uniformly over that of the continuum."""


def law(young: float, poisson: float, along: tuple[int, ...] = (0, 1, 2)) -> Array:
    """The stiffness [Pa] of normal strains along some axes; no stress acts along the others."""
    require_positive("Pa", young=young)
    if not -1.0 < poisson < 0.5:
        raise ValueError(f"poisson = {poisson}; it must lie between -1 and 0.5")
    compliance = ((1.0 + poisson) * np.eye(3) - poisson) / young
    return np.asarray(np.linalg.inv(compliance[np.ix_(along, along)]))


def resting(*, sides: Sides, rho: float, young: float, poisson: float, g: float) -> Array:
    """The strains (3,) at rest on a base under the mean stress, which is due to half the weight."""
    require_positive("in SI units", s_z=sides[2], rho=rho, young=young)
    require_finite("m/s2", g=g)
    axial = -rho * g * sides[2] / (2.0 * young)
    return np.array([-poisson * axial, -poisson * axial, axial])


def standing(
    t: ArrayLike, *, sides: Sides, rho: float, young: float, poisson: float, g: float,
    along: tuple[int, ...] = (0, 1, 2),
) -> Array:  # fmt: skip
    """Strains (k, 3) at times t (k,) [s] after weight is applied at t = 0; 0 if not in `along`."""
    swung, force = _weighed(sides, rho, g)
    kept = list(along)
    strains = np.zeros((len(require_times(t)), 3))
    strains[:, kept] = _swings(t, swung[kept], law(young, poisson, along), force[kept])
    return strains


def standing_modes(
    *, sides: Sides, rho: float, young: float, poisson: float, g: float
) -> tuple[Array, Array]:
    """Of a box under its weight, what `spun_modes` tells of one that spins."""
    return _sizes(*_weighed(sides, rho, g), law(young, poisson))


def spinning(
    t: ArrayLike, *, sides: Sides, rho: float, young: float, poisson: float, spin: float
) -> Array:
    """Strains (k, 3) along the axes of a box that spins about z by spin [1/s] from t = 0 on."""
    inertia, force = _flung(sides, rho, spin)
    return _swings(t, inertia, law(young, poisson), force)


def spun_modes(
    *, sides: Sides, rho: float, young: float, poisson: float, spin: float
) -> tuple[Array, Array]:
    """The mean (3, 3) of each strain of a spun box in each mode, by size; squared frequencies."""
    return _sizes(*_flung(sides, rho, spin), law(young, poisson))


def seen_from_rest(strains: Array, angle: Array) -> Array:
    """Normal strains (k, 3) along fixed axes of a box that has rotated by angle (k,) about z."""
    c, s = np.cos(angle) ** 2, np.sin(angle) ** 2
    x, y, z = strains.T
    return np.stack([c * x + s * y, s * x + c * y, z], axis=1)


def first(*, side: float, rho: float, young: float) -> float:
    """The first angular frequency w [1/s] of a bar on its base, without lateral stress."""
    require_positive("in SI units", side=side, rho=rho, young=young)
    return sqrt(3.0 * young / rho) / side


def _inertia(sides: Sides, rho: float) -> Array:
    """The inertia per volume of each strain of a free box, rho s^2/12 (3,) [kg/m]."""
    require_positive("in SI units", s_x=sides[0], s_y=sides[1], s_z=sides[2], rho=rho)
    return rho * np.square(sides) / 12.0


def _weighed(sides: Sides, rho: float, g: float) -> tuple[Array, Array]:
    """Inertia and force per volume (3,) of each strain of a box on a base under its weight."""
    require_finite("m/s2", g=g)
    return _inertia(sides, rho) * [1.0, 1.0, 4.0], np.array([0.0, 0.0, -rho * g * sides[2] / 2.0])


def _flung(sides: Sides, rho: float, spin: float) -> tuple[Array, Array]:
    """Inertia and force per volume (3,) of each strain of a free box that spins about z."""
    require_finite("1/s", spin=spin)
    inertia = _inertia(sides, rho)
    return inertia, spin**2 * inertia * [1.0, 1.0, 0.0]


def _sizes(inertia: Array, force: Array, stiffness: Array) -> tuple[Array, Array]:
    """The mean (3, 3) of each strain in each mode, by size; squared frequencies (3,) [1/s2]."""
    squares, shares = _modes(inertia, stiffness, force)
    return np.abs(shares), squares


def _swings(t: ArrayLike, inertia: Array, stiffness: Array, force: Array) -> Array:
    """The solution e (k, n) of inertia (n,) e'' + stiffness (n, n) e = force (n,) from rest."""
    squares, shares = _modes(inertia, stiffness, force)
    risen = 1.0 - np.cos(np.outer(require_times(t), np.sqrt(squares)))
    return np.asarray(risen @ shares.T)


def _modes(inertia: Array, stiffness: Array, force: Array) -> tuple[Array, Array]:
    """Squared frequencies (n,) [1/s2] of the modes, and the strains (n, n) at rest due to each."""
    root = np.sqrt(inertia)
    squares, modes = np.linalg.eigh(stiffness / np.outer(root, root))
    rest = modes.T @ (force / root) / squares
    return squares, modes * rest / root[:, None]

"""Modulus and strength of the infinite hexagonal close-packed lattice along any direction.

The cell has two elements of diameter d, which do not rotate; each has twelve bonds kn, ks [N/m].
The theory is of first order in the strain. A uniform strain e changes a bond r by e r. A bond
between the two kinds of elements changes also by their relative displacement, the shift, which
minimises the energy. The resulting stiffness C need not be that of an ordinary solid: shear springs
between elements that cannot rotate resist a rigid rotation of the lattice. Stress is therefore
that under a symmetric strain.

The axis of the unit is z, with the modulus of Eq. 6 of Liu et al. (2017).
"""

from math import sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.bonds.lattice_material import require_springs
from reference_solutions.parameters import require_positive

Array = NDArray[np.float64]
PAIR = sqrt(2.0)  # the volume of two elements, in cubes of d
PAIRS = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))


def compliance(kn: float, ks: float, d: float) -> Array:
    """The compliance (6, 6) [1/Pa] for strains e_xx, e_yy, e_zz, 2 e_yz, 2 e_xz, 2 e_xy."""
    energy = _energy(kn, ks, d)
    bound, mixed, own = energy[:6, :6], energy[:6, 6:], energy[6:, 6:]
    stiff = (bound - mixed @ np.linalg.solve(own, mixed.T)) / (PAIR * d**3)
    return np.asarray(np.linalg.inv(stiff))


def modulus(direction: ArrayLike, *, kn: float, ks: float, d: float) -> float:
    """Young's modulus [Pa] of a bar that is cut along a direction (3,), a vector of any length."""
    stress = _pull(direction)
    return float(1.0 / (stress @ compliance(kn, ks, d) @ stress))


def opening(direction: ArrayLike, *, kn: float, ks: float, xb: float, d: float) -> float:
    """The tension [Pa] along a direction (3,) at which a bond is first stretched by xb [m]."""
    require_positive("m", xb=xb)
    load = PAIR * d**3 * np.concatenate([_pull(direction), np.zeros(3)])
    answer = np.linalg.solve(_energy(kn, ks, d), load)  # six strains and the shift
    return float(xb / max(r @ _moves(r, joins, d) @ answer for r, joins in _bonds()))


def _pull(direction: ArrayLike) -> Array:
    """A unit stress along a direction, in the components conjugate to the six strains."""
    n = np.asarray(direction, dtype=np.float64)
    if not (np.isfinite(n).all() and n.any()):
        raise ValueError(f"direction = {n.tolist()}; it must be finite and not zero")
    n = n / np.linalg.norm(n)
    return np.array([n[i] * n[j] for i, j in PAIRS])


def _energy(kn: float, ks: float, d: float) -> Array:
    """Twice the energy [J] of a cell, a quadratic form (9, 9) of six strains and the shift [m]."""
    require_springs(kn, ks, d)
    found = np.zeros((9, 9))
    for r, joins in _bonds():
        n = r / np.linalg.norm(r)
        spring = (kn - ks) * np.outer(n, n) + ks * np.eye(3)
        moved = _moves(r, joins, d)
        found += moved.T @ spring @ moved
    return found


def _moves(r: Array, joins: float, d: float) -> Array:
    """The change (3, 9) of a bond by six strains and the shift [m]."""
    return np.hstack([d * _strained(r), joins * np.eye(3)])


def _bonds() -> list[tuple[Array, float]]:
    """Each bond of a cell once, in diameters, with 1 if it joins elements of both kinds, else 0."""
    in_plane = [np.array([np.cos(a), np.sin(a), 0.0]) for a in np.pi / 3 * np.arange(3)]
    across = [
        np.array([np.sin(a) / sqrt(3.0), np.cos(a) / sqrt(3.0), side * sqrt(2.0 / 3.0)])
        for a in 2 * np.pi / 3 * np.arange(3) for side in (1.0, -1.0)
    ]  # fmt: skip
    return [(r, 0.0) for r in in_plane * 2] + [(r, 1.0) for r in across]


def _strained(r: Array) -> Array:
    """The change (3, 6) of a bond by the six strains."""
    made = np.zeros((3, 6))
    for column, (i, j) in enumerate(PAIRS):
        made[i, column] += r[j] / 2.0
        made[j, column] += r[i] / 2.0
    return made

"""Modulus and strength of the infinite hexagonal close-packed lattice along any direction.

Two elements of diameter d repeat; each has twelve bonds kn, ks [N/m] to first order in the strain,
no element turns. A uniform strain e moves a bond r by e r, and by the shift of the second kind of
elements against the first where it joins the two: the shift takes the least energy. What that
leaves is a stiffness C, which need not be that of an ordinary solid: shear springs that hold
elements from turning resist a rigid rotation. So stress is that under a symmetric strain.

The unit's own axis is z, with the modulus of Eq. 6 of Liu et al. (2017).
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
    """S (6, 6) [1/Pa] for strains e_xx, e_yy, e_zz, 2 e_yz, 2 e_xz, 2 e_xy."""
    energy = _energy(kn, ks, d)
    bound, mixed, own = energy[:6, :6], energy[:6, 6:], energy[6:, 6:]
    stiff = (bound - mixed @ np.linalg.solve(own, mixed.T)) / (PAIR * d**3)
    return np.asarray(np.linalg.inv(stiff))


def modulus(direction: ArrayLike, *, kn: float, ks: float, d: float) -> float:
    """E [Pa] along a direction (3,) of any length, as of a bar cut along it."""
    stress = _pull(direction)
    return float(1.0 / (stress @ compliance(kn, ks, d) @ stress))


def opening(direction: ArrayLike, *, kn: float, ks: float, xb: float, d: float) -> float:
    """The tension [Pa] along a direction (3,) at which the first bond is longer by xb [m]."""
    require_positive("m", xb=xb)
    load = PAIR * d**3 * np.concatenate([_pull(direction), np.zeros(3)])
    answer = np.linalg.solve(_energy(kn, ks, d), load)  # six strains and the shift
    return float(xb / max(r @ _moves(r, joins, d) @ answer for r, joins in _bonds()))


def _pull(direction: ArrayLike) -> Array:
    """A unit stress along a direction, in the components that belong to the six strains."""
    n = np.asarray(direction, dtype=np.float64)
    if not (np.isfinite(n).all() and n.any()):
        raise ValueError(f"direction = {n.tolist()}; it must be finite and not zero")
    n = n / np.linalg.norm(n)
    return np.array([n[i] * n[j] for i, j in PAIRS])


def _energy(kn: float, ks: float, d: float) -> Array:
    """Twice the energy [J] of two elements, a form (9, 9) of six strains and the shift [m]."""
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
    """Half of the bonds of the two elements, in diameters, and whether each joins both kinds."""
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

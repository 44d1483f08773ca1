"""Second route to a strained hexagonal close-packed lattice, in a periodic box.

The box has four elements. Their bonds are found from distances among the periodic images, and the
displacements of all four minimise the energy.
"""

from itertools import product
from math import sqrt

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
BOX = np.array([1.0, sqrt(3.0), sqrt(8.0 / 3.0)])
STRAINS = [
    (np.outer(a, b) + np.outer(b, a)) / 2.0 for i, a in enumerate(np.eye(3)) for b in np.eye(3)[i:]
]
PLACES = BOX * np.array([[0, 0, 0], [0.5, 0.5, 0], [0.5, 1 / 6, 0.5], [0, 2 / 3, 0.5]])


def energy(strain: Array, *, kn: float, ks: float, d: float) -> float:
    """The energy density [J/m3] under a symmetric strain (3, 3), to second order."""
    stretch, weight = _relaxed(strain, kn, ks)
    force = d * weight * stretch
    return float(0.25 * (force @ force) / (BOX.prod() * d**3))  # each bond is counted twice


def opening(direction: Array, *, kn: float, ks: float, xb: float, d: float) -> float:
    """The tension [Pa] along a unit vector (3,) at which a bond is first stretched by xb [m].

    The strain under this tension follows from the stiffness, which is obtained from the energies of
    single strains and of sums of two.
    """
    springs = {"kn": kn, "ks": ks, "d": d}
    alone = [energy(one, **springs) for one in STRAINS]
    stiff = [
        [energy(one + other, **springs) - a - b for other, b in zip(STRAINS, alone, strict=True)]
        for one, a in zip(STRAINS, alone, strict=True)
    ]
    strains = np.linalg.solve(stiff, [direction @ one @ direction for one in STRAINS])
    stretch, _ = _relaxed(np.einsum("s,sij->ij", strains, np.array(STRAINS)), kn, ks)
    return float(xb / (d * stretch[::3].max()))


def _relaxed(strain: Array, kn: float, ks: float) -> tuple[Array, Array]:
    """The elongation and two slips of each bond [diameters], and the roots of the stiffnesses."""
    rows, right, weight = [], [], []
    for i, j in product(range(4), repeat=2):
        for image in product((-1, 0, 1), repeat=3):
            r = PLACES[j] + BOX * image - PLACES[i]
            length = np.linalg.norm(r)
            if not 0.9 < length < 1.1:
                continue
            basis = np.array([r / length, *np.linalg.svd(r[None])[2][1:]])  # along, then across
            for axis, k in zip(basis, (kn, ks, ks), strict=True):
                row = np.zeros(12)
                row[3 * j : 3 * j + 3] += axis
                row[3 * i : 3 * i + 3] -= axis
                rows.append(row)
                right.append(axis @ strain @ r)
                weight.append(sqrt(k))
    matrix, moved, root = np.array(rows), np.array(right), np.array(weight)
    shift = np.linalg.lstsq(root[:, None] * matrix, -root * moved)[0]
    return moved + matrix @ shift, root

"""Close-packed blocks between smooth platens at finite strain without failure (Liu 2017, Fig. 4).

The strain grows in small increments. In each, elements move until all forces are in equilibrium: a
bond of length L along n has the normal force kn (L - d) n and a shear force S. S rotates with the
bond and grows by ks times the displacement across it, resolved at the middle of the increment (the
incremental spring of Cundall and Strack 1979). Equilibria are found by corrections with the initial
stiffness, each of which reduces the error to a hundredth at strains of a thousandth. The error of
the increments is of second order.
"""

import numpy as np
from numpy.typing import NDArray

from reference_solutions.bonds.close_packed_lattice import (
    Lattice,
    _stiffness,
    narrowing,
)
from reference_solutions.bonds.lattice_material import poissons_ratio, require_springs

Array = NDArray[np.float64]
LEFT = 3e-9  # largest residual force in equilibrium, over the largest reaction


def path(block: Lattice, kn: float, ks: float, strains: Array, parts: int) -> Array:
    """The stress [Pa] on the area of the hull and the lateral strains along x and y, (k, 3).

    The axial strains (k,) have one sign and grow in magnitude from zero; each is reached in `parts`
    increments. Raises ValueError for other strains, or if no equilibrium is found.
    """
    require_springs(kn, ks, 1.0)
    size = np.abs(strains)
    if not ((np.diff(size, prepend=0.0) > 0).all() and len(set(np.sign(strains))) == 1):
        raise ValueError(f"strains = {strains.tolist()}; they must grow in size, with one sign")
    matrix = _stiffness(block, kn, ks)
    ends = block.at(2, 0) | block.at(2, 1)
    free = np.ones_like(block.position, bool)
    free[:, 2] = ~ends
    nu = poissons_ratio(kn, ks)
    u, shear = np.zeros_like(block.position), np.zeros((len(block.bonds), 3))
    found, before = [], 0.0
    for strain in strains:
        for _ in range(parts):
            more = (strain - before) / parts
            guess = u + more * block.position * [-nu, -nu, 1.0]
            u, shear, force = _balanced(block, matrix, free, u, guess, shear, kn, ks)
        before = strain
        stress = force[block.at(2, 1), 2].sum() / block.area
        across = [-narrowing(block, u, axis) for axis in (0, 1)]
        found.append([stress, *across])
    return np.array(found)


def _balanced(  # type: ignore[no-untyped-def]
    block: Lattice, matrix, free: NDArray[np.bool_], before: Array, u: Array, shear: Array,
    kn: float, ks: float,
) -> tuple[Array, Array, Array]:  # fmt: skip
    """Displacements, shear forces of bonds and forces on the elements after an increment."""
    for _ in range(30):
        force, turned = _forces(block, before, u, shear, kn, ks)
        size = np.abs(force[~free]).max()
        if np.abs(force[free]).max() <= LEFT * size:
            return u, turned, force
        u = u - _answer(matrix, force, free)
    raise ValueError("no balance after 30 corrections; the strain is too large")


def _forces(
    block: Lattice, before: Array, u: Array, shear: Array, kn: float, ks: float
) -> tuple[Array, Array]:
    """The forces (N, 3) [N] that would hold the elements, and shear forces (B, 3) [N] of bonds.

    before, u: displacements (N, 3) [m] before and after an increment. Elongations are found from
    them, since a difference of positions would lose small strains.
    """
    i, j = block.bonds.T
    apart = block.position[j] - block.position[i]
    drawn, moved = u[j] - u[i], u[j] - u[i] - (before[j] - before[i])
    old, new = apart + (before[j] - before[i]), apart + drawn
    length = np.linalg.norm(new, axis=1)[:, None]
    n, was = new / length, old / np.linalg.norm(old, axis=1)[:, None]
    middle = (old + new) / np.linalg.norm(old + new, axis=1)[:, None]
    across = moved - (moved * middle).sum(axis=1)[:, None] * middle
    axis = np.cross(was, n)  # rotation vector of the bond, to first order in an increment
    turned = shear + np.cross(axis, shear) + np.cross(axis, np.cross(axis, shear)) / 2.0
    turned = turned + ks * across
    turned = turned - (turned * n).sum(axis=1)[:, None] * n
    d = np.linalg.norm(apart, axis=1)[:, None]
    longer = (drawn * (apart + new)).sum(axis=1)[:, None] / (length + d)
    pull = kn * longer * n + turned
    force = np.zeros_like(u)
    np.add.at(force, i, -pull)
    np.add.at(force, j, pull)
    return force, turned


def _answer(matrix, force: Array, free: NDArray[np.bool_]) -> Array:  # type: ignore[no-untyped-def]
    """The correction (N, 3) [m] of positions, linear in the forces on free coordinates."""
    from scipy.sparse import diags_array
    from scipy.sparse.linalg import cg

    chosen = np.flatnonzero(free)
    inner = matrix[chosen][:, chosen]
    change, failed = cg(
        inner, force.ravel()[chosen], rtol=1e-6, maxiter=5000, M=diags_array(1.0 / inner.diagonal())
    )
    if failed:
        raise ValueError("no balance after 5000 iterations; the bonds do not hold the block")
    back = np.zeros(force.size)
    back[chosen] = change
    return back.reshape(-1, 3)

"""Blocks of close-packed elements that may rotate, between smooth platens, solved statically.

The blocks are those of `close_packed_lattice`, but each shear spring joins the points of two
elements that touched, as in Cundall and Strack (1979). An element that rotates by w takes its point
at (d/2) n with it, and the spring resists the slip u_j - u_i - (d/2) (w_i + w_j) x n. Liu et al.
(2017) omit rotation. Rotation unloads the shear springs, most of all at the faces of a block. In a
single unit on its base they are free of force: its E and nu are those of Eqs. 4 and 6 without shear
springs.
"""

import numpy as np
from numpy.typing import NDArray

from reference_solutions.bonds.close_packed_lattice import Lattice, Static, narrowing, relaxed
from reference_solutions.bonds.lattice_material import poissons_ratio, require_springs
from reference_solutions.parameters import require_positive

Array = NDArray[np.float64]


def static(block: Lattice, kn: float, ks: float) -> Static:
    """The linear response of a block to an axial strain with all elements free to rotate.

    Raises ValueError unless ks > 0, since only shear springs resist rotation.
    """
    require_springs(kn, ks, 1.0)
    require_positive("N/m", ks=ks)
    matrix = _stiffness(block, kn, ks)
    free = np.ones((2 * len(block.position), 3), bool)
    ends = block.at(2, 0) | block.at(2, 1)
    free[: len(ends), 2] = ~ends
    widths = np.array([-poissons_ratio(kn, ks)] * 2 + [1.0])
    start = np.concatenate([block.position * widths, 0.0 * block.position])
    moved = relaxed(matrix, start, free)
    u = moved[: len(ends)]
    force = (matrix @ moved.ravel()).reshape(-1, 3)[: len(ends)][block.at(2, 1), 2].sum()
    nu_x, nu_y = (narrowing(block, u, axis) for axis in (0, 1))
    return Static(float(force / block.area), (nu_x + nu_y) / 2.0, nu_x, nu_y, u)


def _stiffness(block: Lattice, kn: float, ks: float):  # type: ignore[no-untyped-def]  # scipy's
    """The sparse stiffness matrix (6N, 6N) for all displacements, then all rotations."""
    from scipy.sparse import csr_array

    i, j = block.bonds.T
    N, B = len(block.position), len(i)
    offset = block.position[j] - block.position[i]
    d = np.linalg.norm(offset, axis=1)[:, None, None]
    n = offset / d[:, :, 0]
    lever = np.cross(n[:, None, :], np.eye(3)).swapaxes(1, 2) * d / 2.0  # times w: (d/2) n x w
    one = np.broadcast_to(np.eye(3), (B, 3, 3))
    parts = np.stack([-one, one, lever, lever], axis=2)  # (B, 3, 4, 3)
    ends = np.stack([i, j, N + i, N + j], axis=1)
    columns = np.broadcast_to(3 * ends[:, None, :, None] + np.arange(3), parts.shape)
    rows = np.broadcast_to(np.arange(3 * B).reshape(B, 3, 1, 1), parts.shape)
    slip = csr_array((parts.ravel(), (rows.ravel(), columns.ravel())), shape=(3 * B, 6 * N))
    blocks = (kn - ks) * n[:, :, None] * n[:, None, :] + ks * np.eye(3)
    across = np.broadcast_to(np.arange(3 * B).reshape(B, 1, 3), blocks.shape)
    down = np.broadcast_to(np.arange(3 * B).reshape(B, 3, 1), blocks.shape)
    spring = csr_array((blocks.ravel(), (down.ravel(), across.ravel())), shape=(3 * B, 3 * B))
    return (slip.T @ spring @ slip).tocsr()

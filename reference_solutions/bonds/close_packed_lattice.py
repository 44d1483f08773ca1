"""Blocks of close-packed bonded elements between smooth platens, solved statically (Liu 2017).

Layers of elements of diameter d [m] are stacked along z as ABAB, which is hexagonal close packing.
An A layer has 2p + 1 rows along x of n, n - 1, ..., n elements, a B layer 2p rows; there are 2q + 1
layers, the first and the last of kind A, and N = (q + 1)((p + 1) n + p (n - 1)) + q p (2n - 1).
Touching elements are bonded by springs kn, ks [N/m] and do not rotate.

The platens prescribe z of the first and last layers and nothing else. To first order in the strain
the block is a linear system. Its only displacements without force are translations along the
platens, which conjugate gradients do not add to an initial state without them. Stress refers to the
area of the hull of the centres, (n - 1) d x p sqrt3 d. The modulus depends on that choice: an
infinite lattice has that of Eq. 6 exactly, a finite one lacks bonds at its faces and has excess
area.
"""

from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from reference_solutions.bonds.lattice_material import poissons_ratio, require_springs

Array = NDArray[np.float64]
Pairs = NDArray[np.int64]

SIZES = {
    82: (4, 2, 2),
    255: (6, 3, 3),
    580: (8, 4, 4),
    1105: (10, 5, 5),
    2166: (12, 6, 7),
    5461: (16, 9, 9),
    10985: (20, 11, 12),
    18079: (24, 13, 14),
    37681: (30, 17, 18),
}
"""N: (n, p, q) of the blocks of the paper (section 5.1)."""

RESIDUAL = 1e-12  # over the initial forces; E and nu are then accurate to 1e-11


class Lattice(NamedTuple):
    """A block: centres (N, 3) [m] and bonded pairs (B, 2); area [m2] and height [m] of its hull.

    rough [m]: the depth within which elements belong to a face, where faces are not layers.
    """

    position: Array
    bonds: Pairs
    area: float
    height: float
    rough: float = 0.0

    def at(self, axis: int, side: int) -> NDArray[np.bool_]:
        """Whether each element (N,) lies on the lower (side 0) or upper (1) face of an axis."""
        x = self.position[:, axis]
        edge = x.max() if side else x.min()
        extreme: NDArray[np.bool_] = np.abs(x - edge) < self.rough + 1e-6 * self.height
        return extreme


class Static(NamedTuple):
    """E [Pa], nu with its values along x and y, and displacements u (N, 3) [m] at the strain 1."""

    E: float
    nu: float
    nu_x: float
    nu_y: float
    u: Array


def count(n: int, p: int, q: int) -> int:
    """N, the number of elements of a block."""
    return (q + 1) * ((p + 1) * n + p * (n - 1)) + q * p * (2 * n - 1)


def lattice(n: int, p: int, q: int, d: float) -> Lattice:
    """The block of elements of diameter d; raises ValueError unless n >= 2, p >= 1, q >= 1, d > 0.

    Elements are ordered by layer, row and column.
    """
    if not (n >= 2 and p >= 1 and q >= 1 and d > 0):
        raise ValueError(f"n, p, q, d = {n}, {p}, {q}, {d}; they must be at least 2, 1, 1, above 0")
    layers = [_layer(n, p, kind=k % 2) for k in range(2 * q + 1)]
    rise = d * sqrt(2.0 / 3.0)
    position = np.concatenate(
        [np.column_stack([d * xy, np.full(len(xy), k * rise)]) for k, xy in enumerate(layers)]
    )
    area = (n - 1) * d * p * sqrt(3.0) * d
    layer = np.repeat(np.arange(len(layers)), [len(xy) for xy in layers])
    return Lattice(position, _touching(position, layer, d), area, 2 * q * rise)


def cut(sides: tuple[float, float, float], angle: float, d: float) -> Lattice:
    """A box of sides [m] cut from a crystal whose c axis is inclined from z to x by an angle [rad].

    The block consists of the elements whose centres lie in the box; those within half a diameter
    of the outermost form a face. Stress refers to the hull of the centres projected along z. Raises
    ValueError for sides of less than four diameters.
    """
    if not min(sides) >= 4.0 * d > 0.0:
        raise ValueError(f"sides = {sides} m, d = {d} m; sides must be at least 4 d, d above 0")
    from scipy.spatial import ConvexHull

    half, c, s = np.array(sides) / 2.0, np.cos(angle), np.sin(angle)
    x = d * _crystal(float(np.linalg.norm(half)) / d)
    x = x @ np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
    x = x[(np.abs(x) <= half * (1.0 + 1e-9)).all(axis=1)]
    x = x[np.lexsort(np.round(x / d, 6).T)]
    x -= [0.0, 0.0, x[:, 2].min()]
    area = float(ConvexHull(x[:, :2]).volume)  # the "volume" of a plane hull is its area
    return Lattice(x, _near(x, d), area, float(np.ptp(x[:, 2])), d / 2.0)


def _crystal(reach: float) -> Array:
    """All centres (n, 3) [diameters] within `reach` of one of them, and some farther ones."""
    many = np.arange(-int(1.2 * reach) - 2, int(1.2 * reach) + 3)
    i, row, layer = (axis.ravel() for axis in np.meshgrid(many, many, many, indexing="ij"))
    kind = layer % 2
    x = i + (row % 2) / 2.0 + kind / 2.0
    return np.stack([x, row * sqrt(3.0) / 2.0 + kind / sqrt(12.0), layer * sqrt(2.0 / 3.0)], axis=1)


def static(block: Lattice, kn: float, ks: float) -> Static:
    """The linear response of a block to an axial strain between smooth platens.

    nu is the mean of nu_x and nu_y. Each is the negative lateral strain over the axial strain, the
    lateral strain being that between the mean displacements of the outermost rows.
    """
    require_springs(kn, ks, 1.0)
    matrix = _stiffness(block, kn, ks)
    free = np.ones_like(block.position, bool)
    free[:, 2] = ~(block.at(2, 0) | block.at(2, 1))
    start = block.position * np.array([-poissons_ratio(kn, ks)] * 2 + [1.0])
    u = relaxed(matrix, start, free)
    force = (matrix @ u.ravel()).reshape(-1, 3)[block.at(2, 1), 2].sum()
    nu_x, nu_y = (narrowing(block, u, axis) for axis in (0, 1))
    return Static(float(force / block.area), (nu_x + nu_y) / 2.0, nu_x, nu_y, u)


def _layer(n: int, p: int, kind: int) -> Array:
    """(x, y) [diameters] of a layer; rows of kind B lie above the gaps between rows of kind A."""
    rows = []
    for row in range(2 * p + 1 - kind):
        short = (row + kind) % 2
        x = np.arange(n - short) + short / 2.0
        y = np.full(n - short, row * sqrt(3.0) / 2.0 + kind / sqrt(12.0))
        rows.append(np.column_stack([x, y]))
    return np.concatenate(rows)


def _touching(position: Array, layer: Pairs, d: float) -> Pairs:
    """The pairs (B, 2) of elements at the distance d, sorted, the lower number first.

    layer: (N,) the layer of each element, ascending. Only elements of the same layer or of
    successive layers touch.
    """
    found = []
    for k in range(layer[-1] + 1):
        first, last = np.searchsorted(layer, (k, k + 2))
        here, near = position[first : first + int((layer == k).sum())], position[first:last]
        gaps = np.linalg.norm(near - here[:, None], axis=2)
        i, j = np.nonzero(gaps < 1.1 * d)
        found.append(np.column_stack([i, j])[i < j] + first)
    return np.concatenate(found)


def _near(position: Array, d: float) -> Pairs:
    """The pairs (B, 2) of elements at the distance d, sorted, the lower number first."""
    from scipy.spatial import cKDTree

    pairs = cKDTree(position).query_pairs(1.1 * d, output_type="ndarray")
    return np.asarray(pairs[np.lexsort(pairs.T[::-1])], np.int64)


def _stiffness(block: Lattice, kn: float, ks: float):  # type: ignore[no-untyped-def]  # scipy's
    """The sparse stiffness matrix (3N, 3N) of the bonds: kn along each and ks across it."""
    from scipy.sparse import bsr_array, csr_array

    i, j = block.bonds.T
    offset = block.position[j] - block.position[i]
    n = offset / np.linalg.norm(offset, axis=1)[:, None]
    spring = (kn - ks) * n[:, :, None] * n[:, None, :] + ks * np.eye(3)
    rows, columns = np.concatenate([i, j, i, j]), np.concatenate([i, j, j, i])
    order = np.lexsort((columns, rows))
    starts = np.searchsorted(rows[order], np.arange(len(block.position) + 1))
    size = 3 * len(block.position)
    blocks = np.concatenate([spring, spring, -spring, -spring])[order]
    matrix = csr_array(bsr_array((blocks, columns[order], starts), shape=(size, size)))
    matrix.sum_duplicates()
    return matrix


def relaxed(matrix, start: Array, free: NDArray[np.bool_]) -> Array:  # type: ignore[no-untyped-def]
    """Displacements: in equilibrium at the free coordinates, those of `start` at the others."""
    from scipy.sparse import diags_array
    from scipy.sparse.linalg import cg

    chosen = np.flatnonzero(free)
    u = start.ravel().copy()
    pull = -(matrix @ u)[chosen]
    inner = matrix[chosen][:, chosen]
    change, failed = cg(
        inner, pull, rtol=RESIDUAL, maxiter=5000, M=diags_array(1.0 / inner.diagonal())
    )
    if failed:
        raise ValueError("no balance after 5000 iterations; the bonds do not hold the block")
    u[chosen] += change
    relaxed: Array = u.reshape(-1, 3)
    return relaxed


def narrowing(block: Lattice, u: Array, axis: int) -> float:
    low, high = block.at(axis, 0), block.at(axis, 1)
    width = np.ptp(block.position[:, axis])
    return float((u[low, axis].mean() - u[high, axis].mean()) / width)

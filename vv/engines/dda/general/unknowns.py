"""The unknowns of a DDA block: displacement fields, stiffness, and rates at t = 0."""

from __future__ import annotations

import numpy as np

from vv.scene import Block, Elastic, Vector, volume_and_centroid

ORDER = tuple((i, j) for i in range(3) for j in range(i, 3))


def unknowns_of(block: Block, axes: Vector) -> tuple[Vector, Vector, Vector]:
    """The unknowns of a block: lines (q, 3), slopes (q, 3, 3) and stiffness (q, q) [N m].

    Translations, rotations and, if it is elastic, strains come in this order.
    """
    fields = [(axis, np.zeros((3, 3))) for axis in axes[block.free]]
    fields += [(np.zeros(3), np.cross(np.eye(3), axis)) for axis in axes[block.free_spin]]
    rigid = len(fields)
    for i, j in block.strains:
        pair = np.outer(axes[i], axes[j])
        fields.append((np.zeros(3), pair if i == j else 0.5 * (pair + pair.T)))
    stiffness = np.zeros((len(fields), len(fields)))
    if block.elastic:
        volume, _ = volume_and_centroid(block.vertices, block.faces)
        stiffness[rigid:, rigid:] = volume * hooke(block.elastic, block.strains)
    line = np.array([field[0] for field in fields]).reshape(-1, 3)
    return line, np.array([field[1] for field in fields]).reshape(-1, 3, 3), stiffness


def hooke(elastic: Elastic, strains: tuple[tuple[int, int], ...]) -> Vector:
    """The stiffness [Pa] of strains (i, i) and shear angles (i, j), if others have zero stress."""
    E, nu = elastic.young, elastic.poisson
    compliance = np.zeros((6, 6))
    for a, (i, j) in enumerate(ORDER):
        for b, (k, m) in enumerate(ORDER):
            if i == j and k == m:
                compliance[a, b] = (1.0 if a == b else -nu) / E
        if i != j:
            compliance[a, a] = 2 * (1 + nu) / E
    kept = [ORDER.index(strain) for strain in strains]
    return np.asarray(np.linalg.inv(compliance[np.ix_(kept, kept)]))


def initial_rates(block: Block, axes: Vector) -> Vector:
    """The rates of the unknowns at t = 0 (q,); those of strains are zero."""
    moving, turning = (axes @ block.velocity)[block.free], (axes @ block.spin)[block.free_spin]
    return np.concatenate([moving, turning, np.zeros(len(block.strains))])

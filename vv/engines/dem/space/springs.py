"""The springs of a term, from which the largest stable step is computed."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.dem.rows import Index
from vv.scene import Mask, Vector

GROUND = np.iinfo(np.intp).max  # row of bodies at rest: after those of all spheres
TOUCHING = 1e-9  # gap over radius up to which a contact counts as closed at t = 0


class Springs(NamedTuple):
    """k springs: rows (k, 2) of their ends, normals (k, 3), kn, ks (k,) [N/m], arms (k, 2) [m]."""

    rows: Index
    n: Vector
    kn: Vector
    ks: Vector
    arms: Vector


def springs_of_contacts(
    rows: Index,
    offset: Vector,
    gap: Vector,
    radius: Vector,
    kn: float,
    ks: float,
) -> tuple[Springs, Mask]:
    """The springs of contacts, and which are closed; rows: (k, 2) of pairs, or (k,) with walls."""
    if rows.ndim == 1:
        rows, radius = np.stack([np.full_like(rows, GROUND), rows], axis=1), radius[:, None]
    n = offset / np.linalg.norm(offset, axis=1)[:, None]
    k = np.ones(len(rows))
    springs = Springs(rows, n, kn * k, ks * k, np.broadcast_to(radius, rows.shape))
    return springs, gap / radius.min(axis=1) <= TOUCHING

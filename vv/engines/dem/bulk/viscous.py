"""The viscous contacts of the bulk model: a list of those that are closed.

Their forces are computed by `vv.engines.dem.contact.dashpots`.
"""

from __future__ import annotations

import math

import numpy as np

from vv.engines.dem.bulk.grains import RADIUS, Grains, V, columns_of
from vv.engines.dem.bulk.near import Near
from vv.engines.dem.contact.dashpots import (
    RATE,
    SPRING,
    ViscousContacts,
    add_viscous_forces,
    apply_forces,
)
from vv.engines.dem.contact.linear import closing_factor
from vv.engines.dem.contact.pairs import normals_in_step
from vv.engines.dem.space.neighbours import DASHPOT_COLUMNS
from vv.engines.dem.terms.drag import Drag
from vv.engines.kernels.compiled import inlined, inlined_called, lent
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot, put
from vv.scene import Vector

Dashpot = tuple[float, float]
"""kn [N/m] and eta_n [N s/m]."""


@inlined_called
def contact_arrays(many: int) -> ViscousContacts:
    """Arrays for so many closed contacts."""
    return np.zeros((many, 2), np.intp), np.zeros((many, DASHPOT_COLUMNS))


@lent
def list_closed(
    grains: Grains,
    pairs: Near,
    edges: Near,
    walls: Vector,
    contacts: ViscousContacts,
    dashpot: Dashpot,
    dt: float,
) -> int:
    """List all contacts that are closed at the end of a step; return how many there are.

    In contacts with walls (w, 4) the wall is the first body, in the row of the ground.
    """
    row, used = grains.row, 0
    n = len(grains.mass)
    for i in range(n):
        for k in range(pairs.start[i], pairs.start[i + 1]):
            j = pairs.other[k]
            d, reach = add_scaled(at(row, j), -1.0, at(row, i)), row[i, RADIUS] + row[j, RADIUS]
            square = dot(d, d)
            if square < reach * reach:
                length, relative = (
                    math.sqrt(square),
                    add_scaled(columns_of(row, j, V), -1.0, columns_of(row, i, V)),
                )
                opened = normals_in_step(d, length, relative, dt)[2]
                normal = add_scaled(NOWHERE, 1.0 / length, d)
                store_contact(contacts, used, (i, j), normal, reach - length, opened, dashpot)
                used += 1
        for k in range(edges.start[i], edges.start[i + 1]):
            normal = at(walls, edges.other[k])
            overlap = row[i, RADIUS] - dot(at(row, i), normal) + walls[edges.other[k], 3]
            if overlap > 0.0:
                opened = dt * dot(normal, columns_of(row, i, V))
                store_contact(contacts, used, (n, i), normal, overlap, opened, dashpot)
                used += 1
    return used


@inlined
def store_contact(
    contacts: ViscousContacts,
    k: int,
    ends: tuple[int, int],
    normal: Triple,
    overlap: float,
    opened: float,
    dashpot: Dashpot,
) -> None:
    """Fill line k of the list; `closing_factor` applies if the contact closed in the step."""
    rows, kept = contacts
    share = closing_factor(overlap, -opened) if overlap + opened <= 0.0 else 1.0
    rows[k, 0], rows[k, 1] = ends
    put(kept, k, normal)
    kept[k, SPRING], kept[k, RATE] = dashpot[0] * overlap, share * dashpot[1]


@lent
def add_viscous(
    grains: Grains,
    contacts: ViscousContacts,
    used: int,
    new: Vector,
    dt: float,
    drag: Drag,
    lag: float,
) -> tuple[float, float]:
    """Add the viscous forces of the first `used` contacts to push; return their powers [W].

    The powers are those before and after the kick.
    """
    both = (contacts[0][:used], contacts[1][:used]), (contacts[0][:0], contacts[1][:0])
    v = grains.row[:, V : V + 3]
    return add_viscous_forces(both, grains.acting, v, new, grains.mass, None, dt, drag, lag)


@lent
def withdraw(grains: Grains, contacts: ViscousContacts, used: int) -> None:
    """Subtract the viscous forces again."""
    apply_forces((contacts[0][:used], contacts[1][:used]), grains.acting, -1.0)

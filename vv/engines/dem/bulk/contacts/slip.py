"""Contacts that slip: selected from all contacts of a batch, and computed together."""

from __future__ import annotations

import math

from vv.engines.dem.bonds.block_forces import store_vector, vector_of
from vv.engines.dem.bonds.blocks import WIDE
from vv.engines.dem.bulk.contacts.gather import (
    ACROSS,
    CAPS,
    FADING,
    HOW_LONG,
    INSIDE,
    MIDWAY,
    MORE,
    OLD,
    RADII,
    SLIDE,
    STIFF,
    TAKEN,
    TRIAL,
    TURNS,
    rounded_up,
    velocity_change,
)
from vv.engines.dem.bulk.grains import SPUN, Short, W, columns_of
from vv.engines.dem.contact.friction import slip_force_with, slip_number
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, cross, dot
from vv.scene import Vector


@inlined
def limit_friction(row: Vector, scratch: Vector, ends: Short, c: int, many: int) -> float:
    """Limit the tangential force of contacts that slip; return the dissipated energy [J].

    Their data are moved to the first columns of places that only slipping contacts need.
    """
    slipping, lost = 0, 0.0
    for q in range(many):
        trial, cap = vector_of(scratch, c, ACROSS, q), scratch[c, (CAPS + 1) * WIDE + q]
        ends[c, 3 * WIDE + slipping] = q
        slipping += dot(trial, trial) > cap * cap
    for s in range(slipping):
        q = ends[c, 3 * WIDE + s]
        store_vector(scratch, c, TRIAL, s, vector_of(scratch, c, ACROSS, q))
        store_vector(scratch, c, MORE, s, slide_change(row, scratch, ends, c, q))
        store_vector(scratch, c, OLD, s, vector_of(scratch, c, OLD, q))
        slide, ks = vector_of(scratch, c, SLIDE, q), scratch[c, STIFF * WIDE + q]
        caps = scratch[c, CAPS * WIDE + q], scratch[c, (CAPS + 1) * WIDE + q]
        store_vector(scratch, c, SLIDE, s, slide)
        scratch[c, STIFF * WIDE + s] = ks
        scratch[c, CAPS * WIDE + s], scratch[c, (CAPS + 1) * WIDE + s] = caps
        x = slip_number(slide, ks, caps)
        scratch[c, TURNS * WIDE + s], scratch[c, FADING * WIDE + s] = x, math.exp(-x)
    slip_forces(scratch, c, rounded_up(slipping))
    for s in range(slipping):
        store_vector(scratch, c, ACROSS, ends[c, 3 * WIDE + s], vector_of(scratch, c, TRIAL, s))
        lost += scratch[c, TAKEN * WIDE + s]
    return lost


@inlined
def slip_forces(scratch: Vector, c: int, slipping: int) -> None:
    """Replace the trial forces of slipping contacts, and compute the dissipated energy."""
    for s in range(slipping):
        force, taken = slip_force_with(
            vector_of(scratch, c, OLD, s),
            vector_of(scratch, c, TRIAL, s),
            vector_of(scratch, c, SLIDE, s),
            vector_of(scratch, c, MORE, s),
            scratch[c, STIFF * WIDE + s],
            (scratch[c, CAPS * WIDE + s], scratch[c, (CAPS + 1) * WIDE + s]),
            scratch[c, TURNS * WIDE + s],
            scratch[c, FADING * WIDE + s],
        )
        store_vector(scratch, c, TRIAL, s, force)
        scratch[c, TAKEN * WIDE + s] = taken


@inlined
def slide_change(row: Vector, scratch: Vector, ends: Short, c: int, q: int) -> Triple:
    """The change of the slide of a chosen pair since the last step [m]."""
    i, j = ends[c, q], ends[c, WIDE + q]
    m, inside = vector_of(scratch, c, MIDWAY, q), scratch[c, INSIDE * WIDE + q]
    spun = add_scaled(columns_of(row, i, W), -1.0, columns_of(row, i, SPUN))
    other = add_scaled(columns_of(row, j, W), -1.0, columns_of(row, j, SPUN))
    rolled = add_scaled(NOWHERE, scratch[c, RADII * WIDE + q] - inside, spun)
    rolled = add_scaled(rolled, scratch[c, (RADII + 1) * WIDE + q] - inside, other)
    more = add_scaled(velocity_change(row, i, j), -1.0, cross(rolled, m))
    more = add_scaled(more, -dot(m, more), m)
    return add_scaled(NOWHERE, scratch[c, HOW_LONG * WIDE + q], more)

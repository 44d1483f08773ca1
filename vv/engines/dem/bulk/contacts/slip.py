"""Contacts that slip: selected from all contacts of a batch, and computed together."""

from __future__ import annotations

import math

from vv.engines.dem.bonds.bend import note, three
from vv.engines.dem.bonds.blocks import WIDE
from vv.engines.dem.bulk.contacts.fetch import (
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
    changed,
    filled,
)
from vv.engines.dem.bulk.grains import SPUN, Short, W, part
from vv.engines.dem.contact.friction import slip_force_with, slip_number
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, cross, dot
from vv.scene import Vector


@inlined
def slip(row: Vector, scratch: Vector, ends: Short, c: int, many: int) -> float:
    """Limit the tangential force of contacts that slip; return the dissipated energy [J].

    Their data are moved to the first columns of places that only slipping contacts need.
    """
    slipping, lost = 0, 0.0
    for q in range(many):
        trial, cap = three(scratch, c, ACROSS, q), scratch[c, (CAPS + 1) * WIDE + q]
        ends[c, 3 * WIDE + slipping] = q
        slipping += dot(trial, trial) > cap * cap
    for s in range(slipping):
        q = ends[c, 3 * WIDE + s]
        note(scratch, c, TRIAL, s, three(scratch, c, ACROSS, q))
        note(scratch, c, MORE, s, slid_more(row, scratch, ends, c, q))
        note(scratch, c, OLD, s, three(scratch, c, OLD, q))
        slide, ks = three(scratch, c, SLIDE, q), scratch[c, STIFF * WIDE + q]
        caps = scratch[c, CAPS * WIDE + q], scratch[c, (CAPS + 1) * WIDE + q]
        note(scratch, c, SLIDE, s, slide)
        scratch[c, STIFF * WIDE + s] = ks
        scratch[c, CAPS * WIDE + s], scratch[c, (CAPS + 1) * WIDE + s] = caps
        x = slip_number(slide, ks, caps)
        scratch[c, TURNS * WIDE + s], scratch[c, FADING * WIDE + s] = x, math.exp(-x)
    turn_all(scratch, c, filled(slipping))
    for s in range(slipping):
        note(scratch, c, ACROSS, ends[c, 3 * WIDE + s], three(scratch, c, TRIAL, s))
        lost += scratch[c, TAKEN * WIDE + s]
    return lost


@inlined
def turn_all(scratch: Vector, c: int, slipping: int) -> None:
    """Replace the trial forces of slipping contacts, and compute the dissipated energy."""
    for s in range(slipping):
        force, taken = slip_force_with(
            three(scratch, c, OLD, s),
            three(scratch, c, TRIAL, s),
            three(scratch, c, SLIDE, s),
            three(scratch, c, MORE, s),
            scratch[c, STIFF * WIDE + s],
            (scratch[c, CAPS * WIDE + s], scratch[c, (CAPS + 1) * WIDE + s]),
            scratch[c, TURNS * WIDE + s],
            scratch[c, FADING * WIDE + s],
        )
        note(scratch, c, TRIAL, s, force)
        scratch[c, TAKEN * WIDE + s] = taken


@inlined
def slid_more(row: Vector, scratch: Vector, ends: Short, c: int, q: int) -> Triple:
    """The change of the slide of a chosen pair since the last step [m]."""
    i, j = ends[c, q], ends[c, WIDE + q]
    m, inside = three(scratch, c, MIDWAY, q), scratch[c, INSIDE * WIDE + q]
    spun = add_scaled(part(row, i, W), -1.0, part(row, i, SPUN))
    other = add_scaled(part(row, j, W), -1.0, part(row, j, SPUN))
    rolled = add_scaled(NOWHERE, scratch[c, RADII * WIDE + q] - inside, spun)
    rolled = add_scaled(rolled, scratch[c, (RADII + 1) * WIDE + q] - inside, other)
    more = add_scaled(changed(row, i, j), -1.0, cross(rolled, m))
    more = add_scaled(more, -dot(m, more), m)
    return add_scaled(NOWHERE, scratch[c, HOW_LONG * WIDE + q], more)

"""The compiled kernel for many free spheres and walls at rest: the leapfrog with all contacts."""

from __future__ import annotations

import math

import numpy as np

from vv.engines.dem.bulk.advance import (
    drift,
    kick,
    kinetic_energy_after,
    place,
    place_spins,
    set_weights,
)
from vv.engines.dem.bulk.batches import (
    AHEAD,
    BEHIND,
    KINETIC,
    LOST,
    NORMAL,
    SPRUNG,
    batches,
    farthest,
    total,
)
from vv.engines.dem.bulk.cells import cells
from vv.engines.dem.bulk.crowd import Crowd, Rules
from vv.engines.dem.bulk.grains import Given, initial_grains
from vv.engines.dem.bulk.near import near_pairs, near_walls, no_contacts
from vv.engines.dem.bulk.output import observe, write_energies
from vv.engines.dem.bulk.skin import FIRST, adapted, narrowest, widest
from vv.engines.dem.bulk.steps import add_all_forces, step_all
from vv.engines.dem.bulk.viscous import Dashpot, add_viscous, contact_arrays, list_closed, withdraw
from vv.engines.dem.contact.law import Law
from vv.engines.dem.limits import BLOW_UP, GAIN
from vv.engines.dem.rows import Index
from vv.engines.dem.terms.drag import Drag
from vv.engines.kernels.compiled import compiled
from vv.engines.kernels.triples import Triple
from vv.scene import Vector


@compiled
def move_in_bulk(  # noqa: PLR0915 - one loop, whose parts share all its variables
    path: Vector,
    energy: Vector,
    watched: Index,
    stride: int,
    dt: float,
    given: Given,
    walls: Vector,
    law: Law,
    friction: tuple[float, float] | None,
    dashpot: Dashpot | None,
    gravity: Triple,
    drag: Drag,
    threads: int | None,
    lag: float,
    back: float,
) -> int:
    """Integrate the motion of many spheres; the arguments are those of `move_in_space`.

    walls (w, 4): outward normals, and their distances from the origin [m]; friction: that of the
    law; dashpot: kn [N/m] and eta_n [N s/m]; threads: None for one core. Every `stride` steps a
    line is written of path (k, b, 6 or 9) and energy (k, 7). It is one function since all parts of
    a step share its variables.
    """
    bulk, spin, n, rubs = initial_grains(given), given.spin, len(given.mass), friction is not None
    viscous = None if dashpot is None else dashpot[1]
    rules = Rules(walls, law, friction, viscous, spin, dt, drag, lag, gravity)
    radius, reach = narrowest(bulk), 2.0 * widest(bulk)
    skin, sought, used = FIRST * radius, 0, 0
    sorted_cells = cells(bulk, reach + skin)
    pairs = near_pairs(bulk, sorted_cells, skin, no_contacts(n), rubs)
    edges = near_walls(bulk, walls, sorted_cells, skin, no_contacts(n), rubs)
    crowd = Crowd(bulk, pairs, edges, batches(pairs), rules)
    contacts, new = contact_arrays(0), np.zeros((n + 1, 3))
    set_weights(bulk, gravity)
    add_all_forces(crowd, True, threads)
    normal, sprung = total(crowd.work.sums, NORMAL), total(crowd.work.sums, SPRUNG)
    slowed = 0.0, 0.0
    if dashpot is not None:
        contacts = contact_arrays(len(pairs.other) + len(edges.other))
        used = list_closed(bulk, pairs, edges, walls, contacts, dashpot, dt)
        place(bulk, given.velocity, 0.0, drag)
        add_viscous(bulk, contacts, used, new, 0.0, drag, lag)
    put_in = normal + sprung + place(bulk, given.velocity, back * dt, drag)
    if dashpot is not None:
        withdraw(bulk, contacts, used)
        slowed = add_viscous(bulk, contacts, used, new, dt, drag, lag)
    put_in += place_spins(bulk, spin, back * dt)
    kick(crowd, 0, 0, n, 0.0)
    ahead = slowed[1] + total(crowd.work.sums, AHEAD)
    slipped = dragged = done = far = 0.0

    steps = 0
    for line in range(len(path)):
        if line:
            far = drift(bulk, dt)
        for step in range(stride if line else 0):
            steps += 1
            if not 2.0 * far < skin:
                skin, sought = adapted(skin, radius, steps - sought), steps
                sorted_cells = cells(bulk, reach + skin)
                pairs = near_pairs(bulk, sorted_cells, skin, pairs, rubs)
                edges = near_walls(bulk, walls, sorted_cells, skin, edges, rubs)
                crowd = Crowd(bulk, pairs, edges, batches(pairs), rules)
                set_weights(bulk, gravity)
                if dashpot is not None:
                    contacts = contact_arrays(len(pairs.other) + len(edges.other))
            with_energy = step + 1 == stride
            span = 0.0 if with_energy else dt
            if dashpot is None:
                step_all(crowd, with_energy, span, threads)
            else:
                add_all_forces(crowd, with_energy, threads)
                used = list_closed(bulk, pairs, edges, walls, contacts, dashpot, dt)
                slowed = add_viscous(bulk, contacts, used, new, dt, drag, lag)
                kick(crowd, 0, 0, n, span)
            sums = crowd.work.sums
            far = math.sqrt(farthest(sums))
            slipped += total(sums, LOST)
            dragged += ahead + slowed[0] + total(sums, BEHIND)
            ahead = slowed[1] + total(sums, AHEAD)

        observe(path, line, watched, given, bulk)
        sums = crowd.work.sums
        kinetic, normal, sprung = total(sums, KINETIC), total(sums, NORMAL), total(sums, SPRUNG)
        held = kinetic, normal, sprung, slipped, 0.5 * dt * dragged
        done = max(done, write_energies(energy, line, held, given, bulk, gravity))
        most, whole = put_in + done, kinetic + normal + sprung
        if line and not (
            whole <= GAIN * most and kinetic_energy_after(bulk, spin) <= BLOW_UP * most
        ):
            return line
    return len(path)

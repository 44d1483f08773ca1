"""The update of velocities and positions in the bulk model, inlined into its kernel."""

from __future__ import annotations

import math

from vv.engines.dem.bulk.batches import AHEAD, BEHIND, FAR, KINETIC
from vv.engines.dem.bulk.crowd import Crowd
from vv.engines.dem.bulk.grains import (
    BEFORE,
    SPUN,
    TURN,
    Grains,
    V,
    W,
    columns_of,
    moving_mass,
    set_columns,
)
from vv.engines.dem.space.advance import next_velocity
from vv.engines.dem.terms.drag import Drag
from vv.engines.kernels.compiled import inlined, lent
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot, put
from vv.scene import Vector


@lent
def drift(grains: Grains, dt: float) -> float:
    """Displace all spheres by a step; return the largest distance from `since` [m]."""
    row, since, far = grains.row, grains.since, 0.0
    for i in range(len(since)):
        x = add_scaled(at(row, i), dt, columns_of(row, i, V))
        put(row, i, x)
        moved = add_scaled(x, -1.0, at(since, i))
        far = max(far, dot(moved, moved))
    return math.sqrt(far)


@lent
def set_weights(grains: Grains, gravity: Triple) -> None:
    """Set the force on each sphere to its weight, and the torque to zero."""
    acting, mass = grains.acting, grains.mass
    for i in range(len(mass)):
        put(acting, i, add_scaled(NOWHERE, moving_mass(mass[i]), gravity))
        set_columns(acting, i, TURN, NOWHERE)


@lent
def place(grains: Grains, velocity: Vector, time: float, drag: Drag) -> float:
    """Set velocities to those `time` [s] before t = 0; return sum m v v/2 [J] at t = 0.

    velocity: (n, 3) at t = 0, in the order of the scene.
    """
    row, kinetic = grains.row, 0.0
    for i in range(len(grains.mass)):
        start = at(velocity, grains.original[i])
        push = add_scaled(at(grains.acting, i), -drag.eta, start)
        for c in range(3):
            row[i, V + c] = start[c] - time / grains.mass[i] * push[c]
        kinetic += 0.5 * moving_mass(grains.mass[i]) * dot(start, start)
    return kinetic


@lent
def place_spins(grains: Grains, spin: Vector | None, time: float) -> float:
    """As `place`, for spins (n, 3) at t = 0; zero if no sphere rotates."""
    row, turning = grains.row, 0.0
    if spin is not None:
        for i in range(len(grains.mass)):
            start, turn = at(spin, grains.original[i]), columns_of(grains.acting, i, TURN)
            for c in range(3):
                row[i, W + c] = start[c] - time / grains.inertia[i] * turn[c]
            turning += 0.5 * moving_mass(grains.inertia[i]) * dot(start, start)
    return turning


@inlined
def drag_powers(drag: Drag, lag: float, old: Triple, new: Triple) -> tuple[float, float]:
    """The powers D v- and D v+ [W] of drag D = eta (lag v- + (1 - lag) v+)."""
    loss = add_scaled(add_scaled(NOWHERE, drag.eta * lag, old), drag.eta * (1.0 - lag), new)
    return dot(loss, old), dot(loss, new)


@lent
def kick(crowd: Crowd, c: int, first: int, last: int, span: float) -> None:
    """Update velocities and spins of spheres first to last to half a step after the present time.

    Then displace them by a time `span` [s], a step or zero, and set forces to their weight; all of
    this in one pass over memory. Adds to row c of sums: m v- v+/2 + I w- w+/2 [J], and the powers
    of drag [W] before and after. Also updates there the square of the largest distance since the
    last neighbour search [m^2].
    """
    drag = crowd.rules.drag
    if drag.eta == 0.0:  # tested once: testing it for each sphere takes a twentieth of a step
        kick_each(crowd, c, first, last, span, None)
    else:
        kick_each(crowd, c, first, last, span, drag)


@lent
def kick_each(crowd: Crowd, c: int, first: int, last: int, span: float, drag: Drag | None) -> None:
    """As `kick`, with drag, or without if it is None."""
    grains, rules, sums = crowd.grains, crowd.rules, crowd.work.sums
    row, acting, mass, inertia = grains.row, grains.acting, grains.mass, grains.inertia
    dt, lag, gravity, turns = rules.dt, rules.lag, rules.gravity, rules.spin
    since, far, kinetic, behind, ahead = grains.since, sums[c, FAR], 0.0, 0.0, 0.0
    for i in range(first, last):
        if mass[i] == math.inf:  # fixed: forces on it are discarded
            put(acting, i, NOWHERE)
            set_columns(acting, i, TURN, NOWHERE)
            continue
        old = columns_of(row, i, V)
        new = next_velocity(old, at(acting, i), mass[i], dt, drag, lag, i)
        if drag is not None:
            powers = drag_powers(drag, lag, old, new)
            behind += powers[0]
            ahead += powers[1]
        set_columns(row, i, BEFORE, old)
        set_columns(row, i, V, new)
        kinetic += 0.5 * mass[i] * dot(old, new)
        if turns is not None:
            spun = columns_of(row, i, W)
            spins = add_scaled(spun, dt / inertia[i], columns_of(acting, i, TURN))
            set_columns(row, i, SPUN, spun)
            set_columns(row, i, W, spins)
            kinetic += 0.5 * inertia[i] * dot(spun, spins)
            set_columns(acting, i, TURN, NOWHERE)
        put(acting, i, add_scaled(NOWHERE, mass[i], gravity))
        x = add_scaled(at(row, i), span, new)
        put(row, i, x)
        moved = add_scaled(x, -1.0, at(since, i))
        far = max(far, dot(moved, moved))
    sums[c, KINETIC] += kinetic
    sums[c, BEHIND] += behind
    sums[c, AHEAD] += ahead
    sums[c, FAR] = far


@lent
def kinetic_energy_after(grains: Grains, spin: Vector | None) -> float:
    """The kinetic energy after the kick, m v+^2/2 and I w+^2/2 [J]."""
    row, fast = grains.row, 0.0
    for i in range(len(grains.mass)):
        v, w = columns_of(row, i, V), columns_of(row, i, W)
        fast += 0.5 * moving_mass(grains.mass[i]) * dot(v, v)
        if spin is not None:
            fast += 0.5 * moving_mass(grains.inertia[i]) * dot(w, w)
    return fast

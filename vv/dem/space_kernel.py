"""The compiled kernel for spheres that move and turn in space: the leapfrog over all contacts."""

from __future__ import annotations

from typing import Any

import numpy as np

from vv.compiled import compiled, inlined
from vv.dem.advance import kick, place
from vv.dem.contact_law import Index, Pairs, Walls, pair_forces, wall_forces
from vv.dem.driven import Base, carry
from vv.dem.limits import BLOW_UP, GAIN
from vv.drive import Drive, value
from vv.scene import Vector
from vv.triples import NOWHERE, Triple, at, dot, plus, put


@inlined
def rest(rows: int) -> Vector:
    """Zeros (rows, 3)."""
    return np.zeros((rows, 3))


@inlined
def forces(
    push: Vector,
    turn: Vector | None,
    u: Vector,
    v: Vector,
    v_before: Vector,
    w: Vector | None,
    w_before: Vector | None,
    dt: float,
    mass: Vector,
    gravity: Triple | None,
    load: Vector | None,
    pairs: Pairs | None,
    pair_shear: Vector,
    walls: Walls | None,
    wall_shear: Vector,
    kn: float,
    friction: tuple[float, float] | None,
    shaking: Drive | None,
    shaken: Triple,
    moving: tuple[Index, Vector] | None,
) -> tuple[float, float, float, float]:
    """Fill push and turn (m + 1, 3) [N, N m]; return energies [J].

    shaken: the acceleration by shaking, now [m/s2]. Energies: normal, shear, lost by friction,
    work of the walls.
    """
    normal = sprung = lost = work = 0.0
    for i in range(len(mass)):
        put(push, i, NOWHERE)
        if gravity is not None:
            put(push, i, plus(NOWHERE, mass[i], gravity))
        if load is not None:
            put(push, i, plus(at(push, i), 1.0, at(load, i)))
        if shaking is not None:
            put(push, i, plus(at(push, i), mass[i], shaken))
        if turn is not None:
            put(turn, i, NOWHERE)
    if pairs is not None:
        a, b, c = pair_forces(
            push, turn, u, v, v_before, w, w_before, dt, pairs, kn, friction, pair_shear
        )
        normal, sprung, lost = normal + a, sprung + b, lost + c
    if walls is not None:
        a, b, c, work = wall_forces(
            push, turn, u, v, v_before, w, w_before, dt, walls, kn, friction, wall_shear, moving
        )
        normal, sprung, lost = normal + a, sprung + b, lost + c
    return normal, sprung, lost, work


@compiled
def move_in_space(  # noqa: PLR0912, PLR0915 - a branch per term, decided by the compiler
    path: Vector,
    energy: Vector,
    watched: Index,
    stride: int,
    dt: float,
    velocity: Vector,
    spin: Vector | None,
    mass: Vector,
    inertia: Vector,
    gravity: Triple | None,
    load: Vector | None,
    hold: Vector | None,
    hold_spin: Vector | None,
    pairs: Pairs | None,
    walls: Walls | None,
    kn: float,
    friction: tuple[float, float] | None,
    eta: float | None,
    charged: Vector | None,
    shaking: Drive | None,
    base: Base | None,
    grounds: Index | None,
    lag: float,
    back: float,
) -> int:
    """Step m u'' = load + contacts - eta u' and I w' = torque by the leapfrog; return rows filled.

    velocity, spin: (m, 3) at t = 0; mass, inertia: (m,); gravity [m/s2]; load: (m, 3) dead
    forces; hold, hold_spin: (m, 3, 3) projectors on the free directions. Contacts: see
    `pair_forces` and `wall_forces`; row m is the ground, which does not move. charged: (q, 3)
    shear forces of the walls at t = 0. shaking: accelerations of all spheres; base: how the walls
    move, which have the rows from m + 1 on; grounds (q,): those rows. An absent term is None.
    The drag acts on lag v- + (1 - lag) v+: 1/2 the midpoint, 1 the previous mean velocity.
    back: how many dt before t = 0 the velocity is first placed.

    Every `stride` steps a row is written: path (k, b, 9): displacement, mean of v- and v+ and
    of w- and w+ of the watched rows, (k, b, 6) without spin; energy (k, 7) [J]: m v- v+/2 and
    I w- w+/2, normal springs, shear springs, lost by friction, lost by drag, work of gravity,
    of the loads; and (k, 9) where shaking or base is there: of shaking, of the walls. Stops
    before a later row in which energy was created (vv.dem.limits).
    """
    m = len(mass)
    rows = m + 1
    moving: Any
    if grounds is not None:
        rows = max(rows, grounds.max() + 1)
        moving = (grounds, rest(len(grounds)))
    else:
        moving = None
    shaken = NOWHERE
    if shaking is not None:
        shaken = value(shaking, 0.0)
    u, v, before, push = rest(rows), rest(rows), rest(rows), rest(m + 1)
    w: Any
    spun: Any
    turn: Any
    if spin is not None:
        w, spun, turn = rest(m + 1), rest(m + 1), rest(m + 1)
    else:
        w, spun, turn = None, None, None
    pair_shear = wall_shear = rest(0)
    if friction is not None:
        if pairs is not None:
            pair_shear = rest(len(pairs[0]))
        if walls is not None:
            wall_shear = rest(len(walls[0]))
            if charged is not None:
                wall_shear[:] = charged
    slipped = dragged = done = turning = shook = moved = 0.0
    normal, sprung, _, _ = forces(
        push, turn, u, v, before, w, spun, dt, mass, gravity, load,
        pairs, pair_shear, walls, wall_shear, kn, friction, shaking, shaken, moving,
    )  # fmt: skip
    if base is not None:
        carry(u, v, before, m + 1, base, -dt, dt)
        carry(u, v, before, m + 1, base, 0.0, dt)
    put_in = normal + sprung + place(v, velocity, push, mass, hold, back * dt, eta)
    kinetic, _, ahead = kick(v, before, push, mass, hold, dt, eta, lag)
    if spin is not None:
        put_in += place(w, spin, turn, inertia, hold_spin, back * dt, None)
        turning, _, _ = kick(w, spun, turn, inertia, hold_spin, dt, None, lag)

    steps = 0
    for row in range(len(path)):
        for _ in range(stride if row else 0):
            for i in range(m):
                put(u, i, plus(at(u, i), dt, at(v, i)))
            steps += 1
            if base is not None:
                carry(u, v, before, m + 1, base, steps * dt, dt)
            if shaking is not None:
                both = shaken
                shaken = value(shaking, steps * dt)
                both = plus(both, 1.0, shaken)
                for i in range(m):
                    shook += 0.5 * dt * mass[i] * dot(both, at(v, i))
            normal, sprung, lost, work = forces(
                push, turn, u, v, before, w, spun, dt, mass, gravity, load,
                pairs, pair_shear, walls, wall_shear, kn, friction, shaking, shaken, moving,
            )  # fmt: skip
            slipped += lost
            moved += work
            dragged += ahead
            kinetic, behind, ahead = kick(v, before, push, mass, hold, dt, eta, lag)
            dragged += behind
            if spin is not None:
                turning, _, _ = kick(w, spun, turn, inertia, hold_spin, dt, None, lag)

        for k in range(len(watched)):
            i = watched[k]
            for c in range(3):
                path[row, k, c] = u[i, c]
                path[row, k, 3 + c] = 0.5 * (before[i, c] + v[i, c])
                if spin is not None:
                    path[row, k, 6 + c] = 0.5 * (spun[i, c] + w[i, c])
        fallen = loaded = fast = 0.0
        for i in range(m):
            fast += 0.5 * mass[i] * dot(at(v, i), at(v, i))
            if gravity is not None:
                fallen += mass[i] * dot(gravity, at(u, i))
            if load is not None:
                loaded += dot(at(load, i), at(u, i))
            if spin is not None:
                fast += 0.5 * inertia[i] * dot(at(w, i), at(w, i))
        done = max(done, fallen + loaded + shook + moved)
        energy[row, 0], energy[row, 1], energy[row, 2] = kinetic + turning, normal, sprung
        energy[row, 3], energy[row, 4] = slipped, 0.5 * dt * dragged
        energy[row, 5], energy[row, 6] = fallen, loaded
        if shaking is not None or base is not None:
            energy[row, 7], energy[row, 8] = shook, moved
        total = kinetic + turning + normal + sprung
        if row and not (total <= GAIN * (put_in + done) and fast <= BLOW_UP * (put_in + done)):
            return row
    return len(path)

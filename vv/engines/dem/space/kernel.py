"""The compiled kernel for spheres that move and turn in space: the leapfrog over all forces."""

from __future__ import annotations

from typing import Any

import numpy as np

from vv.engines.dem.bonds.blocks import WIDE, Blocks
from vv.engines.dem.bonds.law import Frail, Springs
from vv.engines.dem.bonds.pull import parted, shares
from vv.engines.dem.limits import BLOW_UP, GAIN
from vv.engines.dem.rows import Index
from vv.engines.dem.space.advance import held, kick, place, upheld
from vv.engines.dem.space.driven import Base, carry
from vv.engines.dem.space.forces import forces, rest
from vv.engines.dem.space.neighbours import Near, gathered, no_slots, strayed
from vv.engines.dem.terms.contact_law import Pairs, Walls
from vv.engines.dem.terms.dashpots import dashpots, meet, shove, slow
from vv.engines.kernels.compiled import compiled
from vv.engines.kernels.drive import Drive, value
from vv.engines.kernels.triples import NOWHERE, Triple, at, dot, plus, put
from vv.scene import Vector


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
    eta_n: float | None,
    charged: Vector | None,
    shaking: Drive | None,
    base: Base | None,
    grounds: Index | None,
    carried: Vector | None,
    springs: Springs | None,
    bond_ks: Vector | None,
    blocks: Blocks | None,
    frail: Frail | None,
    near: Near | None,
    threads: int | None,
    lag: float,
    back: float,
) -> int:
    """Step m u'' = load + contacts + bonds - eta u' and I w' = torque by the leapfrog.

    Returns how many rows it filled.

    velocity, spin: (m, 3) at t = 0; mass, inertia: (m,); gravity [m/s2]; load: (m, 3) dead
    forces; hold, hold_spin: (m, 3, 3) projectors on the free directions. Contacts: see
    `pair_forces` and `wall_forces`; row m is the ground, which does not move. charged: (q, 3)
    shear forces of the walls at t = 0. shaking: accelerations of all spheres; base: how the walls
    move, which have the rows from m + 1 on; grounds (q,): those rows. carried: (m, 3) the steady
    velocity that spheres keep along their locks. Bonds: see `pull`; threads: not None
    if several share them. near: what pairs are gathered
    from as spheres stray (`neighbours.py`), where `pairs` is None. An absent term is None.
    Drag, and the contacts' eta_n [N s/m], where walls rest and pairs are listed, act on
    lag v- + (1 - lag) v+: 1/2 the midpoint, 1 the previous mean velocity.
    back: how many dt before t = 0 the velocity is first placed.

    Every `stride` steps a row is written: path (k, b, 12): displacement, mean of v- and v+ and
    of w- and w+ of the watched rows, and the force of their locks; the last two only where there
    are spin and hold. energy (k, 7) [J]: m v- v+/2 and I w- w+/2, normal springs, shear springs,
    lost by friction, by drag and viscous contacts, work of gravity, of the loads; (k, 9) where
    shaking or base is there: of shaking, of the walls; (k, 12) where carried or frail is: of what
    carries, and lost with the normal and the shear springs of bonds that broke. Stops before a
    later row in which energy was created (vv.engines.dem.limits).
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
    since, many, torn = rest(0), np.zeros(1, np.intp), np.zeros(2)
    state = np.zeros((0, WIDE), np.uint8)
    table, each = np.zeros((0, 0)), shares(0, m + 1)
    if blocks is not None:
        table, each = blocks[1].copy(), shares(len(blocks[4]), m + 1)
        if frail is not None:
            state = np.zeros((len(blocks[0]), WIDE), np.uint8)
    broken = state.reshape(-1)
    slots = no_slots()
    if near is not None:
        since = rest(m)
        slots = gathered(near, u, broken, slots, many)
    slipped = dragged = done = turning = shook = moved = borne = power = 0.0
    if eta_n is not None:
        met, new = dashpots(pairs, walls, m), rest(m + 1)
        v[:m] = velocity
    normal, sprung, _, _, breaking = forces(
        push, turn, u, v, before, w, spun, dt, mass, gravity, load,
        pairs, pair_shear, walls, wall_shear, kn, friction, shaking, shaken, moving,
        springs, bond_ks, blocks, table, each, frail, state, near, slots, many,
        threads,
    )  # fmt: skip
    if springs is not None and frail is not None and breaking > 0.0:
        a, b = parted(
            push, turn, u, v, w, dt, springs, bond_ks, table, frail, state, slots, many, torn
        )
        normal, sprung = normal + a, sprung + b
    if eta_n is not None:
        meet(met, u, pairs, walls, kn, eta_n)
        slow(met, push, v, new, mass, hold, 0.0, eta, lag, carried)
    if carried is not None:
        power = upheld(push, carried, eta)
    if base is not None:
        carry(u, v, before, m + 1, base, -dt, dt)
        carry(u, v, before, m + 1, base, 0.0, dt)
    put_in = normal + sprung + place(v, velocity, push, mass, hold, back * dt, eta, carried)
    if eta_n is not None:
        shove(met, push, -1.0)
        _, dashed = slow(met, push, v, new, mass, hold, dt, eta, lag, carried)
    kinetic, _, ahead = kick(v, before, push, mass, hold, dt, eta, lag, carried)
    if eta_n is not None:
        ahead += dashed
    if spin is not None:
        put_in += place(w, spin, turn, inertia, hold_spin, back * dt, None, None)
        turning, _, _ = kick(w, spun, turn, inertia, hold_spin, dt, None, lag, None)

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
            if near is not None and strayed(u, since, near[3]):
                since[:] = u[:m]
                slots = gathered(near, u, broken, slots, many)
            normal, sprung, lost, work, breaking = forces(
                push, turn, u, v, before, w, spun, dt, mass, gravity, load,
                pairs, pair_shear, walls, wall_shear, kn, friction, shaking, shaken, moving,
                springs, bond_ks, blocks, table, each, frail, state, near, slots, many,
                threads,
            )  # fmt: skip
            if springs is not None and frail is not None and breaking > 0.0:
                a, b = parted(
                    push,
                    turn,
                    u,
                    v,
                    w,
                    dt,
                    springs,
                    bond_ks,
                    table,
                    frail,
                    state,
                    slots,
                    many,
                    torn,
                )
                normal, sprung = normal + a, sprung + b
            if eta_n is not None:
                meet(met, u, pairs, walls, kn, eta_n)
                slowed, dashed = slow(met, push, v, new, mass, hold, dt, eta, lag, carried)
            if carried is not None:
                borne += 0.5 * dt * power
                power = upheld(push, carried, eta)
                borne += 0.5 * dt * power
            slipped += lost
            moved += work
            dragged += ahead
            kinetic, behind, ahead = kick(v, before, push, mass, hold, dt, eta, lag, carried)
            dragged += behind
            if eta_n is not None:
                dragged += slowed
                ahead += dashed
            if spin is not None:
                turning, _, _ = kick(w, spun, turn, inertia, hold_spin, dt, None, lag, None)

        for k in range(len(watched)):
            i = watched[k]
            for c in range(3):
                path[row, k, c] = u[i, c]
                path[row, k, 3 + c] = 0.5 * (before[i, c] + v[i, c])
                if spin is not None:
                    path[row, k, 6 + c] = 0.5 * (spun[i, c] + w[i, c])
            if hold is not None and i < m:
                force = plus(held(at(push, i), hold, i), -1.0, at(push, i))
                if carried is not None and eta is not None:
                    force = plus(force, eta, at(carried, i))
                for c in range(3):
                    path[row, k, path.shape[2] - 3 + c] = force[c]
        fallen = loaded = fast = 0.0
        for i in range(m):
            fast += 0.5 * mass[i] * dot(at(v, i), at(v, i))
            if gravity is not None:
                fallen += mass[i] * dot(gravity, at(u, i))
            if load is not None:
                loaded += dot(at(load, i), at(u, i))
            if spin is not None:
                fast += 0.5 * inertia[i] * dot(at(w, i), at(w, i))
        done = max(done, fallen + loaded + shook + moved + borne)
        energy[row, 0], energy[row, 1], energy[row, 2] = kinetic + turning, normal, sprung
        energy[row, 3], energy[row, 4] = slipped, 0.5 * dt * dragged
        energy[row, 5], energy[row, 6] = fallen, loaded
        if energy.shape[1] > 7:
            energy[row, 7], energy[row, 8] = shook, moved
        if carried is not None or frail is not None:
            energy[row, 9], energy[row, 10], energy[row, 11] = borne, torn[0], torn[1]
        total = kinetic + turning + normal + sprung
        if row and not (total <= GAIN * (put_in + done) and fast <= BLOW_UP * (put_in + done)):
            return row
    return len(path)

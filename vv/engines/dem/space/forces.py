"""All forces on spheres that move and turn in space, inlined into their kernel."""

from __future__ import annotations

import numpy as np

from vv.engines.dem.bonds.blocks import Blocks
from vv.engines.dem.bonds.law import Frail, Springs
from vv.engines.dem.bonds.pull import Shares, pull
from vv.engines.dem.rows import Index
from vv.engines.dem.space.neighbours import Near, Slots, State
from vv.engines.dem.terms.contact_law import Pairs, Walls, pair_forces, wall_forces
from vv.engines.kernels.compiled import inlined, inlined_called
from vv.engines.kernels.drive import Drive
from vv.engines.kernels.triples import NOWHERE, Triple, at, plus, put
from vv.scene import Vector


@inlined_called
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
    springs: Springs | None,
    bond_ks: Vector | None,
    blocks: Blocks | None,
    table: Vector,
    each: Shares,
    frail: Frail | None,
    state: State,
    near: Near | None,
    slots: Slots,
    many: Index,
    threads: int | None,
) -> tuple[float, float, float, float, float]:
    """Fill push and turn (m + 1, 3) [N, N m]; return energies [J].

    shaken: the acceleration by shaking, now [m/s2]. Bonds: see `pull`. Energies: normal,
    shear, lost by friction, work of the walls; last, how many bonds break.
    """
    normal = sprung = lost = work = breaking = 0.0
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
    if near is not None:
        k = many[0]
        touching = slots[1][:k], slots[2][:k], slots[3][:k], slots[4][:k]
        a, b, c = pair_forces(
            push, turn, u, v, v_before, w, w_before, dt, touching, kn, friction, slots[5]
        )
        normal, sprung, lost = normal + a, sprung + b, lost + c
    if springs is not None and blocks is not None:
        a, b, breaking = pull(
            push, turn, u, v, w, dt, springs, bond_ks, blocks, table, each, frail, state,
            threads,
        )  # fmt: skip
        normal, sprung = normal + a, sprung + b
    return normal, sprung, lost, work, breaking

"""The term for bonds between spheres, which may break; computed in `vv.engines.dem.bonds`."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.dem.bonds.all_forces import add_bond_forces, break_bonds
from vv.engines.dem.bonds.arrays import WHOLE, BondArrays, shares
from vv.engines.dem.bonds.blocks import WIDE
from vv.engines.dem.bonds.law import Frail
from vv.engines.dem.rows import Index
from vv.engines.dem.space import springs as stable
from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.ledger import column
from vv.engines.dem.space.neighbours import Slots
from vv.engines.dem.space.placed import Placed
from vv.engines.kernels.compiled import inlined
from vv.scene import Form, Mask, Vector

NORMAL, SHEAR = column(Form.BROKEN_NORMAL), column(Form.BROKEN_SHEAR)


class Bonds(NamedTuple):
    """The bonds of a scene."""

    arrays: BondArrays


def build(placed: Placed) -> Bonds | None:
    """The bonds with at least one moving end; None if there are none."""
    springs, ks, blocks, frail, state = placed.bonds
    if springs is None or blocks is None:
        return None
    chunks = len(blocks.window)
    each = shares(chunks, int(placed.moves.sum()) + 1)
    table, torn = np.zeros_like(blocks.table), np.zeros(2)
    return Bonds(BondArrays(springs, ks, blocks, frail, table, *each, state, torn))


def shared_bonds(term: Bonds, threads: int) -> Bonds:
    """The same bonds, whose chunks are computed in so many threads."""
    return Bonds(term.arrays._replace(threads=threads))


def turns(term: Bonds) -> bool:
    """Whether the bonds may rotate spheres."""
    return term.arrays.ks is not None


def forms(term: Bonds) -> tuple[Form, ...]:
    """The forms of energy that bonds report."""
    return () if term.arrays.frail is None else (Form.BROKEN_NORMAL, Form.BROKEN_SHEAR)


def words(term: Bonds) -> str:
    """The part of the model's description that concerns bonds."""
    return f", {len(term.arrays.springs[0])} bonds"


def springs(term: Bonds, near: object) -> tuple[stable.Springs, Mask]:
    """The springs of all bonds, and a mask that is true throughout: all exist at t = 0."""
    rows, offset, first, _, kn, radius = term.arrays.springs
    across = np.zeros(len(kn)) if term.arrays.ks is None else term.arrays.ks
    beyond = 0.5 * (first - radius.sum(axis=1))[:, None]
    found = stable.Springs(rows, offset / first[:, None], kn, across, radius + beyond)
    return found, np.ones(len(kn), bool)


@inlined
def begin(term: Bonds, bodies: Bodies, motion: Motion) -> None:
    """Make all bonds whole, as they are at t = 0."""
    table = term.arrays.blocks.table
    for k in range(table.shape[0]):
        for c in range(table.shape[1]):
            term.arrays.table[k, c] = table[k, c]
    for k in range(term.arrays.state.shape[0]):
        for q in range(WIDE):
            term.arrays.state[k, q] = WHOLE
    term.arrays.torn[0] = term.arrays.torn[1] = 0.0


@inlined
def force(
    term: Bonds, bodies: Bodies, motion: Motion, dt: float, slots: Slots, many: Index
) -> tuple[float, float, float, float]:
    """Add the forces of all bonds except those that break; return their springs' energies [J]."""
    normal, shear, _ = add_bond_forces(term.arrays, motion, dt)
    return normal, shear, 0.0, 0.0


@inlined
def release(
    term: Bonds, bodies: Bodies, motion: Motion, dt: float, slots: Slots, many: Index
) -> tuple[float, float]:
    """Break the bonds whose strength is exceeded; return the energies that remain [J]."""
    return breaking(term, term.arrays.frail, motion, dt, slots, many)


@inlined
def breaking(
    term: Bonds, frail: Frail | None, motion: Motion, dt: float, slots: Slots, many: Index
) -> tuple[float, float]:
    """As `release`; frail is None if no bond can break."""
    if frail is None:
        return 0.0, 0.0
    held, many_break = term.arrays.held, 0.0
    for c in range(len(held)):
        many_break += held[c, 2]
    if many_break == 0.0:
        return 0.0, 0.0
    return break_bonds(term.arrays, motion, dt, frail, slots, many)


@inlined
def book(term: Bonds, bodies: Bodies, motion: Motion, energy: Vector, row: int) -> tuple[float]:
    """Write the energies lost with broken bonds since t = 0 [J]."""
    write_losses(energy, row, term.arrays.torn, term.arrays.frail)
    return (0.0,)


@inlined
def write_losses(energy: Vector, row: int, torn: Vector, frail: Frail | None) -> None:
    """Fill the columns of broken bonds, which exist only if bonds may break."""
    if frail is not None:
        energy[row, NORMAL], energy[row, SHEAR] = torn[0], torn[1]

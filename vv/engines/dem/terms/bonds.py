"""Bonds between spheres, which may break; how they are computed: `vv.engines.dem.bonds`."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.dem.bonds.bend import SCRATCH
from vv.engines.dem.bonds.blocks import WIDE, Blocks
from vv.engines.dem.bonds.law import Frail, Springs
from vv.engines.dem.bonds.pull import Shares, parted, pull
from vv.engines.dem.rows import Index
from vv.engines.dem.space import springs as stable
from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.ledger import column
from vv.engines.dem.space.neighbours import Slots, State
from vv.engines.dem.space.placed import Placed
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import inlined
from vv.scene import Form, Mask, Vector

NORMAL, SHEAR = column(Form.BROKEN_NORMAL), column(Form.BROKEN_SHEAR)


@bundle
class Bonds(NamedTuple):
    """What `pull` receives by these names.

    What is kept from step to step is table, each, state and torn (2,), the energies [J] lost with
    the normal and the shear springs of bonds that broke.
    """

    springs: Springs
    ks: Vector | None
    blocks: Blocks
    frail: Frail | None
    table: Vector
    each: Shares
    state: State
    torn: Vector
    threads: int | None = None


def build(placed: Placed) -> Bonds | None:
    """The bonds of which one end moves, if there are any."""
    springs, ks, blocks, frail, state = placed.bonds
    if springs is None or blocks is None:
        return None
    chunks = len(blocks.window)
    rows = chunks * (int(placed.moves.sum()) + 1)
    each = (np.zeros((rows, 3)), np.zeros((rows, 3)),
            np.zeros((chunks, SCRATCH * WIDE)), np.zeros((chunks, 3)))  # fmt: skip
    return Bonds(springs, ks, blocks, frail, np.zeros_like(blocks.table), each, state, np.zeros(2))


def turns(term: Bonds) -> bool:
    """Whether they may turn spheres."""
    return term.ks is not None


def forms(term: Bonds) -> tuple[Form, ...]:
    """What they book."""
    return () if term.frail is None else (Form.BROKEN_NORMAL, Form.BROKEN_SHEAR)


def words(term: Bonds) -> str:
    """What is said of them."""
    return f", {len(term.springs[0])} bonds"


def springs(term: Bonds, near: object) -> tuple[stable.Springs, Mask]:
    """Their springs, all of which are there at t = 0."""
    rows, offset, first, _, kn, radius = term.springs
    across = np.zeros(len(kn)) if term.ks is None else term.ks
    beyond = 0.5 * (first - radius.sum(axis=1))[:, None]
    found = stable.Springs(rows, offset / first[:, None], kn, across, radius + beyond)
    return found, np.ones(len(kn), bool)


@inlined
def begin(term: Bonds, bodies: Bodies, motion: Motion) -> None:
    """All bonds are whole."""
    table = term.blocks[1]
    for k in range(table.shape[0]):
        for c in range(table.shape[1]):
            term.table[k, c] = table[k, c]
    for k in range(term.state.shape[0]):
        for q in range(WIDE):
            term.state[k, q] = 0
    term.torn[0] = term.torn[1] = 0.0


@inlined
def force(
    term: Bonds, bodies: Bodies, motion: Motion, dt: float, slots: Slots, many: Index
) -> tuple[float, float, float, float]:
    """The forces of all bonds but those that break."""
    normal, shear, _ = pull(
        motion.push, motion.turn, motion.u, motion.v, motion.w, dt, term.springs, term.ks,
        term.blocks, term.table, term.each, term.frail, term.state, term.threads,
    )  # fmt: skip
    return normal, shear, 0.0, 0.0


@inlined
def release(
    term: Bonds, bodies: Bodies, motion: Motion, dt: float, slots: Slots, many: Index
) -> tuple[float, float]:
    """Part the bonds that break."""
    return breaking(term, term.frail, motion, dt, slots, many)


@inlined
def breaking(
    term: Bonds, frail: Frail | None, motion: Motion, dt: float, slots: Slots, many: Index
) -> tuple[float, float]:
    """Part the bonds that break, if any can."""
    if frail is None:
        return 0.0, 0.0
    held, many_break = term.each[3], 0.0
    for c in range(len(held)):
        many_break += held[c, 2]
    if many_break == 0.0:
        return 0.0, 0.0
    return parted(
        motion.push, motion.turn, motion.u, motion.v, motion.w, dt, term.springs, term.ks,
        term.table, frail, term.state, slots, many, term.torn,
    )  # fmt: skip


@inlined
def book(term: Bonds, bodies: Bodies, motion: Motion, energy: Vector, row: int) -> tuple[float]:
    """What was lost since t = 0."""
    enter(energy, row, term.torn, term.frail)
    return (0.0,)


@inlined
def enter(energy: Vector, row: int, torn: Vector, frail: Frail | None) -> None:
    """Fill the columns, which there are where bonds may break."""
    if frail is not None:
        energy[row, NORMAL], energy[row, SHEAR] = torn[0], torn[1]

"""The bonds of a scene as arrays for the kernel, and the spheres that may come to touch."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from vv.engines.dem.bonds.blocks import WIDE, Blocks, blocks
from vv.engines.dem.rows import Index
from vv.engines.dem.space.neighbours import Near, State
from vv.scene import Mask, Scene, Term, Vector

if TYPE_CHECKING:
    from vv.engines.dem.bonds.law import Frail, Springs

MANY = 64  # spheres, from which on pairs are gathered from those near each other
SKIN = 0.2  # of the smallest radius: a gap below which pairs are near each other


class Bonded(NamedTuple):
    """What `vv.engines.dem.bonds.pull.pull` takes by these names; None where there is nothing."""

    springs: Springs | None = None
    ks: Vector | None = None
    blocks: Blocks | None = None
    frail: Frail | None = None
    state: State = np.zeros((0, WIDE), np.uint8)


def bonded(scene: Scene, moves: Mask, row: Index) -> Bonded:
    """The bonds of which one end moves, in the order of `_held`."""
    bonds, spheres, (pairs, order) = scene.bonds, scene.spheres, _held(scene, moves)
    if bonds is None or not len(pairs):
        return Bonded()
    offset = spheres.position[pairs[:, 1]] - spheres.position[pairs[:, 0]]
    first = np.sqrt((offset**2).sum(axis=1))
    stretch, ks = first - bonds.length[order], bonds.ks[order]
    kn, tension, shear = bonds.kn[order], bonds.tension[order], bonds.shear[order]
    springs = row[pairs], offset, first, stretch, kn, spheres.radius[pairs]
    laid = blocks(springs, np.stack([kn, ks, tension, shear]), int(moves.sum()))
    frail = (tension, shear, scene.contact.mu, pairs) if Term.BREAKAGE in scene.terms() else None
    state = np.zeros((0 if frail is None else len(laid.ends), WIDE), np.uint8)
    return Bonded(springs, ks if ks.any() else None, laid, frail, state)


def near(scene: Scene, moves: Mask, row: Index, state: State) -> Near | None:
    """What `vv.engines.dem.space.neighbours.swept` finds the pairs in that may touch.

    state: of the bonds (`vv.engines.dem.bonds.sweep`). None if none may, or if few spheres
    without bonds let all pairs be listed.
    """
    spheres = scene.spheres
    if Term.SPHERE_CONTACT not in scene.terms():
        return None
    if scene.bonds is None and len(spheres) < MANY:
        return None
    skin, (pairs, _) = SKIN * float(spheres.radius.min()), _held(scene, moves)
    start = np.searchsorted(pairs[:, 0], np.arange(len(spheres) + 1))
    held = start, np.array(pairs[:, 1]), state.reshape(-1)
    return Near(spheres.position, spheres.radius, row, skin, *held, scene.contact.viscous)


def _held(scene: Scene, moves: Mask) -> tuple[Index, Index]:
    """The bonded pairs i < j (b, 2) of which one moves, sorted, and which bonds these are (b,)."""
    pairs = np.sort(scene.bonded_pairs, axis=1)
    order = np.lexsort((pairs[:, 1], pairs[:, 0]))
    order = order[moves[pairs[order]].any(axis=1)]
    return np.asarray(pairs[order], np.intp), order

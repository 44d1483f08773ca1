"""The bonds of a scene as arrays for the kernel, and the data of its neighbour search."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from vv.engines.dem.bonds.blocks import WIDE, Blocks, bond_blocks
from vv.engines.dem.rows import Index
from vv.engines.dem.space.neighbours import Near, State
from vv.scene import Mask, Scene, Term, Vector

if TYPE_CHECKING:
    from vv.engines.dem.bonds.law import Frail, Springs

MANY = 64  # the fewest spheres whose pairs are found by a neighbour search
SKIN = 0.2  # relative to the smallest radius: pairs with a smaller gap are near each other


class Bonded(NamedTuple):
    """The fields of these names of `BondArrays`; None without bonds."""

    springs: Springs | None = None
    ks: Vector | None = None
    blocks: Blocks | None = None
    frail: Frail | None = None
    state: State = np.zeros((0, WIDE), np.uint8)


def bonds_of(scene: Scene, moves: Mask, row: Index) -> Bonded:
    """The arrays of all bonds with at least one moving end, in the order of `_bonded_pairs`."""
    bonds, spheres, (pairs, order) = scene.bonds, scene.spheres, _bonded_pairs(scene, moves)
    if bonds is None or not len(pairs):
        return Bonded()
    offset = spheres.position[pairs[:, 1]] - spheres.position[pairs[:, 0]]
    first = np.sqrt((offset**2).sum(axis=1))
    stretch, ks = first - bonds.length[order], bonds.ks[order]
    kn, tension, shear = bonds.kn[order], bonds.tension[order], bonds.shear[order]
    springs = row[pairs], offset, first, stretch, kn, spheres.radius[pairs]
    joined = len(pairs) > WIDE or not bonds_turn_alone(scene)
    laid = bond_blocks(springs, np.stack([kn, ks, tension, shear]), int(moves.sum()), joined)
    frail = (tension, shear, scene.contact.mu, pairs) if Term.BREAKAGE in scene.terms() else None
    state = np.zeros((0 if frail is None else len(laid.ends), WIDE), np.uint8)
    return Bonded(springs, ks if ks.any() else None, laid, frail, state)


def search_data(scene: Scene, moves: Mask, row: Index, state: State) -> Near | None:
    """The data of the neighbour search, or None if it is not needed.

    It is not needed where no spheres can touch, unless bonds turn them, or where there are few
    spheres and no bonds, so that all pairs are listed once. state: of the bonds
    (`vv.engines.dem.bonds.arrays`).
    """
    spheres = scene.spheres
    if Term.SPHERE_CONTACT not in scene.terms() and not bonds_turn_alone(scene):
        return None
    if scene.bonds is None and len(spheres) < MANY:
        return None
    skin, (pairs, _) = SKIN * float(spheres.radius.min()), _bonded_pairs(scene, moves)
    start = np.searchsorted(pairs[:, 0], np.arange(len(spheres) + 1))
    held = start, np.array(pairs[:, 1]), state.reshape(-1)
    return Near(spheres.position, spheres.radius, row, skin, *held, scene.contact.viscous)


def bonds_turn_alone(scene: Scene) -> bool:
    """Whether bonds turn spheres, without friction, dashpots or Hertzian contact.

    All these scenes share a kernel, with a neighbour search where no spheres can touch, and with
    the values of few bonds stored for each: both cost little beside bonds that turn spheres.
    """
    terms = scene.terms()
    others = {Term.FRICTION, Term.CONTACT_VISCOSITY, Term.HERTZ}
    return {Term.BOND_SHEAR, Term.ROTATION} <= terms and not others & terms


def _bonded_pairs(scene: Scene, moves: Mask) -> tuple[Index, Index]:
    """The bonded pairs i < j (b, 2) with a moving sphere, sorted, and their bonds (b,)."""
    pairs = np.sort(scene.bonded_pairs, axis=1)
    order = np.lexsort((pairs[:, 1], pairs[:, 0]))
    order = order[moves[pairs[order]].any(axis=1)]
    return np.asarray(pairs[order], np.intp), order

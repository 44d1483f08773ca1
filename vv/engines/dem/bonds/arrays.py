"""The arrays of all bonds, which kernels pass on as one bundle."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.dem.bonds.blocks import SCRATCH, WIDE, Blocks
from vv.engines.dem.bonds.law import Frail, Springs
from vv.engines.dem.space.neighbours import State
from vv.engines.kernels.bundles import bundle
from vv.scene import Vector

WHOLE, BROKEN, BREAKS = 0, 1, 2  # states of a bond: whole, broken before, breaking in this step


@bundle
class BondArrays(NamedTuple):
    """The b bonds of a scene, in blocks that are divided among c chunks.

    springs: rows (b, 2), offset at t = 0 (b, 3) and its length (b,), stretch at t = 0 (b,), kn
    (b,), radii (b, 2); ks: (b,), or None without shear springs; frail: tension and shear strengths
    (b,), mu, and the spheres i < j (b, 2), or None if no bond can break.

    What follows changes in each step. table: that of blocks, in which the shear displacements are
    updated; they rotate with the bond and, where spheres rotate, about it by the mean of their
    spins. pushes, torques: forces [N] and torques [N m] of each chunk (c x rows, 3); scratch: a row
    for each chunk; held: (c, 3) normal and shear energies [J], and how many bonds break; state: of
    each bond, by blocks; torn: (2,) the energies [J] lost with the normal and the shear springs of
    broken bonds.

    threads: how many compute the chunks; None if the chunks are computed in turn.
    """

    springs: Springs
    ks: Vector | None
    blocks: Blocks
    frail: Frail | None
    table: Vector
    pushes: Vector
    torques: Vector
    scratch: Vector
    held: Vector
    state: State
    torn: Vector
    threads: int | None = None


def shares(chunks: int, rows: int) -> tuple[Vector, Vector, Vector, Vector]:
    """Pushes, torques, scratch and held of `BondArrays`, with zeros; rows: of motion."""
    pushes, torques = np.zeros((chunks * rows, 3)), np.zeros((chunks * rows, 3))
    return pushes, torques, np.zeros((chunks, SCRATCH * WIDE)), np.zeros((chunks, 3))

"""Scenes of close-packed blocks between smooth platens, which are rigid or on springs."""

from __future__ import annotations

import functools
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from cases.bonds.parts._loading import RATES
from reference_solutions.bonds import lattice_material
from reference_solutions.bonds.close_packed_lattice import SIZES, Lattice, lattice
from vv.ask import Reaction
from vv.case import Parameters
from vv.scene import Bonds, Contact, Scene, Spheres

APART = 2.0  # widths between the centres of the blocks, which never meet
AWAY = 1e3  # heights of the block to the far ends of the springs, so that these stay upright


@functools.lru_cache(maxsize=4)
def block_of(size: int, d: float) -> Lattice:
    """The block of `size` elements."""
    return lattice(*SIZES[size], d)


def specimen(p: Parameters, block: Lattice, rates: tuple[float, ...] = RATES) -> Scene:
    """Blocks side by side, whose ends are moved apart by smooth platens at constant rates.

    All elements start with the velocities of the infinite lattice under that strain rate.
    """
    n, x = len(block.position), block.position - block.position.mean(axis=0)
    free = np.ones_like(x, bool)
    free[_ends(block), 2] = False
    nu = lattice_material.poissons_ratio(p["kn"], p["ks"])
    velocity = p["rate"] * (x - [0.0, 0.0, x[:, 2].min()]) * [-nu, -nu, 1.0]
    aside = np.array([APART * np.ptp(x[:, 0]), 0.0, 0.0])
    many = len(rates)
    spheres = Spheres(
        np.concatenate([block.position + k * aside for k in range(many)]),
        np.concatenate([times * velocity for times in rates]),
        np.full(many * n, p["d"] / 2),
        np.full(many * n, p["m"]),
        np.tile(free, (many, 1)),
    )
    pairs = np.concatenate([block.bonds + k * n for k in range(many)])
    values = (p["d"], p["kn"], p["ks"], p["kn"] * p["xb"], p["fs0"])
    bonds = Bonds(pairs, *(np.full(len(pairs), value) for value in values))
    return Scene((spheres,), Contact(p["kn"], p["ks"], p["mu_p"]), viscosity(p, block), bonds=bonds)


def yielding(p: Parameters, block: Lattice) -> Scene:
    """The specimen with a spring of stiffness `platen` [N/m] on each element of its ends.

    The far ends of the springs are moved instead of the elements; they are the last bodies, in the
    order of `_ends`.
    """
    rigid = specimen(p, block)
    blocks, ends = rigid.spheres, _ends(block)
    many = len(RATES)
    held = np.concatenate([ends + k * len(block.position) for k in range(many)])
    side = np.where(block.at(2, 1)[ends], 1.0, -1.0)
    away, upright = AWAY * block.height, np.array([0.0, 0.0, 1.0])
    far = Spheres(
        blocks.position[held] + np.outer(np.tile(side, many), away * upright),
        blocks.velocity[held] * upright,
        np.full(len(held), p["d"] / 4),
        np.full(len(held), p["m"]),
        np.zeros((len(held), 3), bool),
    )
    bonds = rigid.bonds
    assert bonds is not None
    springs = np.column_stack([held, len(blocks) + np.arange(len(held))])
    own = (bonds.length, bonds.kn, bonds.ks, bonds.tension, bonds.shear)
    added = (away, p["platen"], 0.0, np.inf, np.inf)
    tied = (
        np.append(one, np.full(len(held), value)) for one, value in zip(own, added, strict=True)
    )
    freed = replace(blocks, free=np.ones_like(blocks.free))
    return replace(
        rigid, bodies=(freed, far), bonds=Bonds(np.concatenate([bonds.pairs, springs]), *tied)
    )


def on_tops(block: Lattice) -> list[list[Reaction]]:
    """The reactions of the elements on top of each block."""
    top = np.flatnonzero(block.at(2, 1)).tolist()
    return [[Reaction(i + k * len(block.position)) for i in top] for k in range(len(RATES))]


def on_springs(block: Lattice) -> list[list[Reaction]]:
    """The reactions of the springs on top of each block between platens on springs."""
    first, many = len(RATES) * len(block.position), len(_ends(block))
    return [[Reaction(first + k * many + i) for i in range(many // 2)] for k in range(len(RATES))]


def _ends(block: Lattice) -> npt.NDArray[np.intp]:
    """Numbers of the elements of the last layer, then of the first."""
    return np.concatenate([np.flatnonzero(block.at(2, side)) for side in (1, 0)])


def viscosity(p: Parameters, block: Lattice) -> float:
    """eta [N s/m] of Eq. 28, with the volume of the hull."""
    share = p["d"] / (block.area * block.height) ** (1 / 3)
    return float(share * np.sqrt(8 * p["m"] * p["kn"]))

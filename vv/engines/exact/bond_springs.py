"""The normal and shear springs of bonds in the exact equations of motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from vv.scene import Vector

Owners = npt.NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class BondSprings:
    """The h linear springs of b bonds; their stretches are stretch + rows @ q [m], for unknowns q.

    stretch: (h,) at t = 0 [m]; rows: (h, n); stiffness: (h,) [N/m]. The first b springs act along
    the bonds, whose length at t = 0 is length (b,) [m] and whose bodies are in names; the others
    are shear springs.
    """

    rows: Vector
    stiffness: Vector
    stretch: Vector
    length: Vector
    names: tuple[tuple[int, int], ...]


def no_bond_springs(owner: Owners, direction: Vector) -> BondSprings:
    """The empty set of springs of a scene without bonds."""
    return BondSprings(np.zeros((0, len(owner))), np.zeros(0), np.zeros(0), np.zeros(0), ())

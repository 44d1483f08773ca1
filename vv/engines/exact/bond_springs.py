"""The normal and shear springs of bonds in the exact equations of motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from vv.scene import Vector

Owners = npt.NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class BondSprings:
    """h linear springs with the stretches stretch + rows @ q [m]; stretch (h,), rows (h, n).

    stiffness: (h,) [N/m]. The first b springs act along the bonds, which have the given length
    (b,) [m] at t = 0 and join the bodies in names; the others act across bonds.
    """

    rows: Vector
    stiffness: Vector
    stretch: Vector
    length: Vector
    names: tuple[tuple[int, int], ...]


def no_bond_springs(owner: Owners, direction: Vector) -> BondSprings:
    """The springs of a scene without bonds: none."""
    return BondSprings(np.zeros((0, len(owner))), np.zeros(0), np.zeros(0), np.zeros(0), ())

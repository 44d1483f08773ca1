"""The springs of bonds, as an exact system carries them beside its contacts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from vv.scene import Vector

Owners = npt.NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Ties:
    """h springs that pull and push, whose stretches are stretch + rows @ q, (h,) + (h, n) [m].

    stiffness: (h,) [N/m]. The first b of them act along bonds of given length (b,) [m] at t = 0
    between the bodies in names, the others across bonds.
    """

    rows: Vector
    stiffness: Vector
    stretch: Vector
    length: Vector
    names: tuple[tuple[int, int], ...]


def untied(owner: Owners, direction: Vector) -> Ties:
    """No ties."""
    return Ties(np.zeros((0, len(owner))), np.zeros(0), np.zeros(0), np.zeros(0), ())

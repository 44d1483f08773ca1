"""Frictionless spheres at rest under gravity in a box: what holds for any packing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

CONTACTS = 3.0
"""Contacts for each sphere, those with walls included, of stiff spheres of unlike sizes.

Each sphere rests on others, so that there are three equations of equilibrium for each: fewer forces
than that cannot satisfy them; more would ask for sizes that fit (Moukarzel 1998; Roux 2000).
"""


def weight(mass: NDArray[np.float64], g: float) -> float:
    """The force on the floor [N]: walls without friction push sideways only."""
    return float(mass.sum() * g)

"""Frictionless spheres at rest under gravity in a box: relations that hold for any packing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

CONTACTS = 3.0
"""The number of contacts per sphere, walls included, of stiff spheres of different sizes.

Each sphere has three equations of equilibrium, which fewer forces cannot satisfy. More contacts
would require special sizes (Moukarzel 1998; Roux 2000).
"""


def weight(mass: NDArray[np.float64], g: float) -> float:
    """The force on the floor [N], the total weight, as frictionless walls only push sideways."""
    return float(mass.sum() * g)

"""A fluid at rest around spheres, with the drag law of Schiller and Naumann."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Fluid:
    """Density [kg/m3] and viscosity [Pa s] of a fluid that spheres do not disturb.

    A sphere of diameter d at a speed v feels the drag 3 pi viscosity d v (1 + 0.15 Re^0.687), Re =
    density d v/viscosity (Schiller and Naumann 1933, for Re up to some 1000). Torques, added mass
    and buoyancy are not included; buoyancy can be given as a load. Raises ValueError naming the
    field, the value and the rule.
    """

    density: float
    viscosity: float

    def __post_init__(self) -> None:
        for name, unit in (("density", "kg/m3"), ("viscosity", "Pa s")):
            value = getattr(self, name)
            if not 0.0 < value < math.inf:
                raise ValueError(f"Fluid.{name} = {value!r} {unit}; it must be positive and finite")

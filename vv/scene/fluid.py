"""A fluid at rest around spheres, which drags them as Schiller and Naumann measured."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Fluid:
    """Density [kg/m3] and viscosity [Pa s] of a fluid that no sphere moves.

    A sphere of diameter d at a speed v is slowed by 3 pi viscosity d v (1 + 0.15 Re^0.687),
    Re = density d v/viscosity (Schiller and Naumann 1933, for Re up to some 1000). Spins, added
    mass and buoyancy are left out: that a sphere weighs less is a load.

    Raises ValueError naming the field, the value and the rule.
    """

    density: float
    viscosity: float

    def __post_init__(self) -> None:
        for name, unit in (("density", "kg/m3"), ("viscosity", "Pa s")):
            value = getattr(self, name)
            if not 0.0 < value < math.inf:
                raise ValueError(f"Fluid.{name} = {value!r} {unit}; it must be positive and finite")

"""Contact of elastic spheres: Hertz along the normal, Mindlin across it, with micro-slip or not."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from vv.scene.arrays import Vector


@dataclass(frozen=True)
class Hertz:
    """Elastic moduli of contacts, in place of springs, and how viscous they are.

    modulus: E [Pa], 1/E = sum of (1 - nu^2)/Young's modulus of both bodies. shear_modulus: G [Pa],
    1/G = sum of (2 - nu)/shear modulus; 0: no tangential stiffness. With R [m], 1/R = sum of
    1/radius (a wall has none), and the overlap U [m]:
    - Fn = max(0, 4/3 E sqrt(R) U^(3/2) + 2 damping sqrt(m kn) U'), kn = 2 E sqrt(R U) the
      stiffness at U and m the reduced mass: restitution does not depend on speed (Tsuji, Tanaka
      and Ishida 1992), and the contact never pulls;
    - the shear force grows by -8 G sqrt(R U) times each increment of slip (Mindlin 1949) and is
      capped at mu Fn, Fn with its viscous part. Surfaces meet in the middle of the overlap;
    - with micro_slip, each place of the contact has a limit of its own: at x = s sqrt(R) of a line
      across it, what has slid since U = s^2 is cut to mu E/(4 G) (U - s^2), and the shear force is
      -8 G sqrt(R) times the integral of that over s, 0 to sqrt(U) (Popov and Hess 2015; it is the
      theory of Cattaneo 1938, Mindlin and Deresiewicz 1953, for any path).

    Raises ValueError naming the field, the value and the rule.
    """

    modulus: float
    shear_modulus: float = 0.0
    damping: float = 0.0
    micro_slip: bool = field(default=False, kw_only=True)

    def __post_init__(self) -> None:
        if not 0 < self.modulus < math.inf:
            raise ValueError(f"Hertz.modulus = {self.modulus!r} Pa; it must be positive and finite")
        for name, unit in (("shear_modulus", " Pa"), ("damping", "")):
            value = getattr(self, name)
            if not 0 <= value < math.inf:
                raise ValueError(f"Hertz.{name} = {value!r}{unit}; it must be zero or more")
        if self.micro_slip and (self.shear_modulus == 0.0 or self.damping > 0.0):
            raise ValueError(
                f"Hertz.micro_slip with shear_modulus = {self.shear_modulus!r} Pa and damping = "
                f"{self.damping!r}; it has a shear modulus and no damping"
            )

    def normal_factor(self, curvature: Vector) -> Vector:
        """K [N/m^1.5] of Fn = K U^(3/2), for the sums of 1/radius [1/m] of contacts."""
        return np.asarray(4.0 / 3.0 * self.modulus / np.sqrt(curvature))

    def shear_factor(self, curvature: Vector) -> Vector:
        """S [N/m^1.5] of the tangential stiffness S sqrt(U)."""
        return np.asarray(8.0 * self.shear_modulus / np.sqrt(curvature))

    def material(self) -> tuple[float, float]:
        """Young's modulus [Pa] and Poisson's ratio of two equal bodies with these moduli.

        6 G/E = 3 (1 - nu)/(2 - nu) gives nu, and E = Young's modulus/(2 (1 - nu^2)) the other.
        Without shear modulus any ratio will do.
        """
        part = 6.0 * self.shear_modulus / self.modulus
        poisson = (3.0 - 2.0 * part) / (3.0 - part) if part else 0.0
        return 2.0 * self.modulus * (1.0 - poisson**2), poisson

    def why_no_material(self) -> str | None:
        """Why no material has these moduli; else None."""
        part = 6.0 * self.shear_modulus / self.modulus
        if part == 0.0 or 1.0 <= part < 2.0:
            return None
        return (
            f"6 G/E = {part:.6g}; this code makes moduli of a material, of which it lies in "
            "[1, 2), as Poisson's ratio lies in (-1, 1/2]"
        )

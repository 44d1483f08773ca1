"""Puts contact of elastic spheres to YADE: materials of which its Mindlin law makes the moduli."""

from __future__ import annotations

import math

from adapters.yade.given import Given
from adapters.yade.setup import Setup
from vv.scene import Hertz

NOTES = (
    "contacts by MindlinPhys, of a material that has their moduli",
    "MindlinPhys gives a wall the radius of the sphere, whose material is therefore stiffer by the "
    "square root of 2 in sum",
    "shear forces grow by increments; on a wall their arm is R - U",
)


def elastic(given: Given, setup: Setup) -> Given:
    """Young's modulus and Poisson's ratio of spheres, and the former of walls.

    YADE takes 1/E and 1/G as sums over both bodies, and the effective radius of a sphere and a
    wall to be R/2.
    """
    law = setup.scene.contact.hertz
    if law is None:
        return given
    young, poisson = material(law)
    stuff = {"young": young, "poisson": poisson, "walls_young": (1.0 + math.sqrt(2.0)) * young}
    return given.with_more(*NOTES, hertz=stuff)


def material(law: Hertz) -> tuple[float, float]:
    """Young's modulus [Pa] and Poisson's ratio of two equal bodies with these effective moduli.

    6 G/E = 3 (1 - nu)/(2 - nu) gives nu, and E = Young's modulus/(2 (1 - nu^2)) the other. Without
    shear modulus any ratio will do.
    """
    part = 6.0 * law.shear_modulus / law.modulus
    poisson = (3.0 - 2.0 * part) / (3.0 - part) if part else 0.0
    return 2.0 * law.modulus * (1.0 - poisson**2), poisson


def why_no_material(law: Hertz | None) -> str | None:
    """Why no material has these moduli; else None."""
    part = 0.0 if law is None else 6.0 * law.shear_modulus / law.modulus
    if law is None or part == 0.0 or 1.0 <= part < 2.0:
        return None
    return (
        f"6 G/E = {part:.6g}; YADE makes moduli of a material, of which it lies in [1, 2), as "
        "Poisson's ratio lies in (-1, 1/2]"
    )

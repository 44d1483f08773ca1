"""The terms, an enum of the physical effects that a scene may contain."""

from __future__ import annotations

import enum


class Term(enum.Enum):
    """A physical effect; a scheme is given only scenes all of whose terms it declares."""

    SPHERE = "spheres"
    SPHERE_CONTACT = "contact between spheres"
    WALL_CONTACT = "contact with a plane wall"
    FRICTION = "shear spring capped by Coulomb friction"
    DRAG = "viscous drag -eta v"
    FLUID = "drag of a fluid by Schiller and Naumann"
    GRAVITY = "gravity"
    LOAD = "dead loads"
    ROTATION = "free rotation"
    OBLIQUE_LOCK = "motion locked along directions oblique to the frame"
    BLOCK = "convex blocks"
    STRAIN = "blocks that strain uniformly"
    STRAINED_START = "blocks that start strained by their loads"
    RIGID_CONTACT = "contact without elasticity"
    SHAKING = "a body acceleration that varies in time"
    PULSE = "a body acceleration that ends"
    BASE_MOTION = "walls that move as prescribed"
    BOND = "bonds between spheres"
    BOND_SHEAR = "bonds that resist shear"
    BREAKAGE = "bonds that break"
    CARRIED = "locked bodies that move steadily"
    CONTACT_VISCOSITY = "contact that is viscous along its normal"
    HERTZ = "contact of elastic spheres by Hertz and Mindlin"
    MICRO_SLIP = "contact of elastic spheres that slips in part"
    HERTZ_VISCOSITY = "contact of elastic spheres that is viscous along its normal"
    VISCOUS_FRICTION = "friction capped by contact that is viscous"

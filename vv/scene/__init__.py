"""What is simulated: frozen data in SI units that checks itself at birth.

May import: base.
"""

from vv.scene.arrays import Mask, Vector
from vv.scene.block import (
    Block,
    Elastic,
    box_geometry,
    face_normal,
    polyhedron_inertia,
    volume_and_centroid,
)
from vv.scene.bodies import Harmonic, Spheres, Wall
from vv.scene.bonds import Bonds, Pairs
from vv.scene.contact import Contact
from vv.scene.energy import Form
from vv.scene.scene import Scene
from vv.scene.terms import Term
from vv.scene.transform import (
    about_z,
    drifting,
    initial_normal_forces,
    released,
    rotated,
    strayed,
    swapped,
    why_not_released,
)

__all__ = [
    "Block",
    "Bonds",
    "Contact",
    "Elastic",
    "Form",
    "Harmonic",
    "Mask",
    "Pairs",
    "Scene",
    "Spheres",
    "Term",
    "Vector",
    "Wall",
    "about_z",
    "box_geometry",
    "drifting",
    "face_normal",
    "initial_normal_forces",
    "polyhedron_inertia",
    "released",
    "rotated",
    "strayed",
    "swapped",
    "volume_and_centroid",
    "why_not_released",
]

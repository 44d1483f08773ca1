"""What is simulated: scenes as frozen data in SI units, checked when they are created.

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
from vv.scene.bodies import Harmonic, Pulse, Spheres, Wall
from vv.scene.bonds import Bonds, Pairs
from vv.scene.contact import Contact
from vv.scene.energy import DISSIPATED, Form, Loss
from vv.scene.fluid import Fluid
from vv.scene.hertz import Hertz
from vv.scene.initial_forces import initial_normal_forces, initial_wall_forces
from vv.scene.scene import Scene
from vv.scene.terms import Term
from vv.scene.transform import (
    in_frame,
    rotated,
    rotation_about_z,
    spheres_held_by_loads,
    why_load_is_no_lock,
    why_locks_need_more_than_loads,
    with_bodies_reversed,
    with_loads_for_locks,
    with_shaking_times,
)

__all__ = [
    "DISSIPATED",
    "Block",
    "Bonds",
    "Contact",
    "Elastic",
    "Fluid",
    "Form",
    "Harmonic",
    "Hertz",
    "Loss",
    "Mask",
    "Pairs",
    "Pulse",
    "Scene",
    "Spheres",
    "Term",
    "Vector",
    "Wall",
    "box_geometry",
    "face_normal",
    "in_frame",
    "initial_normal_forces",
    "initial_wall_forces",
    "polyhedron_inertia",
    "rotated",
    "rotation_about_z",
    "spheres_held_by_loads",
    "volume_and_centroid",
    "why_load_is_no_lock",
    "why_locks_need_more_than_loads",
    "with_bodies_reversed",
    "with_loads_for_locks",
    "with_shaking_times",
]

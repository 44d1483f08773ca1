"""Puts a block to LIGGGHTS as the atoms of a rigid body in place of one sphere."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np

from vv.scene import Block, Scene, Spheres, Wall
from vv.standins.clump import Clump

WEIGHTLESS = 1e-18  # of the block's mass: what its centre and its corners weigh each


def as_atoms(scene: Scene, made: Clump) -> Scene:
    """The scene with its one sphere as atoms: the centre, corners, and points that hold the mass.

    All springs together are those of the sphere. What loads the sphere loads the points.
    """
    count = len(made.corners)
    bodies = tuple(g if isinstance(g, Wall) else _atoms(g, made) for g in scene.bodies)
    law = replace(scene.contact, kn=scene.contact.kn / count, ks=scene.contact.ks / count)
    return replace(scene, bodies=bodies, contact=law)


def _atoms(sphere: Spheres | Block, made: Clump) -> Spheres:
    assert isinstance(sphere, Spheres)
    corners, points = len(made.corners), len(made.points)
    atoms = 1 + corners + points
    mass = np.full(atoms, float(sphere.mass[0]) / points)
    mass[: 1 + corners] = WEIGHTLESS * sphere.mass[0]
    radius = np.full(atoms, 1e-3 * made.radius)
    radius[1 : 1 + corners] = made.radius
    load = np.zeros((atoms, 3))
    load[1 + corners :] = sphere.load / points
    alike = {field.name: getattr(sphere, field.name).repeat(atoms, 0) for field in fields(sphere)}
    places = np.vstack([sphere.position, made.corners, made.points])
    own = {"position": places, "radius": radius, "mass": mass, "load": load}
    by_default = dict.fromkeys(("inertia", "spin", "free_spin"))  # the body's own, not an atom's
    return replace(sphere, **{**alike, **own, **by_default})

"""Puts a block to LIGGGHTS as the atoms of a rigid body in place of one sphere."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from vv.scene import Block, Contact, Scene, Spheres, Wall
from vv.standins.clump import Clump

WEIGHTLESS = 1e-18  # of the block's mass: what its centre and its corners weigh each


def as_atoms(scene: Scene, made: Clump) -> Scene:
    """The scene with its one sphere as atoms: the centre, corners, and points that hold the mass.

    All springs together are those of the sphere. What loads the sphere loads the points.
    """
    count = len(made.corners)
    bodies = tuple(g if isinstance(g, Wall) else _atoms(g, made) for g in scene.bodies)
    law = scene.contact
    return replace(scene, bodies=bodies, contact=Contact(law.kn / count, law.ks / count, law.mu))


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
    return Spheres(
        position=np.vstack([sphere.position, made.corners, made.points]),
        velocity=np.repeat(sphere.velocity, atoms, axis=0),
        radius=radius,
        mass=mass,
        free=np.repeat(sphere.free, atoms, axis=0),
        load=load,
    )


def rigid_commands(scene: Scene, block: Block) -> Iterator[str]:
    """The commands that move all atoms as one body, in the freedoms it has."""
    free, free_spin = (
        " ".join("on" if loose else "off" for loose in mask)
        for mask in (scene.spheres.free[0], block.free_spin)
    )
    yield f"fix body all rigid single force 1 {free} torque 1 {free_spin}"

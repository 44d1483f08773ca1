"""Translates blocks for LIGGGHTS into atoms of rigid bodies, in place of spheres."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields, replace

import numpy as np

from vv.scene import Scene, Spheres
from vv.standins.clump import Clump

WEIGHTLESS = 1e-18  # relative to a block's mass: masses of its centre and of each corner


def as_atoms(scene: Scene, made: Sequence[Clump]) -> Scene:
    """The scene with its spheres as atoms: all centres, then each block's corners and points.

    All springs of a block together are as stiff as those of its sphere. The points hold the mass
    and carry the loads.
    """
    count = len(made[0].corners)
    law = replace(scene.contact, kn=scene.contact.kn / count, ks=scene.contact.ks / count)
    spheres = scene.spheres
    parts = [_atoms(spheres.part(slice(i, i + 1)), one) for i, one in enumerate(made)]
    centres = [atoms.part(slice(0, 1)) for atoms in parts]
    rest = [atoms.part(slice(1, None)) for atoms in parts]
    return replace(scene, bodies=(*scene.walls, *centres, *rest), contact=law)


def members(made: Sequence[Clump]) -> list[list[int]]:
    """The indices of each block's atoms among those of `as_atoms`."""
    sizes = [len(one.corners) + len(one.points) for one in made]
    ends = len(made) + np.cumsum(sizes)
    return [
        [i, *range(int(end) - size, int(end))]
        for i, (size, end) in enumerate(zip(sizes, ends, strict=True))
    ]


def _atoms(sphere: Spheres, made: Clump) -> Spheres:
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
    by_default = dict.fromkeys(("inertia", "spin", "free_spin"))  # of the body, not of an atom
    return replace(sphere, **{**alike, **own, **by_default})

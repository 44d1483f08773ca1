"""Replaces bonds by contacts of spheres that overlap from the start, held apart by loads.

This build of LIGGGHTS has no bond with a normal and a shear spring. Two spheres that overlap by a
small part of their distance, with friction that never slips, have both springs as long as they stay
in contact; dead loads cancel the contact forces at t = 0. As a bond rotates, these forces rotate
with it but the loads do not, which causes errors of about the pre-overlap in E and 1.4 times that
in nu.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from vv.scene import Bonds, Scene, Term, initial_normal_forces

OVERLAP = 1e-4  # relative to the length of a bond
STICKING = 1e9  # friction coefficient that no force reaches
ALIKE = 1e-9  # relative difference up to which bonds count as alike
USED = 0.5  # the part of the overlap that a stretch may use up
APART = 1.01  # in bond lengths: the least distance of spheres without a bond
NO_STRENGTH = {
    Term.BREAKAGE: (
        "contacts represent bonds: they open when the overlap is used up, and never slip"
    ),
}


def overlapped(scene: Scene) -> Scene:
    """The scene, spheres alone, with bonds as contacts; `why_not_overlapped` must not object."""
    assert scene.bonds is not None
    radius = float(scene.bonds.length[0]) * (1 + OVERLAP) / 2
    kn, ks = float(scene.bonds.kn[0]), float(scene.bonds.ks[0])
    law = replace(scene.contact, kn=kn, ks=ks, mu=STICKING)
    spheres = replace(scene.spheres, radius=np.full(len(scene.spheres), radius))
    touching = replace(scene, bodies=(spheres,), contact=law, bonds=None)
    held = replace(spheres, load=spheres.load - initial_normal_forces(touching))
    return replace(touching, bodies=(held,))


def why_not_overlapped(scene: Scene) -> str | None:
    """Why contacts cannot stand in for the bonds of a scene; None if they can."""
    bonds, place = scene.bonds, scene.spheres.position
    if bonds is None:
        return "the scene has no bonds that overlaps could represent"
    i, j = scene.bonded_pairs.T
    distance = np.linalg.norm(place[j] - place[i], axis=1)
    for name, values in (("kn", bonds.kn), ("ks", bonds.ks), ("length", bonds.length)):
        if np.ptp(values) > ALIKE * values[0]:
            return f"bonds differ in {name}; contacts of all spheres have the same"
    if np.abs(distance / bonds.length - 1).max() > ALIKE:
        return (
            "a bond has a force at t = 0, and contacts that represent bonds must all overlap alike"
        )
    return _crowded(scene, bonds) or _stretched(scene, bonds)


def _crowded(scene: Scene, bonds: Bonds) -> str | None:
    place = scene.spheres.position
    apart = np.linalg.norm(place[:, None] - place[None], axis=2)
    near = int(np.triu(apart < APART * bonds.length[0], 1).sum())
    if near > len(bonds):
        return "spheres without a bond are as close as bonded ones; they would stick together too"
    return None


def _stretched(scene: Scene, bonds: Bonds) -> str | None:
    """Why bonds may stretch too far, by a bound for all loads applied suddenly and all motion."""
    spheres, kn = scene.spheres, float(bonds.kn[0])
    weight = spheres.mass[:, None] * scene.gravity + spheres.load
    energy = float(spheres.mass @ (spheres.velocity**2).sum(axis=1)) / 2
    most = 2 * float(np.linalg.norm(weight, axis=1).sum()) / kn + np.sqrt(2 * energy / kn)
    allowed = USED * OVERLAP * float(bonds.length[0])
    if most > allowed:
        return (
            f"bonds may stretch by {most:.3g} m, and contacts that overlap by {OVERLAP:g} of "
            f"their length represent bonds up to {allowed:.3g} m"
        )
    return None

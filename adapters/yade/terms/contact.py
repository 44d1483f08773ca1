"""Translates friction, damping and the initial shear forces of contacts for YADE."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from adapters.yade.given import Given, Plan
from adapters.yade.setup import LEAST_GAP, POLYHEDRA, Setup
from vv.scene import Scene, Spheres, Vector, Wall
from vv.scene.initial_forces import unbonded
from vv.scene.neighbours import overlapping


def friction(given: Given, setup: Setup) -> Given:
    """A shear spring; spheres in contact start at rest, so that its first step has no shear.

    In YADE, shear would otherwise be ahead by one step. An impulse in the first step gives these
    spheres the momentum that they would have had, drag included.
    """
    notes = ["shear increments without YADE's corrections against ratcheting"]
    if setup.contacts:
        notes.append(
            "touching spheres start at rest and get their velocity as an impulse in the first step"
        )
    rubbing = given.with_more(*notes, ks=float(setup.scene.contact.ks))
    return replace(rubbing, pushed=given.pushed | setup.touching)


def viscosity(given: Given, setup: Setup) -> Given:
    """A dashpot along the normal of contacts; in the first step it acts on spheres in contact."""
    note = "viscous contacts by ViscElMat, which never pull, from the velocity half a step ago"
    force = initial_viscous_forces(setup.scene)
    return given.with_more(note, force=force, eta_n=float(setup.scene.contact.eta_n))


def viscous_friction(given: Given, setup: Setup) -> Given:
    """Spheres on which a dashpot acts at t = 0 start at rest too, even if they just touch.

    Otherwise their shear springs would include the slip of the step before t = 0. The dashpot has
    no force on a sphere at rest; the missing force is added to the impulse.
    """
    missed = initial_viscous_forces(setup.scene)
    return replace(given, pushed=given.pushed | missed.any(axis=1), missed=missed)


def initial_viscous_forces(scene: Scene) -> Vector:
    """The (n, 3) forces [N] of dashpots on the spheres at t = 0, without those of springs.

    The contact force is max(0, kn U + eta_n U'). Spheres that touch without overlap count where
    YADE creates a contact: a sphere on a wall, and two spheres whose gap is zero after rounding.
    Walls move only after YADE's first step.
    """
    spheres, force = scene.spheres, np.zeros((len(scene.spheres), 3))
    for wall in scene.walls:
        depth = spheres.radius - (spheres.position - wall.point) @ wall.normal
        push = _damping(scene, depth, -(spheres.velocity @ wall.normal))
        force += np.where(depth >= 0, push, 0.0)[:, None] * wall.normal
    i, j = unbonded(scene, overlapping(spheres, -LEAST_GAP)).T
    offset, reach = spheres.position[j] - spheres.position[i], spheres.radius[i] + spheres.radius[j]
    squared = np.einsum("ij,ij->i", offset, offset)
    distance = np.sqrt(squared)
    normal = offset / distance[:, None]
    closing = np.einsum("ij,ij->i", spheres.velocity[i] - spheres.velocity[j], normal)
    push = np.where(squared <= reach**2, _damping(scene, reach - distance, closing), 0.0)
    np.add.at(force, j, push[:, None] * normal)
    np.add.at(force, i, -push[:, None] * normal)
    return force


def _damping(scene: Scene, depth: Vector, closing: Vector) -> Vector:
    """The viscous force [N] of contacts, (k,), from their overlap [m] and its rate [m/s]."""
    elastic = scene.contact.kn * np.maximum(depth, 0.0)
    return np.asarray(np.maximum(scene.contact.eta_n * closing, -elastic))


def charged(given: Given, setup: Setup) -> Given:
    """The friction [N] of each wall on a sphere that is in its shear spring at t = 0."""
    charges, springs = setup.springs.charged, setup.springs.scene
    if charges is None or not charges.any():
        return given
    wall, spheres = springs.body_numbers(Wall)[0], springs.body_numbers(Spheres)
    contacts: list[Plan] = [
        {"wall": wall, "body": sphere, "forces": [force.tolist()]}
        for sphere, force in zip(spheres, charges, strict=True)
        if force.any()
    ]
    note = (
        "the shear spring charged by the velocity of the first step"
        if setup.scheme == POLYHEDRA
        else "the friction at t = 0 put into the shear spring of a contact made before the first "
        "step"
    )
    return given.with_more(note, charged=contacts)

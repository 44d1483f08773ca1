"""Puts to YADE what contacts do besides pressing: rub, damp, and start charged."""

from __future__ import annotations

from dataclasses import replace

from adapters.yade.given import Given, Plan
from adapters.yade.setup import POLYHEDRA, Setup
from vv.scene import Spheres, Wall


def friction(given: Given, setup: Setup) -> Given:
    """A shear spring, and no velocity that a contact would meet in YADE's first step.

    Shear would run one step ahead: what touches starts at rest, and a push gives it in that step
    the momentum, and the drag, that it would have had.
    """
    notes = ["shear increments without YADE's corrections against ratcheting"]
    if setup.contacts:
        notes.append(
            "touching spheres start at rest and get their velocity as an impulse in the first step"
        )
    rubbing = given.with_more(*notes, ks=float(setup.scene.contact.ks))
    return replace(rubbing, pushed=given.pushed | setup.touching)


def viscosity(given: Given, setup: Setup) -> Given:
    """A dashpot along the normal of contacts."""
    note = "viscous contacts by ViscElMat, which never pull, from the velocity half a step ago"
    return given.with_more(note, eta_n=float(setup.scene.contact.eta_n))


def charged(given: Given, setup: Setup) -> Given:
    """The friction [N] of each wall on a sphere that its shear spring holds at the start."""
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

"""Writes a setup as input of the driver inside YADE: plain data in YADE's terms."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from adapters.yade.clumps import clumped
from adapters.yade.given import Given, Plan
from adapters.yade.polyhedra import polyhedral
from adapters.yade.setup import POLYHEDRA, Setup
from adapters.yade.terms.table import translated
from adapters.yade.terms.walls import facet_size, wall_body
from vv.scene import Spheres, Vector, Wall
from vv.standins.clump import words


def plan(setup: Setup) -> Plan:
    """The driver's ask: numbers, lists and strings only, in SI units."""
    given = translated(setup)
    whole = {**given.numbers, "bodies": _bodies(setup, given)}
    if setup.clumps:
        return clumped(whole, setup.clumps)
    if setup.scheme == POLYHEDRA:
        return polyhedral(whole, setup.ask.scene, setup.springs.charged)
    return whole


def notes(setup: Setup) -> list[str]:
    """How the scene is represented, one statement each."""
    stand_in = setup.springs.notes
    if setup.clumps:
        stand_in = words(setup.clumps, "a clump"), *stand_in[1:]
    if setup.scheme == POLYHEDRA:
        polyhedron = (
            "the block is a polyhedron, in a frame whose z is the wall's normal; its normal force "
            "is the volume of its overlap times kn over the area of its face"
        )
        stand_in = polyhedron, *stand_in[1:]
    return [*stand_in, *translated(setup).notes]


def _columns(setup: Setup, given: Given) -> dict[str, Vector]:
    """The data of spheres, one row per sphere.

    Leapfrog velocities are those at -dt/2: v = v0 - a0 dt/2. A sphere that gets an impulse starts
    at rest.
    """
    scene, dt, spheres = setup.scene, setup.ask.dt, setup.scene.spheres
    charged = setup.springs.charged
    force = given.force if charged is None else given.force + charged
    early = spheres.velocity - force / spheres.mass[:, None] * (dt / 2)
    early = np.where(spheres.free, early, 0.0)
    pushed = given.pushed[:, None]
    return {
        "position": spheres.position,
        "initial": spheres.velocity,
        "velocity": np.where(pushed, 0.0, early + given.carried),
        "spin": np.where(pushed, 0.0, spheres.spin),
        "radius": spheres.radius,
        "mass": given.mass,
        "inertia": spheres.inertia,
        "shaken": spheres.mass,
        "force": given.load,
        "push": np.where(
            pushed, (given.mass[:, None] / dt - scene.eta) * early + given.missed, 0.0
        ),
        "carried": given.carried,
        "held": np.where(pushed, 0.0, given.carried),
        "twist": np.where(pushed, spheres.inertia[:, None] * spheres.spin / dt, 0.0),
    }


def _bodies(setup: Setup, given: Given) -> list[Plan]:
    """All bodies in the order of the scene, which becomes that of YADE's ids."""
    size, spheres, bodies, walls = facet_size(setup), _spheres(setup, given), list[Plan](), 0
    for group in setup.scene.bodies:
        if isinstance(group, Wall):
            bodies.append(wall_body(group, size) | {"motion": given.motion.get(walls, [])})
            walls += 1
        elif isinstance(group, Spheres):
            bodies += [next(spheres) for _ in range(len(group))]
    return bodies


def _spheres(setup: Setup, given: Given) -> Iterator[Plan]:
    """The bodies of all spheres, in their order."""
    spheres, columns = setup.scene.spheres, _columns(setup, given)
    free = np.hstack([spheres.free, spheres.free_spin]).tolist()
    rows = zip(*(column.tolist() for column in columns.values()), strict=True)
    for row, loose in zip(rows, free, strict=True):
        blocked = "".join(name for name, one in zip("xyzXYZ", loose, strict=True) if not one)
        numbers = dict(zip(columns, row, strict=True))
        yield {"kind": "sphere", **numbers, "blocked": blocked}

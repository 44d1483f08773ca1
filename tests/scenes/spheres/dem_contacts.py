"""Single contacts for the tests of the DEM engine: their errors, and T1 with all freedoms on."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator

import numpy as np

from cases.contact.single_contact import CASE
from vv.ask import Ask, Run
from vv.case import Series
from vv.engines.dem import PreparedSpheres
from vv.scene import Contact, Harmonic, Scene, Vector, Wall

VARIANTS = [variant.name for variant in CASE.variants]
PLAIN = ["T1", "T2", "T3", "T4"]
STEPS = (4e-3, 2e-3, 1e-3, 5e-4, 1e-4, 1e-5)


def series(variant: str) -> Series:
    quantity = CASE.declare(variant, CASE.defaults(variant)).quantities[0]
    assert isinstance(quantity, Series)
    return quantity


def displacement(variant: str, run: Run) -> Vector:
    return series(variant).observe(run)


def error(variant: str, run: Run) -> float:
    """max|e| / max|y| against the closed form."""
    reference = series(variant).reference
    assert reference is not None
    exact = reference(run.times)
    return float(np.abs(displacement(variant, run) - exact).max() / np.abs(exact).max())


def forced(ask: Ask) -> Ask:
    """T1 with every freedom of particle 2 and every term, made too small to be felt."""
    spheres = ask.scene.spheres
    moves = spheres.free.any(axis=1, keepdims=True) & np.ones(3, bool)
    load = np.full((len(spheres), 3), 1e-100)
    weak = Harmonic(np.full(3, 1e-100), np.ones(3))
    bodies = (
        dataclasses.replace(spheres, free=moves, free_spin=moves, load=load),
        Wall(np.array([0.0, -1e9, 0.0]), np.array([0.0, 1.0, 0.0]), weak),
    )
    contact = Contact(ask.scene.contact.kn, ks=1e9, mu=0.5)
    gravity = np.full(3, 1e-100)
    scene = Scene(bodies, contact, eta=1e-100, gravity=gravity, shaking=weak)
    return dataclasses.replace(ask, scene=scene)


def unknowns_passed(program: PreparedSpheres) -> int:
    """How many unknowns the kernel of a program is passed, also within tuples."""

    def flat(arguments: tuple[object, ...]) -> Iterator[object]:
        for one in arguments:
            yield from flat(one) if isinstance(one, tuple) else (one,)

    passed = [*flat(program.arguments)]
    return sum(a.size for a in program.system.unknowns if any(one is a for one in passed))

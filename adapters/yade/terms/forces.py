"""Translates constant forces, drag and steady motion of spheres for YADE."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from adapters.yade.given import Given
from adapters.yade.setup import Setup


def gravity(given: Given, setup: Setup) -> Given:
    """The weight as an acceleration of all bodies."""
    scene = setup.scene
    weight = scene.spheres.mass[:, None] * scene.gravity
    return given.with_more(force=weight, gravity=scene.gravity.tolist())


def dead_loads(given: Given, setup: Setup) -> Given:
    """Constant forces."""
    load = setup.scene.spheres.load
    return replace(given.with_more(force=load), load=given.load + load)


def drag(given: Given, setup: Setup) -> Given:
    """The force -eta v; where the scheme adds to the masses, the weight becomes a dead load."""
    scene, notes = setup.scene, ["drag by LinearDragEngine from the velocity half a step ago"]
    dragged = given.with_more(
        *notes, force=-(scene.eta * scene.spheres.velocity), drag=float(scene.eta)
    )
    if not setup.extra:
        return dragged
    heavier = dragged.with_more(
        "masses are m + eta dt/2, weight a dead load", gravity=[0.0, 0.0, 0.0]
    )
    weight = scene.spheres.mass[:, None] * scene.gravity
    return replace(heavier, mass=given.mass + setup.extra, load=given.load + weight)


def oblique_locks(given: Given, setup: Setup) -> Given:
    """Dead loads in place of locks (`with_loads_for_locks`); YADE locks axes of its frame."""
    if np.array_equal(setup.scene.spheres.load, setup.springs.scene.spheres.load):
        return given
    return given.with_more("a dead load along the normal instead of a locked axis")


def carried(given: Given, setup: Setup) -> Given:
    """The velocities that bodies keep along their locks."""
    note = "locked bodies keep a steady velocity in YADE, from the end of the first step"
    return replace(given.with_more(note), carried=setup.scene.locked_velocity)

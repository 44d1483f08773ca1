"""LMGC90 as a code of the framework: rigid blocks in contact dynamics, face to face."""

from __future__ import annotations

import itertools
from operator import attrgetter
from pathlib import Path
from typing import Any

import numpy as np

from adapters.lmgc90.refusals import density, near, refusal
from vv.ask import Ask, Displacement, Method, Velocity
from vv.codes import Scheme
from vv.codes.driver_adapter import DriverAdapter
from vv.codes.own_python import Driver, PythonEnvironment
from vv.scene import Scene
from vv.standins.boxed import BOXED, boxed

DEFAULT = Scheme(
    "default",
    "contact dynamics of Jean and Moreau by a theta method, theta = 1/2; contact laws at the end "
    "of the step, solved by Gauss-Seidel sweeps to LMGC90's own tolerance",
    Method.FIRST_ORDER,
    BOXED,
    observables=frozenset({Displacement, Velocity}),
    pace=(1e-5, 2e-5),
)
DRIVER = Driver(
    PythonEnvironment("lmgc90", ("compas_lmgc90",)), Path(__file__).with_name("driver.py")
)
NOTHING = 1e-12  # relative to the largest load: less is rounding
NOTES = (
    "polyhedra in contact dynamics, contact points found between faces",
    "each wall a box with its velocity prescribed",
    "gravity and loads as forces besides LMGC90's own 9.81 m/s2 along -z of the scene's axes",
    "moving bodies get their velocity by a force in the first step, and start v dt/2 ahead",
    "rotations of a plane scene left free, as are locks of separate blocks on which no force acts",
)


def _plan(ask: Ask) -> dict[str, Any]:
    """The plan with the density of all blocks, and the axes along which locks are needed."""
    return {**boxed(ask), "density": density(ask.scene), "held": _held(ask.scene)}


def _held(scene: Scene) -> list[bool]:
    """The axes along which locks are needed: those of weight, loads or shaking; in piles, all.

    A pile of blocks that is free across its plane slowly moves out of it.
    """
    if any(near(one, other) for one, other in itertools.combinations(scene.blocks, 2)):
        return [True] * 3
    drives = [scene.wave, *(wall.motion for wall in scene.walls)]
    forces = [scene.gravity, *(block.load / block.mass for block in scene.blocks)]
    forces += [sine[0] for drive in drives if drive for sine in drive.sines()]
    along = np.abs(np.array(forces) @ scene.axes.T)
    return [bool(part > NOTHING) for part in (along.max(axis=0) / along.max())]


ADAPTER = DriverAdapter(
    DEFAULT,
    DRIVER,
    NOTES,
    refusal=refusal,
    plan=_plan,
    frame=attrgetter("scene.axes"),
)

"""Says in words how LIGGGHTS represents a scene."""

from __future__ import annotations

import numpy as np

from adapters.liggghts.bonds import OVERLAP
from adapters.liggghts.translate import (
    CLUMP,
    HALF_STEP,
    OVERLAPPED,
    PLAIN,
    charges,
    moving,
    represented,
    spinning,
)
from adapters.liggghts.walls import is_mesh
from vv.ask import Ask
from vv.standins.clump import clump
from vv.standins.stand_in import stood_for


def notes(ask: Ask, scheme: str) -> list[str]:
    """How the scene is represented, one fact each."""
    stood, rigid, leaning = stood_for(ask), scheme == CLUMP, scheme == OVERLAPPED
    scene = represented(ask, scheme if leaning else PLAIN)
    turning, moved = spinning(scene.spheres), moving(scene.spheres)
    said = {
        "pair gran, hooke/stiffness: kn is the contact's stiffness, nothing is damped": (
            scene.bonds is None and not scene.contact.eta_n > 0
        ),
        "pair gran, hooke/stiffness with absolute damping from the velocity half a step ago, its "
        "force limited to what pushes": scene.contact.eta_n > 0,
        "bond_style harmonic, which has no shear spring, of the coefficient kn/2; no pair_style": (
            scene.bonds is not None
        ),
        "fix rigid: one body in six freedoms, those locked without force or torque": rigid,
        "fix nve: all three translations, no rotation": (
            bool((moved & ~turning).any()) and not rigid
        ),
        "fix nve/sphere for spheres that turn, with the inertia 2/5 m r2": bool(turning.any()),
        "a locked axis is a force of zero on it (fix setforce)": (
            not scene.spheres.free[moved].all() and not rigid
        ),
        "spheres without any freedom are not integrated": not moved.all(),
        "shear springs of model history, without tangential damping": scene.contact.carries_shear,
        "drag by fix viscous from the velocity half a step ago": scene.eta > 0,
        "masses are m + eta dt/2, weight a dead load": scheme == HALF_STEP and scene.eta > 0,
        "a mesh wall, one triangle far larger than the scene, instead of a primitive one": (
            any(is_mesh(wall) for wall in scene.walls)
        ),
        "a dead load along the normal instead of a locked axis": (
            not np.array_equal(scene.spheres.load, stood.scene.spheres.load) and not leaning
        ),
        f"bonds as contacts that overlap by {OVERLAP:g} of their length at t = 0, when dead loads "
        "cancel their push: a surrogate, right to about that part in E": leaning,
        "shear springs charged by a step, before t = 0, that slides the sphere to its start": (
            bool(charges(ask, scheme))
        ),
        "body accelerations by fix addforce at the time of the positions": (
            scene.shaking is not None
        ),
        "meshes moved by fix move/mesh, with each step's mean velocity": (
            any(wall.motion for wall in scene.walls)
        ),
    }
    how = stood.notes
    if rigid:
        how = f"a rigid body stands for the block: {clump(ask).words}", *stood.notes[1:]
    return [*how, *(note for note, holds in said.items() if holds)]

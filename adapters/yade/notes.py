"""Says in words how YADE represents a scene."""

from __future__ import annotations

import numpy as np

from adapters.yade.bonds import sheared
from adapters.yade.translate import CLUMP, HALF_STEP, POLYHEDRA, initial_contacts, put
from vv.ask import Ask, Reaction
from vv.scene import Term, with_loads_for_locks
from vv.standins.clump import clump
from vv.standins.stand_in import stood_for


def notes(ask: Ask, scheme: str) -> list[str]:
    """How the scene is represented, one fact each."""
    stood = stood_for(put(ask, scheme)[0])
    scene = with_loads_for_locks(stood.scene)
    loaded = not np.array_equal(scene.spheres.load, stood.scene.spheres.load)
    charged = stood.charged is not None and bool(stood.charged.any())
    oblique = [wall for wall in scene.walls if np.abs(wall.normal).max() < 1.0]
    said = {
        "NewtonIntegrator without damping, velocities started at -dt/2": True,
        "every step an O.step(); O.run costs as much and rounds wall time up to 40 ms": True,
        "shear increments without YADE's corrections against ratcheting": (
            scene.contact.carries_shear
        ),
        "touching spheres start at rest and get their velocity as an impulse in the first step": (
            scene.contact.carries_shear and bool(initial_contacts(scene)[1])
        ),
        "bonds are contacts of CohFrictMat, made before the first step, brittle where they break": (
            scene.bonds is not None
        ),
        "locked bodies that move do so by YADE's own keeping, from the end of the first step": (
            Term.CARRIED in scene.terms()
        ),
        "reactions from the forces of one step more": (
            any(isinstance(what, Reaction) for what in ask.observables)
        ),
        "spheres on a bond that resists shear likewise start by an impulse": (
            bool(sheared(scene).any()) and bool(scene.spheres.velocity.any())
        ),
        "viscous contacts by ViscElMat, which never pull, from the velocity half a step ago": (
            scene.contact.eta_n > 0
        ),
        "drag by LinearDragEngine from the velocity half a step ago": scene.eta > 0,
        "masses are m + eta dt/2, weight a dead load": scheme == HALF_STEP and scene.eta > 0,
        "walls across an axis are YADE walls": len(scene.walls) > len(oblique),
        "oblique walls are facets far larger than the scene": bool(oblique),
        "a dead load along the normal instead of a locked axis": loaded,
        "the friction at t = 0 put into the shear spring of a contact made before the first step": (
            charged and scheme != POLYHEDRA
        ),
        "the shear spring charged by the velocity of the first step": (
            charged and scheme == POLYHEDRA
        ),
        "body accelerations by HarmonicForceEngine at the time of the positions": (
            scene.shaking is not None
        ),
        "walls driven by HarmonicMotionEngine, its velocity that which meets u after each step": (
            any(wall.motion for wall in scene.walls)
        ),
    }
    block = {CLUMP: _clump_note, POLYHEDRA: _polyhedron_note}.get(scheme)
    how = [block(ask), *stood.notes[1:]] if block else stood.notes
    return [*how, *(note for note, holds in said.items() if holds)]


def _clump_note(ask: Ask) -> str:
    return f"a clump stands for the block: {clump(ask).words}"


def _polyhedron_note(ask: Ask) -> str:
    return (
        "the block is a polyhedron, in a frame whose z is the wall's normal; the volume of its "
        "overlap presses by kn over the area of its face"
    )

"""YADE as a code of the framework: refuses, describes, exports and runs asks."""

from __future__ import annotations

import json
import pprint
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from adapters.yade.answers import parse
from adapters.yade.bonds import sheared, why_no_bonds
from adapters.yade.inside import script
from adapters.yade.installed import PYTHON, find
from adapters.yade.polyhedra import why_no_polyhedron
from adapters.yade.translate import (
    CLUMP,
    HALF_STEP,
    PLAIN,
    POLYHEDRA,
    initial_contacts,
    plan,
    put,
)
from vv import external
from vv.adapter import Found, Scheme, behind_wall, no_sphere
from vv.ask import Ask, Displacement, Method, Model, Reaction, Run, Status, Velocity
from vv.clump import clump, why_no_clump
from vv.scene import Scene, Term
from vv.stand_in import STANDS_IN, stood_for, why_not
from vv.transform import released, why_not_released

TERMS = frozenset(
    {
        Term.SPHERE,
        Term.SPHERE_CONTACT,
        Term.WALL_CONTACT,
        Term.FRICTION,
        Term.DRAG,
        Term.GRAVITY,
        Term.LOAD,
        Term.ROTATION,
        Term.OBLIQUE_LOCK,
        Term.SHAKING,
        Term.BASE_MOTION,
        Term.BOND,
        Term.BOND_SHEAR,
        Term.BREAKAGE,
        Term.CARRIED,
    }
)
DASHPOTS = {Term.CONTACT_VISCOSITY}
BONDED = {Term.BOND, Term.BOND_SHEAR, Term.BREAKAGE}
ONLY_SPHERES = {Term.SPHERE, Term.SPHERE_CONTACT, Term.DRAG, Term.CARRIED} | BONDED
ONE_BLOCK = (TERMS | STANDS_IN) - ONLY_SPHERES
KNOBS = ("dt", "kn")
OBSERVABLES = frozenset({Displacement, Velocity, Reaction})
SCHEMES = (
    Scheme(
        PLAIN,
        "leapfrog with the scene's masses; drag is taken from the velocity half a step ago",
        Method.SECOND_ORDER,
        TERMS | STANDS_IN | DASHPOTS,
        KNOBS,
        lowered={
            Term.RIGID_CONTACT: Method.PENALTY,
            Term.CONTACT_VISCOSITY: Method.FIRST_ORDER,
        },
        observables=OBSERVABLES,
        pace=3e-6,
    ),
    Scheme(
        HALF_STEP,
        "leapfrog with masses m + eta dt/2, which makes drag that of the mean velocity",
        Method.SECOND_ORDER,
        TERMS,
        observables=OBSERVABLES,
        pace=3e-6,
    ),
    Scheme(
        CLUMP,
        "a block as a clump, which stands on a sphere at each corner of its face",
        Method.PENALTY,
        ONE_BLOCK,
        KNOBS,
        pace=5e-6,
    ),
    Scheme(
        POLYHEDRA,
        "a block as a polyhedron, which the volume of its overlap presses; slow, for short runs",
        Method.PENALTY,
        ONE_BLOCK,
        KNOBS,
        pace=1e-4,
    ),
)


class Yade:
    """The adapter; it holds no state."""

    name = "yade"
    schemes = SCHEMES

    def found(self) -> Found:
        """Look for the package's folder."""
        return find()

    def refuses(self, ask: Ask, scheme: str) -> str | None:
        """What YADE cannot represent though it has every term."""
        reason = REASONS.get(scheme, why_not)(ask)
        if reason is not None:
            return reason
        scene = stood_for(put(ask, scheme)[0]).scene
        return (
            no_sphere(ask, scene)
            or _locked_spin(scene)
            or why_not_released(scene)
            or _oblique_spin_lock(ask.scene)
            or behind_wall(scene)
            or why_no_bonds(scene)
            or _oblique_reaction(ask)
        )

    def describe(self, ask: Ask, scheme: str) -> Model:
        """The freedoms YADE integrates, and how the scene is put to it."""
        scene = released(stood_for(put(ask, scheme)[0]).scene)
        turning = sum(int(block.free_spin.sum()) for block in ask.scene.blocks)
        terms = ask.scene.terms() | scene.terms()
        return Model(scene.unknowns() + turning, terms, "; ".join(_notes(ask, scheme)))

    def native(self, ask: Ask, scheme: str) -> str:
        """A script for `yade -n -x` or the system's python3: the program with the ask filled in."""
        notes = "".join(f"# {note}\n" for note in _notes(ask, scheme))
        literal = pprint.pformat(plan(put(ask, scheme)[0], scheme), width=99, sort_dicts=False)
        return script(f"{notes}ASK: dict[str, Any] | None = {literal}\n")

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """Run all asks in one YADE process; see vv.external for what happens if it dies."""
        here = find()
        if not here.installed:
            yield from [Run(Status.NOT_INSTALLED, here.how_to_install)] * len(asks)
            return
        files = [scratch / f"ask-{number}.json" for number in range(len(asks))]
        source = scratch / "in-yade.py"
        source.write_text(script())
        framed = [put(ask, scheme) for ask in asks]
        models = [self.describe(ask, scheme) for ask in asks]
        for file, (ask, _) in zip(files, framed, strict=True):
            file.write_text(json.dumps({**plan(ask, scheme), "repeat": repeat}))

        def launch(indices: Sequence[int]) -> external.Program:
            # -E: variables meant for our own Python must not reach this one
            command = [str(PYTHON), "-E", str(source), *(str(files[i]) for i in indices)]
            return external.start(command, scratch, {"VV_YADE": here.path})

        def collect(index: int, program: external.Program) -> Run | None:
            return parse(files[index], *framed[index], models[index], program.started)

        yield from external.run_batch(len(asks), launch, collect)


def _locked_spin(scene: Scene) -> str | None:
    """Why a body that turns about what it is locked in is refused: YADE keeps it going."""
    about = np.where(scene.spheres.free_spin, 0.0, scene.spheres.spin @ scene.axes.T)
    if about.any():
        return "a sphere has a spin in a locked freedom, which YADE would maintain"
    return None


def _oblique_spin_lock(scene: Scene) -> str | None:
    masks = [*scene.spheres.free_spin, *(block.free_spin for block in scene.blocks)]
    partly = any(free.any() and not free.all() for free in masks)
    if partly and not np.array_equal(scene.axes, np.eye(3)):
        return "rotation is locked about some axes of a turned frame; YADE locks its own axes only"
    return None


def _oblique_reaction(ask: Ask) -> str | None:
    if Term.OBLIQUE_LOCK in ask.scene.terms() and any(
        isinstance(seen, Reaction) for seen in ask.observables
    ):
        return "a reaction to oblique locks, for which dead loads stand, is not known"
    return None


def _notes(ask: Ask, scheme: str) -> list[str]:
    """How the scene is represented, one fact each."""
    stood = stood_for(put(ask, scheme)[0])
    scene = released(stood.scene)
    loaded = not np.array_equal(scene.spheres.load, stood.scene.spheres.load)
    charged = stood.charged is not None and bool(stood.charged.any())
    oblique = [wall for wall in scene.walls if np.abs(wall.normal).max() < 1.0]
    said = {
        "NewtonIntegrator without damping, velocities started at -dt/2": True,
        "every step an O.step(); O.run costs as much and rounds wall time up to 40 ms": True,
        "shear increments without YADE's corrections against ratcheting": scene.contact.rubs,
        "touching spheres start at rest and get their velocity as an impulse in the first step": (
            scene.contact.rubs and bool(initial_contacts(scene)[1])
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


REASONS = {CLUMP: why_no_clump, POLYHEDRA: why_no_polyhedron}
ADAPTER = Yade()

"""LIGGGHTS as a code of the framework: refuses, describes, exports and runs asks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from adapters.liggghts.answers import unknowns
from adapters.liggghts.batch import solved, timed
from adapters.liggghts.bonds import OVERLAP
from adapters.liggghts.deck import deck
from adapters.liggghts.installed import find
from adapters.liggghts.refusals import refusal
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
from vv.adapter import Found, Scheme
from vv.ask import Ask, Method, Model, Run, Status
from vv.clump import clump
from vv.scene import Term
from vv.stand_in import STANDS_IN, stood_for

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
    }
)
DASHPOTS = {Term.CONTACT_VISCOSITY}
ON_CORNERS = (TERMS | STANDS_IN) - {Term.SPHERE, Term.SPHERE_CONTACT, Term.DRAG, Term.BOND}
ON_BONDS = frozenset({Term.SPHERE, Term.DRAG, Term.GRAVITY, Term.LOAD, Term.BOND, Term.BOND_SHEAR})
KNOBS = ("dt", "kn")
SCHEMES = (
    Scheme(
        PLAIN,
        "velocity Verlet with the scene's masses; drag is taken from the velocity half a step ago",
        Method.SECOND_ORDER,
        TERMS | STANDS_IN | DASHPOTS,
        KNOBS,
        lowered={
            Term.RIGID_CONTACT: Method.PENALTY,
            Term.CONTACT_VISCOSITY: Method.FIRST_ORDER,
        },
        pace=3e-5,
    ),
    Scheme(
        HALF_STEP,
        "velocity Verlet with masses m + eta dt/2, which makes drag that of the mean velocity",
        Method.SECOND_ORDER,
        TERMS,
        pace=3e-5,
    ),
    Scheme(
        CLUMP,
        "a block as a rigid body of atoms, which stands on a sphere at each corner of its face",
        Method.PENALTY,
        ON_CORNERS,
        KNOBS,
        pace=5e-5,
    ),
    Scheme(
        OVERLAPPED,
        f"bonds as contacts of spheres that overlap by {OVERLAP:g} of their distance from the "
        "start, in unyielding friction, what they push with cancelled by dead loads: a surrogate",
        Method.PENALTY,
        ON_BONDS,
        pace=3e-5,
    ),
)


class Liggghts:
    """The adapter; it holds no state."""

    name = "liggghts"
    schemes = SCHEMES

    def found(self) -> Found:
        """Look for the executable and its libraries."""
        return find()

    def refuses(self, ask: Ask, scheme: str) -> str | None:
        """What LIGGGHTS cannot represent though it has every term."""
        return refusal(ask, scheme)

    def describe(self, ask: Ask, scheme: str) -> Model:
        """The freedoms LIGGGHTS integrates, and how the scene is put to it."""
        scene = represented(ask, OVERLAPPED if scheme == OVERLAPPED else PLAIN)
        terms = ask.scene.terms() | scene.terms()
        return Model(
            6 if scheme == CLUMP else unknowns(scene), terms, "; ".join(_notes(ask, scheme))
        )

    def native(self, ask: Ask, scheme: str) -> str:
        """A deck for `liggghts -in`; it writes history.txt, and the files it reads itself."""
        notes = "".join(f"# {note}\n" for note in _notes(ask, scheme))
        return f"{notes}{deck(ask, scheme, 'history.txt')}"

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """Run all asks in one LIGGGHTS process; see vv.external for what happens if it dies."""
        if not (here := find()).installed:
            yield from [Run(Status.NOT_INSTALLED, here.how_to_install)] * len(asks)
            return
        models = [self.describe(ask, scheme) for ask in asks]
        if repeat:
            yield from timed(asks, models, scheme, scratch, here.path, repeat)
        else:
            yield from solved(asks, models, scheme, scratch, here.path)


def _notes(ask: Ask, scheme: str) -> list[str]:
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
        "shear springs of model history, without tangential damping": scene.contact.rubs,
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


ADAPTER = Liggghts()

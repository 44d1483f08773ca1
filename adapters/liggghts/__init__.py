"""LIGGGHTS as a code of the framework: refuses, describes, exports and runs asks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from adapters.liggghts.answers import unknowns
from adapters.liggghts.batch import solved, timed
from adapters.liggghts.bonds import NO_STRENGTH, OVERLAP
from adapters.liggghts.deck import deck
from adapters.liggghts.harmonic import LASTING
from adapters.liggghts.installed import find
from adapters.liggghts.notes import notes
from adapters.liggghts.refusals import refusal
from adapters.liggghts.translate import (
    CLUMP,
    HALF_STEP,
    OVERLAPPED,
    PLAIN,
    represented,
)
from vv.ask import Ask, Method, Model, Run, Status
from vv.codes import Found, Scheme
from vv.scene import Term
from vv.standins.stand_in import STANDS_IN

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
        why_not=LASTING,
        pace=(6e-6, 2e-7),
    ),
    Scheme(
        HALF_STEP,
        "velocity Verlet with masses m + eta dt/2, which makes drag that of the mean velocity",
        Method.SECOND_ORDER,
        TERMS,
        why_not=LASTING,
        pace=(6e-6, 2e-7),
    ),
    Scheme(
        CLUMP,
        "a block as a rigid body of atoms, which stands on a sphere at each corner of its face",
        Method.PENALTY,
        ON_CORNERS,
        KNOBS,
        pace=(1.2e-5, 2e-7),
    ),
    Scheme(
        OVERLAPPED,
        f"bonds as contacts of spheres that overlap by {OVERLAP:g} of their distance from the "
        "start, in unyielding friction, what they push with cancelled by dead loads: a surrogate",
        Method.PENALTY,
        ON_BONDS,
        why_not=NO_STRENGTH,
        pace=(2e-6, 2e-7),
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
            6 if scheme == CLUMP else unknowns(scene), terms, "; ".join(notes(ask, scheme))
        )

    def native(self, ask: Ask, scheme: str) -> str:
        """A deck for `liggghts -in`; it writes history.txt, and the files it reads itself."""
        heading = "".join(f"# {note}\n" for note in notes(ask, scheme))
        return f"{heading}{deck(ask, scheme, 'history.txt')}"

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """Run all asks in one LIGGGHTS process; vv.codes.external says what happens if it dies."""
        if not (here := find()).installed:
            yield from [Run(Status.NOT_INSTALLED, here.how_to_install)] * len(asks)
            return
        models = [self.describe(ask, scheme) for ask in asks]
        if repeat:
            yield from timed(asks, models, scheme, scratch, here.path, repeat)
        else:
            yield from solved(asks, models, scheme, scratch, here.path)


ADAPTER = Liggghts()

"""LIGGGHTS as a code of the framework: refuses, describes, exports and runs asks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from adapters.liggghts.batch import Batch, solved, timed
from adapters.liggghts.deck import deck, notes
from adapters.liggghts.installed import find
from adapters.liggghts.overlaps import NO_STRENGTH, OVERLAP
from adapters.liggghts.refusals import refusal
from adapters.liggghts.setup import CLUMP, HALF_STEP, OVERLAPPED, PLAIN, Setup, set_up
from adapters.liggghts.terms.bonds import LASTING
from adapters.liggghts.terms.table import TRANSLATIONS
from vv.ask import Ask, Method, Model, Run, Status
from vv.codes import LEAPFROG_ON_SPRINGS, Found, Scheme, external
from vv.scene import Term
from vv.standins.stand_in import STANDS_IN

NO_SPRING = {
    Term.CONTACT_VISCOSITY,
    Term.VISCOUS_FRICTION,
    Term.HERTZ,
    Term.HERTZ_VISCOSITY,
}
UNRAISED = STANDS_IN | NO_SPRING  # terms with which raised masses are not verified
TERMS = frozenset(TRANSLATIONS) - {Term.BOND_SHEAR}
ON_CORNERS = TERMS - {
    Term.SPHERE,
    Term.SPHERE_CONTACT,
    Term.DRAG,
    Term.BOND,
    *NO_SPRING,
}
ON_BONDS = frozenset({Term.SPHERE, Term.DRAG, Term.GRAVITY, Term.LOAD, Term.BOND, Term.BOND_SHEAR})
KNOBS = ("dt", "kn")
SCHEMES = (
    Scheme(
        PLAIN,
        "velocity Verlet with the scene's masses; drag is taken from the velocity half a step ago",
        Method.LEAPFROG,
        TERMS,
        KNOBS,
        lowered=LEAPFROG_ON_SPRINGS,
        why_not=LASTING,
        pace=(6e-6, 2e-7),
    ),
    Scheme(
        HALF_STEP,
        "velocity Verlet with masses m + eta dt/2, which makes drag that of the mean velocity",
        Method.LEAPFROG,
        TERMS - UNRAISED,
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
        "start, with friction that never slips; dead loads cancel the contact forces: a surrogate",
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
        """Why LIGGGHTS cannot represent the ask although it has every term; None if it can."""
        return refusal(ask, scheme)

    def describe(self, ask: Ask, scheme: str) -> Model:
        """The degrees of freedom that LIGGGHTS integrates, and how the scene is translated."""
        return _described(set_up(ask, scheme))

    def native(self, ask: Ask, scheme: str) -> str:
        """A deck for `liggghts -in`; it writes history.txt, and the files it reads itself."""
        setup = set_up(ask, scheme)
        heading = "".join(f"# {note}\n" for note in notes(setup))
        return f"{heading}{deck(setup, 'history.txt')}"

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """Run all asks in one LIGGGHTS process; vv.codes.external says what happens if it dies."""
        if not (here := find()).installed:
            yield from [Run(Status.NOT_INSTALLED, here.how_to_install)] * len(asks)
            return
        setups = [set_up(ask, scheme) for ask in asks]
        models = [_described(setup) for setup in setups]
        batch = Batch(setups, models, external.new_folder(scratch), here.path)
        yield from timed(batch, repeat) if repeat else solved(batch)


def _described(setup: Setup) -> Model:
    """Three or six degrees of freedom for each moving sphere, whether locked or not; and notes."""
    integrated = 3 * int(setup.moving.sum()) + 3 * int(setup.turning.sum())
    unknowns = 6 * len(setup.clumps) if setup.clumps else integrated
    return Model(unknowns, setup.terms, "; ".join(notes(setup)))


ADAPTER = Liggghts()

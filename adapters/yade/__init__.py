"""YADE as a code of the framework: refuses, describes, exports and runs asks."""

from __future__ import annotations

import dataclasses
import json
import pprint
from collections.abc import Iterator, Sequence
from pathlib import Path

from adapters.yade.answers import parse
from adapters.yade.inside import script
from adapters.yade.installed import PYTHON, find
from adapters.yade.plan import notes, plan
from adapters.yade.refusals import refusal
from adapters.yade.setup import CLUMP, HALF_STEP, PLAIN, POLYHEDRA, Setup, set_up
from adapters.yade.terms.table import TRANSLATIONS
from vv.ask import Ask, Displacement, Method, Model, Reaction, Run, Status, Velocity
from vv.codes import LEAPFROG_ON_SPRINGS, Found, Scheme, external
from vv.codes.reused_program import ReusedProgram
from vv.scene import Term
from vv.standins.stand_in import STANDS_IN

TERMS = frozenset(TRANSLATIONS)
NO_SPRING = {
    Term.CONTACT_VISCOSITY,
    Term.VISCOUS_FRICTION,
    Term.HERTZ,
    Term.HERTZ_VISCOSITY,
}
UNRAISED = STANDS_IN | NO_SPRING  # terms with which raised masses are not verified
BONDED = {Term.BOND, Term.BOND_SHEAR, Term.BREAKAGE}
ONLY_SPHERES = {Term.SPHERE, Term.SPHERE_CONTACT, Term.DRAG, Term.CARRIED} | BONDED
ONE_BLOCK = TERMS - ONLY_SPHERES - NO_SPRING
KNOBS = ("dt", "kn")
OBSERVABLES = frozenset({Displacement, Velocity, Reaction})
SCHEMES = (
    Scheme(
        PLAIN,
        "leapfrog with the scene's masses; drag is taken from the velocity half a step ago",
        Method.LEAPFROG,
        TERMS,
        KNOBS,
        lowered=LEAPFROG_ON_SPRINGS,
        observables=OBSERVABLES,
        pace=(2e-6, 1.1e-6),
    ),
    Scheme(
        HALF_STEP,
        "leapfrog with masses m + eta dt/2, which makes drag that of the mean velocity",
        Method.LEAPFROG,
        TERMS - UNRAISED,
        observables=OBSERVABLES,
        pace=(2e-6, 1.1e-6),
    ),
    Scheme(
        CLUMP,
        "a block as a clump, which stands on a sphere at each corner of its face",
        Method.PENALTY,
        ONE_BLOCK,
        KNOBS,
        pace=(5e-6, 1.1e-6),
    ),
    Scheme(
        POLYHEDRA,
        "a block as a polyhedron, with forces from the volume of its overlap; slow, for short runs",
        Method.PENALTY,
        ONE_BLOCK,
        KNOBS,
        pace=(0.0, 1e-4),
    ),
)


class Yade:
    """The adapter; it keeps its YADE process if that waits for more asks."""

    name = "yade"
    schemes = SCHEMES

    def __init__(self) -> None:
        self.program = ReusedProgram()

    def found(self) -> Found:
        """Look for the package's folder."""
        return dataclasses.replace(find(), may_wait=self.program.may_wait)

    def refuses(self, ask: Ask, scheme: str) -> str | None:
        """Why YADE cannot represent the ask although it has every term; None if it can."""
        return refusal(ask, scheme)

    def describe(self, ask: Ask, scheme: str) -> Model:
        """The degrees of freedom that YADE integrates, and how the scene is translated."""
        return _described(set_up(ask, scheme))

    def native(self, ask: Ask, scheme: str) -> str:
        """A script for `yade -n -x` or the system's python3: the program with the ask filled in."""
        setup = set_up(ask, scheme)
        heading = "".join(f"# {note}\n" for note in notes(setup))
        literal = pprint.pformat(plan(setup), width=99, sort_dicts=False)
        return script(f"{heading}ASK: dict[str, Any] | None = {literal}\n")

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """Run all asks in one YADE process; see vv.codes.external for what happens if it dies."""
        here = find()
        if not here.installed:
            yield from [Run(Status.NOT_INSTALLED, here.how_to_install)] * len(asks)
            return
        folder = external.new_folder(scratch)
        files = [folder / f"ask-{number}.json" for number in range(len(asks))]
        source = folder / "in-yade.py"
        source.write_text(script())
        setups = [set_up(ask, scheme) for ask in asks]
        models = [_described(setup) for setup in setups]
        for file, setup in zip(files, setups, strict=True):
            file.write_text(json.dumps({**plan(setup), "repeat": repeat}))

        def launch(indices: Sequence[int]) -> external.Process:
            # -E: environment variables for our own Python must not act here
            command = [str(PYTHON), "-E", str(source)]
            asked = [files[i] for i in indices]
            return self.program.ask(command, folder, {"VV_YADE": here.path}, asked)

        def collect(index: int, program: external.Process) -> Run | None:
            return parse(files[index], setups[index], models[index], program.started)

        yield from external.run_batch(len(asks), launch, collect, self.program.dismiss)


def _described(setup: Setup) -> Model:
    """The degrees of freedom of spheres, and the rotations of a block that they represent."""
    turning = sum(int(block.free_spin.sum()) for block in setup.asked.scene.blocks)
    return Model(setup.scene.unknowns() + turning, setup.terms, "; ".join(notes(setup)))


ADAPTER = Yade()

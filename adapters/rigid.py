"""The in-house rigid blocks as a code of the framework."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Sequence
from pathlib import Path

from vv.ask import Ask, Method, Model, Run
from vv.codes import Found, Scheme, python_script, run_timed
from vv.codes.in_house import part_of_vv
from vv.engines import rigid
from vv.scene import Term

SCHEMES = (
    Scheme(
        "default",
        "trapezoidal positions, contact laws at the end of the step, exact Coulomb cone "
        "converged to a residual; steps cut where slip ends",
        Method.SECOND_ORDER,
        frozenset(
            {
                Term.WALL_CONTACT,
                Term.FRICTION,
                Term.GRAVITY,
                Term.LOAD,
                Term.ROTATION,
                Term.OBLIQUE_LOCK,
                Term.BLOCK,
                Term.RIGID_CONTACT,
                Term.SHAKING,
                Term.BASE_MOTION,
            }
        ),
    ),
)


class Rigid:
    """The adapter; it holds no state."""

    name = "rigid"
    schemes = SCHEMES

    def found(self) -> Found:
        """Part of vv, if numba is there to compile it."""
        return part_of_vv()

    def refuses(self, ask: Ask, scheme: str) -> str | None:
        """Why the blocks cannot run an ask though they have every term."""
        return rigid.refuses(ask)

    def describe(self, ask: Ask, scheme: str) -> Model:
        """The smallest model of the scene."""
        return rigid.prepare(ask).model

    def native(self, ask: Ask, scheme: str) -> str:
        """A Python script that calls the engine."""
        return python_script(ask, "vv.engines.rigid", "solve")

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """Solve the asks in this process; see `run_timed` for the cost."""
        for ask in asks:
            yield run_timed(functools.partial(rigid.prepare, ask), repeat)


ADAPTER = Rigid()

"""LMGC90 as a code of the framework: rigid blocks in contact dynamics, face to face."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from adapters.lmgc90.refusals import density, refusal
from vv.ask import Ask, Displacement, Method, Model, Run, Velocity
from vv.codes import Found, Scheme
from vv.codes.own_python import Driver, Home
from vv.scene import Term
from vv.standins.boxed import boxed

DEFAULT = Scheme(
    "default",
    "contact dynamics of Jean and Moreau by a theta method, theta = 1/2; contact laws at the end "
    "of the step, solved by Gauss-Seidel sweeps to LMGC90's own tolerance",
    Method.FIRST_ORDER,
    frozenset(
        {
            Term.BLOCK,
            Term.RIGID_CONTACT,
            Term.WALL_CONTACT,
            Term.FRICTION,
            Term.GRAVITY,
            Term.LOAD,
            Term.ROTATION,
            Term.OBLIQUE_LOCK,
            Term.SHAKING,
            Term.BASE_MOTION,
        }
    ),
    observables=frozenset({Displacement, Velocity}),
    pace=(1e-5, 2e-5),
)
DRIVER = Driver(Home("lmgc90", ("compas_lmgc90",)), Path(__file__).with_name("driver.py"))
NOTES = (
    "polyhedra in contact dynamics, contact points found between faces",
    "each wall a box with its velocity prescribed",
    "gravity and loads as forces besides LMGC90's own 9.81 m/s2 along -z of the scene's axes",
    "what moves at the start is pushed in the first step, and starts v dt/2 ahead",
)


class Lmgc90:
    """The adapter; it holds no state."""

    name = "lmgc90"
    schemes = (DEFAULT,)

    def found(self) -> Found:
        """Look for its environment."""
        return DRIVER.home.find()

    def refuses(self, ask: Ask, scheme: str) -> str | None:
        """What LMGC90 cannot represent though it has every term."""
        return refusal(ask)

    def describe(self, ask: Ask, scheme: str) -> Model:
        """The freedoms that are left to the blocks."""
        return Model(ask.scene.unknowns(), ask.scene.terms(), "; ".join(NOTES))

    def native(self, ask: Ask, scheme: str) -> str:
        """A script for the Python of its environment: the driver with the ask filled in."""
        return DRIVER.script(_plan(ask), "; ".join(NOTES))

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """Run all asks in one process of LMGC90."""
        built = [(_plan(ask), self.describe(ask, scheme), ask.scene.axes) for ask in asks]
        yield from DRIVER.run(asks, built, scratch, repeat)


def _plan(ask: Ask) -> dict[str, Any]:
    return {**boxed(ask), "density": density(ask.scene)}


ADAPTER = Lmgc90()

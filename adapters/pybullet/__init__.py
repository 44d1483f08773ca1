"""PyBullet as a code of the framework: rigid blocks on boxes, solved for impulses."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from adapters.pybullet.shapes import own_axes, why_no_shapes
from vv.ask import Ask, Displacement, Method, Model, Run, Velocity
from vv.codes import Found, Scheme
from vv.codes.own_python import Driver, Home
from vv.scene import Term
from vv.standins.boxed import boxed, why_no_boxes

DEFAULT = Scheme(
    "default",
    "semi-implicit Euler steps, started with half a step of all forces; a cone of friction at the "
    "end of the step, solved by up to 200 Gauss-Seidel sweeps",
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
    pace=(1e-5, 4e-5),
)
DRIVER = Driver(Home("pybullet", ("pybullet",)), Path(__file__).with_name("driver.py"))
NOTES = (
    "boxes are boxes, other blocks the hulls of their vertices, without margins; walls are boxes",
    "a wall that moves is the frame of reference, its acceleration a force on the blocks",
    "locked rotations have no inverse inertia; along locked directions nothing pushes",
)


class PyBullet:
    """The adapter; it holds no state."""

    name = "pybullet"
    schemes = (DEFAULT,)

    def found(self) -> Found:
        """Look for its environment."""
        return DRIVER.home.find()

    def refuses(self, ask: Ask, scheme: str) -> str | None:
        """What PyBullet cannot represent though it has every term."""
        return why_no_boxes(ask) or why_no_shapes(ask.scene)

    def describe(self, ask: Ask, scheme: str) -> Model:
        """The freedoms that are left to the blocks."""
        return Model(ask.scene.unknowns(), ask.scene.terms(), "; ".join(NOTES))

    def native(self, ask: Ask, scheme: str) -> str:
        """A script for the Python of its environment: the driver with the ask filled in."""
        return DRIVER.script(_plan(ask), "; ".join(NOTES))

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """Run all asks in one process of PyBullet."""
        built = [(_plan(ask), self.describe(ask, scheme), ask.scene.axes) for ask in asks]
        yield from DRIVER.run(asks, built, scratch, repeat)


def _plan(ask: Ask) -> dict[str, Any]:
    """The plan with the shape of each block, and the directions in which free ones are driven."""
    plan = boxed(ask)
    blocks = [block | own_axes(block) for block in plan["blocks"]]
    driven = [any(block["free"][axis] for block in blocks) for axis in range(3)]
    return {**plan, "blocks": blocks, "driven": driven}


ADAPTER = PyBullet()

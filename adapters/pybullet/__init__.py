"""PyBullet as a code of the framework: rigid blocks on boxes, solved for impulses."""

from __future__ import annotations

from operator import attrgetter
from pathlib import Path
from typing import Any

from adapters.pybullet.shapes import own_axes, why_no_shapes
from adapters.pybullet.units import in_units_of_blocks
from vv.ask import Ask, Displacement, Method, Velocity
from vv.codes import Scheme
from vv.codes.driver_adapter import DriverAdapter
from vv.codes.own_python import Driver, PythonEnvironment
from vv.scene import Wall
from vv.standins.boxed import BOXED, boxed, why_no_boxes

DEFAULT = Scheme(
    "default",
    "semi-implicit Euler steps, started with half a step of all forces; a cone of friction at the "
    "end of the step, solved by up to 200 Gauss-Seidel sweeps",
    Method.FIRST_ORDER,
    BOXED,
    observables=frozenset({Displacement, Velocity}),
    pace=(1e-5, 4e-5),
)
DRIVER = Driver(PythonEnvironment("pybullet", ("pybullet",)), Path(__file__).with_name("driver.py"))
NOTES = (
    "boxes are boxes, other blocks the hulls of their vertices, without margins; walls are boxes",
    "lengths are in the power of two next to the size of the largest block, since limits of "
    "distance are fixed numbers in its source",
    "a wall that moves is the frame of reference, its acceleration a force on the blocks",
    "locked rotations have no inverse inertia; no force acts along locked directions",
)


def _refusal(ask: Ask) -> str | None:
    """Why PyBullet cannot represent the ask although it has every term; None if it can."""
    return why_no_boxes(ask) or _why_no_base(ask) or why_no_shapes(ask.scene)


def _why_no_base(ask: Ask) -> str | None:
    """Why the walls of an ask are not supported: all must move alike, as the blocks' frame."""
    scene = ask.scene
    moves = {wall.motion is not None for wall in scene.walls}
    if len(moves) > 1:
        return "a wall moves and another does not; all must move alike, as the frame of the blocks"
    walls = set(scene.body_numbers(Wall)) & {seen.body for seen in ask.observables}
    return f"body {min(walls)} is a wall, for which PyBullet reports nothing" if walls else None


def _plan(ask: Ask) -> dict[str, Any]:
    """The plan in units of blocks, with their shapes and the directions in which forces act."""
    plan = boxed(ask)
    blocks = [block | own_axes(block) for block in plan["blocks"]]
    driven = [any(block["free"][axis] for block in blocks) for axis in range(3)]
    return in_units_of_blocks({**plan, "blocks": blocks, "driven": driven})


ADAPTER = DriverAdapter(
    DEFAULT,
    DRIVER,
    NOTES,
    refusal=_refusal,
    plan=_plan,
    frame=attrgetter("scene.axes"),
)

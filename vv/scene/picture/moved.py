"""Finds the shapes of a body in a sketch, and how they move when it translates or rotates."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from vv.scene.arrays import Vector
from vv.scene.block import Block
from vv.scene.bodies import Spheres
from vv.scene.picture import view
from vv.scene.picture.sketch import DIGITS, MOST, Spot
from vv.scene.scene import Scene

ACROSS = 0.99  # the least cosine between an axis and the line of sight of a rotation that is drawn


@dataclass(frozen=True, slots=True)
class Moved:
    """The motion of the shapes of a body in a sketch, per unit of a quantity.

    circles, faces: (first, count) of the shapes of the body among those of the sketch. along: their
    displacement to the right and up [m]; turn: their anticlockwise rotation [rad].
    """

    circles: tuple[int, int]
    faces: tuple[int, int]
    along: Spot = (0.0, 0.0)
    turn: float = 0.0


def shifted(scene: Scene, body: int, direction: Vector) -> Moved | None:
    """The motion for one metre along a direction (3,); None if the sketch does not show it."""
    x, y = (view.plane(scene) @ direction).round(DIGITS).tolist()
    found = _shapes(scene, body)
    return Moved(*found, along=(x + 0.0, y + 0.0)) if found and (x or y) else None


def turned(scene: Scene, body: int, axis: Vector, angle: float) -> Moved | None:
    """The motion for an angle [rad] about an axis (3,); None if the sketch does not show it."""
    seen = float(axis @ view.towards(view.plane(scene)))
    found = _shapes(scene, body)
    return Moved(*found, turn=angle * round(seen)) if found and abs(seen) > ACROSS else None


def _shapes(scene: Scene, body: int) -> tuple[tuple[int, int], tuple[int, int]] | None:
    """(first, count) of the circles and of the faces of a body; None if it is not drawn."""
    if body in (spheres := scene.body_numbers(Spheres)):
        place = spheres.index(body)
        return ((place, 1), (0, 0)) if place < MOST else None
    place = scene.body_numbers(Block).index(body)
    counts = [len(view.faces(block, view.plane(scene))) for block in scene.blocks[: place + 1]]
    return ((0, 0), (int(np.sum(counts[:-1])), counts[-1])) if place < MOST else None

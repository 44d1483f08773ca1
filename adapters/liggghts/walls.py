"""Puts a wall to LIGGGHTS: a plane across an axis of the frame, or a mesh of one triangle."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from adapters.liggghts.words import AXES, numbers, printed
from vv.scene import Vector, Wall


def oblique(wall: Wall) -> bool:
    """Whether a wall lies across no axis of the frame, and needs a mesh; rounding is no tilt."""
    return int((np.abs(wall.normal) > 1e-15).sum()) > 1


def is_mesh(wall: Wall) -> bool:
    """Whether a wall is put as a mesh: LIGGGHTS has planes across axes, which do not move."""
    return oblique(wall) or wall.motion is not None


def travel(wall: Wall) -> float:
    """A distance [m] from its place at t = 0 that a wall does not exceed."""
    return 0.0 if wall.motion is None else 2 * float(np.abs(wall.motion.amplitude).sum())


def triangle(wall: Wall, low: Vector, high: Vector) -> Vector:
    """The (3, 3) corners [m] of a triangle in the wall's plane, larger than its cut with a box.

    One triangle has no inner edges, at which a mesh may hand contacts over. The corners run
    round the outward normal. The inscribed circle reaches beyond the farthest corner of the box.
    """
    centre, half = (low + high) / 2, (high - low) / 2
    foot = centre - ((centre - wall.point) @ wall.normal) * wall.normal
    inscribed = float(np.linalg.norm(half) + np.linalg.norm(foot - centre))
    return np.asarray(foot + 2 * inscribed * wall.facet_corners)


def wall_commands(
    walls: Sequence[Wall], triangles: Mapping[int, Vector], model: str, damping: str
) -> Iterator[str]:
    """The commands for walls with a contact model and its damping.

    triangles: the corners of those that are meshes. A mesh is read from a file, which the deck
    writes itself; LIGGGHTS takes one command for all meshes, and one for each plane.
    """
    for number, wall in enumerate(walls):
        if number in triangles:
            yield from printed(f"wall{number}.stl", _stl(wall, triangles[number]))
            yield f"fix wall{number}_mesh all mesh/surface file wall{number}.stl type 1"
        else:
            axis = int(np.abs(wall.normal).argmax())
            plane = f"primitive type 1 {AXES[axis]}plane {float(wall.point[axis])!r}"
            yield f"fix wall{number} all wall/gran {model} {plane} {damping}"
    if triangles:
        names = " ".join(f"wall{number}_mesh" for number in sorted(triangles))
        meshes = f"mesh n_meshes {len(triangles)} meshes {names}"
        yield f"fix meshes all wall/gran {model} {meshes} {damping}"


def _stl(wall: Wall, corners: Vector) -> Iterator[str]:
    yield "solid wall"
    yield f"facet normal {numbers(wall.normal)}"
    yield "outer loop"
    for corner in corners:
        yield f"vertex {numbers(corner)}"
    yield "endloop"
    yield "endfacet"
    yield "endsolid wall"

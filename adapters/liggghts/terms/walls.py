"""Translates walls for LIGGGHTS: planes across an axis of the frame, or one-triangle meshes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from adapters.liggghts.sections import Deck
from adapters.liggghts.setup import Setup
from adapters.liggghts.space import is_mesh
from adapters.liggghts.words import AXES, numbers, printed
from vv.scene import Vector, Wall


def walls(deck: Deck, setup: Setup) -> Deck:
    """Each wall as a plane or a mesh, with the contact law of the deck."""
    meshes = any(is_mesh(wall) for wall in setup.scene.walls)
    note = "a mesh wall, one triangle far larger than the scene, instead of a primitive one"
    commands = _commands(setup, deck.law.model, deck.law.damping)
    return deck.with_more(walls=commands, notes=[note] if meshes else [])


def _commands(setup: Setup, model: str, damping: str) -> Iterator[str]:
    """The commands for all walls with a contact model and its damping.

    A mesh is read from a file, which the deck writes itself; LIGGGHTS takes one command for all
    meshes, and one for each plane.
    """
    triangles = setup.room.triangles
    for number, wall in enumerate(setup.scene.walls):
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

"""Builds the flat arrays of convex polyhedra that contact detection reads from a scene's blocks.

The vertices, faces and edges of all blocks lie one after the other in flat arrays; vertices, faces
and corners are numbered through all blocks. Shapes never change. Their present position is a pair
of arrays in the scene's frame, `vertex` (v, 3) [m] and `normal` (f, 3). `placement.py` fills both
from the centroids and rotations of rigid blocks, or finds the normals for given vertices of
blocks that deform.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from vv.scene import Block, Scene, Vector

Index = npt.NDArray[np.int64]
IN_PLANE = 1e-6  # sine of the largest angle between a face and the axis or plane of its prism


class Shapes(NamedTuple):
    """The shapes of n blocks with v vertices, f faces, c corners of faces and e edges at t = 0.

    vertex: (v, 3) relative to the centroid [m]; vertex_start: (n + 1,), block i has the vertices
    from vertex_start[i] up to vertex_start[i + 1]; normal: (f, 3) outward; face_start: (n + 1,);
    corner: (c,) vertices of each face, counter-clockwise seen from outside; corner_start:
    (f + 1,); edge: (e, 4) two vertices and the two faces that meet there, without edges between
    coplanar faces; edge_start: (n + 1,); size: (n,) largest extent [m].
    """

    vertex: Vector
    vertex_start: Index
    normal: Vector
    face_start: Index
    corner: Index
    corner_start: Index
    edge: Index
    edge_start: Index
    size: Vector


class Planes(NamedTuple):
    """The w walls: points (w, 3) at t = 0 [m] and outward normals (w, 3)."""

    point: Vector
    normal: Vector


def shapes(blocks: tuple[Block, ...]) -> Shapes:
    """The shapes of blocks, in the order of the scene."""
    counts = np.array([[len(b.vertices), len(b.faces)] for b in blocks], np.int64)
    starts = np.concatenate([np.zeros((1, 2), np.int64), counts.cumsum(axis=0)])
    faces = [
        tuple(int(first) + vertex for vertex in face)
        for block, first in zip(blocks, starts[:, 0], strict=False)
        for face in block.faces
    ]
    normals = np.concatenate([block.normals for block in blocks])
    edges = _edges(faces, normals, np.repeat(np.arange(len(blocks)), counts[:, 1]))
    return Shapes(
        vertex=np.concatenate([block.vertices - block.centroid() for block in blocks]),
        vertex_start=starts[:, 0].copy(),
        normal=normals,
        face_start=starts[:, 1].copy(),
        corner=np.array([vertex for face in faces for vertex in face], np.int64),
        corner_start=np.cumsum([0, *map(len, faces)]).astype(np.int64),
        edge=edges[0],
        edge_start=np.searchsorted(edges[1], np.arange(len(blocks) + 1)).astype(np.int64),
        size=np.array([np.ptp(block.vertices, axis=0).max() for block in blocks]),
    )


def planes(scene: Scene) -> Planes:
    """The planes of a scene's walls, in the order of the scene."""
    walls = scene.walls
    points = np.array([wall.point for wall in walls]).reshape(-1, 3)
    return Planes(points, np.array([wall.normal for wall in walls]).reshape(-1, 3))


def depth_axis(scene: Scene) -> Vector:
    """The unit normal (3,) of the plane of a plane scene; zeros for a scene in space.

    A scene is plane if no block moves along one of its axes or turns about the others, and every
    block is a prism along that axis.
    """
    for axis, direction in enumerate(scene.axes):
        others = [other for other in range(3) if other != axis]
        held = all(not b.free[axis] and not b.free_spin[others].any() for b in scene.blocks)
        if held and all(_is_prism(block, direction) for block in scene.blocks):
            return np.array(direction)
    return np.zeros(3)


def _is_prism(block: Block, direction: Vector) -> bool:
    across = np.abs(block.normals @ direction)
    return bool(((across < IN_PLANE) | (across > 1 - IN_PLANE)).all())


def _edges(
    faces: list[tuple[int, ...]], normals: Vector, owner: npt.NDArray[np.int64]
) -> tuple[Index, Index]:
    """Edges (e, 4), as two vertices and two faces, and the block (e,) of each edge."""
    sides: dict[tuple[int, int], int] = {}
    found = []
    for number, face in enumerate(faces):
        for a, b in zip(face, (*face[1:], face[0]), strict=True):
            sides[a, b] = number
    for (a, b), one in sides.items():
        other = sides[b, a]
        if a < b and normals[one] @ normals[other] < 1 - 1e-12:
            found.append((int(owner[one]), a, b, one, other))
    table = np.array(sorted(found), np.int64).reshape(-1, 5)
    return table[:, 1:].copy(), table[:, 0].copy()

"""Kernels that place shapes: they compute vertices and face normals in the scene's frame."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Shapes
from vv.engines.kernels.compiled import inlined, lent
from vv.engines.kernels.triples import Triple, add_scaled, at, cross, dot, put
from vv.scene import Vector


@inlined
def turned(rotation: Vector, i: int, a: Triple) -> Triple:
    """rotation[i] @ a, with rotation (n, 3, 3)."""
    r = rotation[i]
    return (
        r[0, 0] * a[0] + r[0, 1] * a[1] + r[0, 2] * a[2],
        r[1, 0] * a[0] + r[1, 1] * a[1] + r[1, 2] * a[2],
        r[2, 0] * a[0] + r[2, 1] * a[1] + r[2, 2] * a[2],
    )


@lent
def place_rigid(
    vertex: Vector, normal: Vector, shapes: Shapes, centre: Vector, rotation: Vector
) -> None:
    """Fill vertex (v, 3) and normal (f, 3) from centroids (n, 3) [m] and rotations (n, 3, 3)."""
    for i in range(len(centre)):
        for k in range(shapes.vertex_start[i], shapes.vertex_start[i + 1]):
            put(
                vertex, k, add_scaled(at(centre, i), 1.0, turned(rotation, i, at(shapes.vertex, k)))
            )
        for k in range(shapes.face_start[i], shapes.face_start[i + 1]):
            put(normal, k, turned(rotation, i, at(shapes.normal, k)))


@lent
def find_normals(normal: Vector, shapes: Shapes, vertex: Vector) -> None:
    """Fill normal (f, 3) from the vertices (v, 3) of blocks that may deform, by Newell's sum."""
    for f in range(len(normal)):
        first, last = shapes.corner_start[f], shapes.corner_start[f + 1]
        area, before = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
        origin = at(vertex, shapes.corner[first])
        for c in range(first + 1, last):
            here = add_scaled(at(vertex, shapes.corner[c]), -1.0, origin)
            area = add_scaled(area, 0.5, cross(before, here))
            before = here
        put(normal, f, add_scaled((0.0, 0.0, 0.0), 1.0 / np.sqrt(dot(area, area)), area))

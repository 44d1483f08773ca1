"""Kernels that find along which face or pair of edges two convex blocks are farthest apart."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index, Shapes
from vv.engines.kernels.arrays import larger, smaller
from vv.engines.kernels.compiled import inlined, lent
from vv.engines.kernels.triples import Triple, add_scaled, at, cross, dot
from vv.scene import Vector

FACE_OF_FIRST, FACE_OF_SECOND, EDGES = 0, 1, 2
LIKELY = 1e-5  # of the smaller block: by so much a second kind of feature must be farther apart
PARALLEL = 1e-12  # sine squared of the angle between edges that are no pair


@inlined
def nearest(shapes: Shapes, vertex: Vector, i: int, n: Triple) -> float:
    """The least n . x over the vertices x of block i [m]."""
    least = np.inf
    for k in range(shapes.vertex_start[i], shapes.vertex_start[i + 1]):
        least = smaller(least, dot(n, at(vertex, k)))
    return least


@lent
def face_apart(
    a: int, b: int, shapes: Shapes, vertex: Vector, normal: Vector, depth: Vector, enough: float
) -> tuple[int, float]:
    """The face of block a from which block b is farthest, and how far [m].

    Stops at a face from which it is farther than `enough`. In a plane scene, depth (3,) not zero,
    faces across the depth count alone.
    """
    best, far = -1, -np.inf
    for f in range(shapes.face_start[a], shapes.face_start[a + 1]):
        n = at(normal, f)
        if abs(n[0] * depth[0] + n[1] * depth[1] + n[2] * depth[2]) < 0.5:
            on_face = dot(n, at(vertex, shapes.corner[shapes.corner_start[f]]))
            apart = nearest(shapes, vertex, b, n) - on_face
            if apart > far:
                best, far = f, apart
            if far > enough:
                break
    return best, far


@inlined
def support(normal: Vector, edge: Index, k: int, m: int) -> bool:
    """Whether edges k and m make a face of the Minkowski difference: their arcs of normals cross.

    The arc of one edge, on the unit sphere, joins the normals of the faces that meet at it; that
    of the other is taken to the opposite side.
    """
    a, b = at(normal, edge[k, 2]), at(normal, edge[k, 3])
    c, d = at(normal, edge[m, 2]), at(normal, edge[m, 3])
    along, across = cross(b, a), cross(d, c)
    one, two = -dot(c, along), -dot(d, along)
    three, four = dot(a, across), dot(b, across)
    return one * two < 0.0 and three * four < 0.0 and one * four > 0.0


@lent
def edges_apart(
    a: int, b: int, shapes: Shapes, vertex: Vector, normal: Vector, centre: Triple, enough: float
) -> tuple[int, int, float, Triple]:
    """The edges of blocks a and b along whose common normal these are farthest apart [m].

    centre: a point inside a. Returns the edges, the distance, and the normal out of a; edge -1
    if no pair of edges can touch.
    """
    one, two, far = -1, -1, -np.inf
    way = (0.0, 0.0, 0.0)
    for k in range(shapes.edge_start[a], shapes.edge_start[a + 1]):
        p = at(vertex, shapes.edge[k, 0])
        along = add_scaled(at(vertex, shapes.edge[k, 1]), -1.0, p)
        for m in range(shapes.edge_start[b], shapes.edge_start[b + 1]):
            if not support(normal, shapes.edge, k, m):
                continue
            q = at(vertex, shapes.edge[m, 0])
            other = add_scaled(at(vertex, shapes.edge[m, 1]), -1.0, q)
            n = cross(along, other)
            square = dot(n, n)
            if square <= PARALLEL * dot(along, along) * dot(other, other):
                continue
            outward = 1.0 if dot(n, add_scaled(p, -1.0, centre)) > 0 else -1.0
            n = add_scaled((0.0, 0.0, 0.0), outward / np.sqrt(square), n)
            apart = dot(n, add_scaled(q, -1.0, p))
            if apart > far:
                one, two, far, way = k, m, apart, n
            if far > enough:
                return one, two, far, way
    return one, two, far, way


@inlined
def middle(shapes: Shapes, vertex: Vector, i: int) -> Triple:
    """The mean of the vertices of block i."""
    first, last = shapes.vertex_start[i], shapes.vertex_start[i + 1]
    total = (0.0, 0.0, 0.0)
    for k in range(first, last):
        total = add_scaled(total, 1.0 / (last - first), at(vertex, k))
    return total


@lent
def separation(
    a: int, b: int, shapes: Shapes, vertex: Vector, normal: Vector, depth: Vector, margin: float
) -> tuple[int, int, int, float, Triple]:
    """The features along which blocks a and b are farthest apart, if no farther than margin [m].

    Returns the kind, a face (and -1) or two edges, the distance [m], and for edges the normal out
    of a. Faces are preferred to edges, and those of a to those of b. Separating axes: faces of
    both and, in space, all pairs of edges (Gottschalk et al. 1996).
    """
    likely = LIKELY * smaller(shapes.size[a], shapes.size[b])
    nowhere = (0.0, 0.0, 0.0)
    face, far = face_apart(a, b, shapes, vertex, normal, depth, margin)
    if far > margin:
        return FACE_OF_FIRST, face, -1, far, nowhere
    kind = FACE_OF_FIRST
    other, farther = face_apart(b, a, shapes, vertex, normal, depth, margin)
    if farther > far + likely:
        kind, face, far = FACE_OF_SECOND, other, farther
    if farther > margin or depth[0] != 0.0 or depth[1] != 0.0 or depth[2] != 0.0:
        return kind, face, -1, larger(far, farther), nowhere
    one, two, apart, way = edges_apart(
        a, b, shapes, vertex, normal, middle(shapes, vertex, a), margin
    )
    if apart > far + likely:
        return EDGES, one, two, apart, way
    return kind, face, -1, far, nowhere

"""Kernels that find the face or pair of edges along whose normal two blocks are farthest apart."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index, Shapes
from vv.engines.kernels.arrays import larger, smaller
from vv.engines.kernels.compiled import inlined, lent
from vv.engines.kernels.triples import Triple, add_scaled, at, cross, dot
from vv.scene import Vector

FACE_OF_FIRST, FACE_OF_SECOND, EDGES = 0, 1, 2
LIKELY = 1e-5  # of the smaller block's size: the lead by which a less preferred feature is taken
PARALLEL = 1e-12  # squared sine of the angle below which edges are parallel


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
    """The face of block a from which block b is farthest, and the distance [m].

    The search stops at a face whose distance exceeds `enough`. In a plane scene, where depth (3,)
    is not zero, faces normal to the depth are left out.
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
    """Whether edges k and m span a face of the Minkowski difference: their arcs of normals cross.

    The arc of an edge on the unit sphere joins the normals of its two faces; that of the second
    edge is reflected through the centre.
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
    """The edges of blocks a and b along whose common normal the blocks are farthest apart.

    centre: a point inside a. Returns both edges, the distance [m] and the normal out of a. Edges
    are -1 if no pair can touch. The search stops at a distance above `enough`.
    """
    one, two, far = -1, -1, -np.inf
    axis = (0.0, 0.0, 0.0)
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
                one, two, far, axis = k, m, apart, n
            if far > enough:
                return one, two, far, axis
    return one, two, far, axis


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
    """The features along whose normal blocks a and b are farthest apart.

    Returns the kind, a face and -1 or two edges, the distance [m], and for edges the normal out of
    a. Faces are preferred to edges, and faces of a to those of b. The features are valid only up to
    a distance of `margin` [m], beyond which the search stops. The separating axes are the normals
    of all faces and, in space, of all pairs of edges (Gottschalk et al. 1996).
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
    one, two, apart, axis = edges_apart(
        a, b, shapes, vertex, normal, middle(shapes, vertex, a), margin
    )
    if apart > far + likely:
        return EDGES, one, two, apart, axis
    return kind, face, -1, far, nowhere

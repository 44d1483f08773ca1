"""Kernels that find contact points of two convex blocks: a clipped face, or two crossing edges."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index, Shapes
from vv.engines.kernels.arrays import counts, larger, numbers, rows, smaller
from vv.engines.kernels.compiled import called, inlined, lent
from vv.engines.kernels.triples import Triple, add_scaled, at, cross, dot, put
from vv.scene import Vector

ON = 1e-9  # of a block's size: a point outside a side by less than this is on it
SLIVER = 1e-8  # of the smaller block's size squared: a smaller area is rounding


@inlined
def facing(shapes: Shapes, normal: Vector, i: int, n: Triple) -> int:
    """The face of block i whose outward normal is most opposed to n."""
    best, least = -1, np.inf
    for f in range(shapes.face_start[i], shapes.face_start[i + 1]):
        cosine = dot(n, at(normal, f))
        if cosine < least - 1e-9:
            best, least = f, cosine
    return best


@lent
def cut(
    new: Vector, new_label: Index, old: Vector, label: Index, count: int,
    p: Triple, inward: Triple, slack: float, fresh: int,
) -> int:  # fmt: skip
    """Clip a polygon to the half-space (x - p) . inward >= -slack; return its number of points.

    New points get the label `fresh` where the boundary leaves the half-space, and `fresh + 1`
    where it enters it (Sutherland and Hodgman 1974). new, new_label: filled.
    """
    left = 0
    for k in range(count):
        m = k + 1 if k + 1 < count else 0
        here = dot(add_scaled(at(old, k), -1.0, p), inward)
        there = dot(add_scaled(at(old, m), -1.0, p), inward)
        if here >= -slack:
            put(new, left, at(old, k))
            new_label[left] = label[k]
            left += 1
        if (here >= -slack) != (there >= -slack):
            part = here / (here - there)
            step = add_scaled(at(old, m), -1.0, at(old, k))
            put(new, left, add_scaled(at(old, k), part, step))
            new_label[left] = fresh if here >= -slack else fresh + 1
            left += 1
    return left


@inlined
def area_of(polygon: Vector, count: int, n: Triple) -> float:
    """The area [m2] of a polygon projected on the plane normal to n."""
    total = (0.0, 0.0, 0.0)
    for k in range(1, count - 1):
        one = add_scaled(at(polygon, k), -1.0, at(polygon, 0))
        two = add_scaled(at(polygon, k + 1), -1.0, at(polygon, 0))
        total = add_scaled(total, 0.5, cross(one, two))
    return abs(dot(total, n))


@called
def face_points(
    face: int, other: int, shapes: Shapes, vertex: Vector, normal: Vector, size: float
) -> tuple[int, Vector, Vector, Index, float]:
    """The face of block `other` that is opposite a face, clipped to the sides of that face.

    Returns the number of points, the points (k, 3) [m], their heights above the face (k,) [m],
    labels (k,) of the vertices or clipped corners that they are, and the projected area [m2].
    There are no points if the area is below SLIVER size^2.
    """
    n = at(normal, face)
    incident = facing(shapes, normal, other, n)
    first, last = shapes.corner_start[face], shapes.corner_start[face + 1]
    begin, end = shapes.corner_start[incident], shapes.corner_start[incident + 1]
    room = 2 * (last - first + end - begin)
    polygon, next_polygon = rows(room), rows(room)
    label, next_label = counts(room), counts(room)
    count = end - begin
    for k in range(count):
        put(polygon, k, at(vertex, shapes.corner[begin + k]))
        label[k] = shapes.corner[begin + k]
    for c in range(first, last):
        p = at(vertex, shapes.corner[c])
        q = at(vertex, shapes.corner[c + 1 if c + 1 < last else first])
        side = add_scaled(q, -1.0, p)
        inward = add_scaled((0.0, 0.0, 0.0), 1.0 / np.sqrt(dot(side, side)), cross(n, side))
        fresh = len(vertex) + 2 * c
        count = cut(next_polygon, next_label, polygon, label, count, p, inward, ON * size, fresh)
        polygon, next_polygon = next_polygon, polygon
        label, next_label = next_label, label
    area = area_of(polygon, count, n)
    height = numbers(count)
    origin = at(vertex, shapes.corner[first])
    for k in range(count):
        height[k] = dot(n, add_scaled(at(polygon, k), -1.0, origin))
    return (count if area > SLIVER * size * size else 0), polygon, height, label, area


@lent
def crossing(one: int, two: int, shapes: Shapes, vertex: Vector) -> Triple:
    """The midpoint [m] between the closest points of two edges."""
    p, q = at(vertex, shapes.edge[one, 0]), at(vertex, shapes.edge[two, 0])
    u = add_scaled(at(vertex, shapes.edge[one, 1]), -1.0, p)
    v = add_scaled(at(vertex, shapes.edge[two, 1]), -1.0, q)
    w = add_scaled(q, -1.0, p)
    uu, uv, vv = dot(u, u), dot(u, v), dot(v, v)
    determinant = uu * vv - uv * uv
    s = smaller(larger((dot(w, u) * vv - dot(w, v) * uv) / determinant, 0.0), 1.0)
    t = smaller(larger((dot(w, u) * uv - dot(w, v) * uu) / determinant, 0.0), 1.0)
    return add_scaled(
        add_scaled((0.0, 0.0, 0.0), 0.5, add_scaled(p, s, u)), 0.5, add_scaled(q, t, v)
    )

"""Contact detection for convex blocks and walls: the one interface to it, for every solver.

Bodies are numbered blocks first: block i is body i, wall w is body n + w. `detect` takes shapes
(`geometry.py`) that have been placed (`placement.py`) and fills a `Contacts`: pairs
in ascending order, points of a pair in the order of their features, so that the order of
contacts depends on nothing but the configuration. A contact is a point with a normal, a gap and a
key; solvers add their own per-contact arrays and carry them over by key (`matched`).

    contacts = empty_contacts(64)
    count = detect(contacts, shapes, vertex, normal, moves, planes, shift, depth, margin)
    while count > len(contacts.gap):        # the arrays were too short: their contents are invalid
        contacts = empty_contacts(2 * count)
        count = detect(contacts, ...)
    before = matched(contacts.key, count, old_key[:old_count])    # (count,) old row, -1 if new

All of these are compiled and can be called from kernels; `detect_contacts` is the entry from
Python. The velocity of `second` relative to `first` at `point` is positive along `normal` where
the contact opens.
"""

from __future__ import annotations

from typing import NamedTuple

from vv.engines.blocks.broad import close_pairs
from vv.engines.blocks.clip import area_of, crossing, face_points, facing
from vv.engines.blocks.geometry import Index, Planes, Shapes
from vv.engines.blocks.overlap import EDGES, FACE_OF_FIRST, separation
from vv.engines.blocks.sorting import ordered
from vv.engines.kernels.arrays import counts, numbers, rows, smaller
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called, compiled, inlined, lent
from vv.engines.kernels.triples import Triple, add_scaled, at, dot, put
from vv.scene import Mask, Vector

bundle(Shapes)
bundle(Planes)

SAME = 1e-6  # of a block's size: points of a prism closer in its plane are one contact


@bundle
class Contacts(NamedTuple):
    """Contacts as rows of arrays, which may be longer than the number of contacts.

    first, second: (c,) bodies; second is a block, first a block of lower number or a wall. normal:
    (c, 3) unit, from first to second. point: (c, 3) midway between the surfaces [m], which are at
    point -+ gap/2 normal. gap: (c,) [m], negative for penetration. area: (c,) share of the contact
    area [m2], 0 at an edge or a vertex. key: (c,) identifies bodies and features; it is the same
    as long as the same features touch.
    """

    first: Index
    second: Index
    point: Vector
    normal: Vector
    gap: Vector
    area: Vector
    key: Index


@called
def empty_contacts(room: int) -> Contacts:
    """Uninitialised arrays for `room` contacts."""
    return Contacts(
        counts(room),
        counts(room),
        rows(room),
        rows(room),
        numbers(room),
        numbers(room),
        counts(room),
    )


@inlined
def add(
    contacts: Contacts, count: int, first: int, second: int,
    point: Triple, normal: Triple, gap: float, area: float, key: int,
) -> int:  # fmt: skip
    """Write a contact if there is room for it; return the new number of contacts."""
    if count < len(contacts.gap):
        contacts.first[count], contacts.second[count] = first, second
        put(contacts.point, count, point)
        put(contacts.normal, count, normal)
        contacts.gap[count], contacts.area[count], contacts.key[count] = gap, area, key
    return count + 1


@lent
def merge_depth(contacts: Contacts, begin: int, count: int, depth: Vector, near: float) -> int:
    """Merge contacts from row `begin` on whose points differ only along the depth of a plane scene.

    near: distance in the plane [m] below which points coincide. Returns the number of contacts.
    """
    if count > len(contacts.gap) or depth[0] == depth[1] == depth[2] == 0.0:
        return count
    along, kept = (depth[0], depth[1], depth[2]), begin
    for k in range(begin, count):
        point, same = at(contacts.point, k), -1
        for m in range(begin, kept):
            apart = add_scaled(point, -1.0, at(contacts.point, m))
            flat = add_scaled(apart, -dot(apart, along), along)
            if dot(flat, flat) <= near * near:
                same = m
        if same < 0:
            same, kept = kept, kept + 1
            add(
                contacts, same, contacts.first[k], contacts.second[k], point,
                at(contacts.normal, k), contacts.gap[k], contacts.area[k], contacts.key[k],
            )  # fmt: skip
        else:
            contacts.area[same] += contacts.area[k]
            contacts.key[same] = smaller(contacts.key[same], contacts.key[k])
    return kept


@called
def touch_blocks(
    contacts: Contacts, count: int, a: int, b: int, pair: int,
    shapes: Shapes, vertex: Vector, normal: Vector, depth: Vector, margin: float,
) -> int:  # fmt: skip
    """Add the contacts between blocks a < b; a key is `pair` plus a number for the features."""
    kind, one, two, gap, axis = separation(a, b, shapes, vertex, normal, depth, margin)
    if gap > margin:
        return count
    labels = len(vertex) + 2 * len(shapes.corner)
    if kind == EDGES:
        key = pair + len(normal) * labels + one * len(shapes.edge) + two
        return add(contacts, count, a, b, crossing(one, two, shapes, vertex), axis, gap, 0.0, key)
    size, begin = smaller(shapes.size[a], shapes.size[b]), count
    other, sign = (b, 1.0) if kind == FACE_OF_FIRST else (a, -1.0)
    points, polygon, height, label, area = face_points(one, other, shapes, vertex, normal, size)
    n = at(normal, one)
    for k in range(points):
        if height[k] <= margin:
            half = add_scaled(at(polygon, k), -0.5 * height[k], n)
            axis = (sign * n[0], sign * n[1], sign * n[2])
            key = pair + one * labels + label[k]
            count = add(contacts, count, a, b, half, axis, height[k], area / points, key)
    return merge_depth(contacts, begin, count, depth, SAME * size)


@lent
def touch_wall(
    contacts: Contacts, count: int, wall: int, block: int, body: int, pair: int,
    shapes: Shapes, vertex: Vector, normal: Vector,
    planes: Planes, shift: Vector, depth: Vector, margin: float,
) -> int:  # fmt: skip
    """Add the contacts of a block's vertices with a wall, whose body number is `body`."""
    n = at(planes.normal, wall)
    level = dot(n, add_scaled(at(planes.point, wall), 1.0, at(shift, wall)))
    begin = count
    for k in range(shapes.vertex_start[block], shapes.vertex_start[block + 1]):
        gap = dot(n, at(vertex, k)) - level
        if gap <= margin:
            half = add_scaled(at(vertex, k), -0.5 * gap, n)
            count = add(contacts, count, body, block, half, n, gap, 0.0, pair + k)
    if count > begin and count <= len(contacts.gap):
        share_face(contacts, begin, count, pair, shapes, vertex, facing(shapes, normal, block, n))
    return merge_depth(contacts, begin, count, depth, SAME * shapes.size[block])


@called
def share_face(
    contacts: Contacts, begin: int, count: int, pair: int,
    shapes: Shapes, vertex: Vector, face: int,
) -> None:  # fmt: skip
    """Give the contacts at a face's vertices equal shares of its area, projected on the wall."""
    first, last = shapes.corner_start[face], shapes.corner_start[face + 1]
    many = last - first
    polygon = rows(many)
    for c in range(first, last):
        put(polygon, c - first, at(vertex, shapes.corner[c]))
    area = area_of(polygon, many, at(contacts.normal, begin)) / many
    for k in range(begin, count):
        for c in range(first, last):
            if contacts.key[k] - pair == shapes.corner[c]:
                contacts.area[k] = area


@called
def detect(
    contacts: Contacts, shapes: Shapes, vertex: Vector, normal: Vector, moves: Mask,
    planes: Planes, shift: Vector, depth: Vector, margin: float,
) -> int:  # fmt: skip
    """Fill `contacts` with all points of gap up to `margin` [m]; return their number.

    vertex, normal: the placed shapes; moves: (n,) False for fixed blocks, which have no contacts
    with each other or with walls; planes, shift: the walls and their displacements (w, 3) [m];
    depth: see `depth_axis`. If the number exceeds the length of the arrays, their contents are
    invalid.
    """
    blocks, walls = len(shapes.size), len(planes.point)
    labels = len(vertex) + 2 * len(shapes.corner)
    span = len(normal) * labels + len(shapes.edge) * len(shapes.edge)
    # a literal 0 has a type of its own, for which numba would compile all callees once more
    along, count = (depth[0], depth[1], depth[2]), 0 * blocks
    for wall in range(walls):
        if abs(dot(along, at(planes.normal, wall))) < 0.5:
            for block in range(blocks):
                if moves[block]:
                    pair = ((blocks + wall) * (blocks + walls) + block) * span
                    count = touch_wall(
                        contacts, count, wall, block, blocks + wall, pair,
                        shapes, vertex, normal, planes, shift, depth, margin,
                    )  # fmt: skip
    for code in close_pairs(shapes, vertex, moves, margin):
        a, b = code // blocks, code % blocks
        pair = (a * (blocks + walls) + b) * span
        count = touch_blocks(contacts, count, a, b, pair, shapes, vertex, normal, depth, margin)
    return count


@compiled
def detect_contacts(
    contacts: Contacts, shapes: Shapes, vertex: Vector, normal: Vector, moves: Mask,
    planes: Planes, shift: Vector, depth: Vector, margin: float,
) -> int:  # fmt: skip
    """`detect`, for calls from Python."""
    return detect(contacts, shapes, vertex, normal, moves, planes, shift, depth, margin)


@called
def matched(key: Index, count: int, old: Index) -> Index:
    """The row (count,) in `old` of each of the first `count` keys, or -1 if it is not there."""
    now, then = ordered(key, count), ordered(old, len(old))
    found, m = counts(count), 0
    for k in now:
        while m < len(old) and old[then[m]] < key[k]:
            m += 1
        found[k] = then[m] if m < len(old) and old[then[m]] == key[k] else -1
    return found

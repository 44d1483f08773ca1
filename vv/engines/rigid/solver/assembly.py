"""Kernels for the relative velocities and impulses of detected contacts: J, J^T and J W J^T.

Bodies are numbered as in blocks/contacts.py: n blocks, then the walls. Their velocities are rows of
v, w (b, 3) [m/s, 1/s]. Their inverse masses and inertias, `inverse` and `inverse_spin`
(b, 3, 3) [1/kg, 1/(kg m2)], are projected on the free directions and zero for walls, so that one
form of J serves blocks and walls, in a plane and in space. J is never stored: a contact consists of
two bodies and two lever arms.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.blocks.contacts import Contacts
from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import numbers, rows, same_counts, same_rows
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called, inlined, lent
from vv.engines.kernels.triples import Triple, add_scaled, at, cross, dot, put
from vv.scene import Vector

MOBILE = 1e-12  # ratio of mobilities below which the less mobile direction is locked


@bundle
class Bodies(NamedTuple):
    """inverse, inverse_spin: (b, 3, 3) in the scene's frame; centre: (b, 3) [m], zero for walls."""

    inverse: Vector
    inverse_spin: Vector
    centre: Vector


@bundle
class Joints(NamedTuple):
    """The c contacts in the form that the solver uses.

    first, second: (c,) bodies; normal: (c, 3); arm_first, arm_second: (c, 3) from the centres [m];
    pull: (c, 3) relative velocity by a unit impulse along the normal [1/kg]; across: (c,) its
    normal part, the mobility along the normal [1/kg]; along: (c,) the largest mobility in the
    tangent plane [1/kg]. Mobilities are zero where both bodies are locked.
    """

    first: Index
    second: Index
    normal: Vector
    arm_first: Vector
    arm_second: Vector
    pull: Vector
    across: Vector
    along: Vector


@inlined
def times(matrices: Vector, i: int, a: Triple) -> Triple:
    """matrices[i] @ a, with matrices (b, 3, 3)."""
    m = matrices
    return (
        m[i, 0, 0] * a[0] + m[i, 0, 1] * a[1] + m[i, 0, 2] * a[2],
        m[i, 1, 0] * a[0] + m[i, 1, 1] * a[1] + m[i, 1, 2] * a[2],
        m[i, 2, 0] * a[0] + m[i, 2, 1] * a[1] + m[i, 2, 2] * a[2],
    )


@inlined
def relative(joints: Joints, c: int, v: Vector, w: Vector) -> Triple:
    """The velocity of the second body relative to the first at contact c [m/s]: a row of J v."""
    a, b = joints.first[c], joints.second[c]
    one = add_scaled(at(v, a), 1.0, cross(at(w, a), at(joints.arm_first, c)))
    return add_scaled(
        add_scaled(at(v, b), 1.0, cross(at(w, b), at(joints.arm_second, c))), -1.0, one
    )


@inlined
def apply(joints: Joints, c: int, bodies: Bodies, v: Vector, w: Vector, p: Triple) -> None:
    """Add W J^T p to the velocities, for an impulse p [N s] on the second body at contact c."""
    a, b = joints.first[c], joints.second[c]
    put(v, b, add_scaled(at(v, b), 1.0, times(bodies.inverse, b, p)))
    moment = cross(at(joints.arm_second, c), p)
    put(w, b, add_scaled(at(w, b), 1.0, times(bodies.inverse_spin, b, moment)))
    put(v, a, add_scaled(at(v, a), -1.0, times(bodies.inverse, a, p)))
    moment = cross(at(joints.arm_first, c), p)
    put(w, a, add_scaled(at(w, a), -1.0, times(bodies.inverse_spin, a, moment)))


@lent
def apply_nonzero(joints: Joints, c: int, bodies: Bodies, v: Vector, w: Vector, p: Triple) -> None:
    """The same as `apply`, for p other than zero; not inlined, for code that runs seldom."""
    if dot(p, p) > 0.0:
        apply(joints, c, bodies, v, w, p)


@inlined
def local_response(joints: Joints, c: int, bodies: Bodies, p: Triple) -> Triple:
    """The relative velocity at contact c by an impulse p at it: J W J^T p."""
    a, b = joints.first[c], joints.second[c]
    one, two = at(joints.arm_first, c), at(joints.arm_second, c)
    u = add_scaled(times(bodies.inverse, a, p), 1.0, times(bodies.inverse, b, p))
    u = add_scaled(u, 1.0, cross(times(bodies.inverse_spin, a, cross(one, p)), one))
    return add_scaled(u, 1.0, cross(times(bodies.inverse_spin, b, cross(two, p)), two))


@inlined
def tangents(n: Triple) -> tuple[Triple, Triple]:
    """Two unit vectors perpendicular to n and to each other."""
    least = (1.0, 0.0, 0.0)
    if abs(n[0]) > 0.6:
        least = (0.0, 1.0, 0.0)
    one = add_scaled(least, -dot(least, n), n)
    one = add_scaled((0.0, 0.0, 0.0), 1.0 / np.sqrt(dot(one, one)), one)
    return one, cross(n, one)


@called
def assemble(contacts: Contacts, count: int, bodies: Bodies) -> Joints:
    """The joints of the first `count` contacts, with arrays of their own."""
    joints = Joints(
        same_counts(contacts.first, count),
        same_counts(contacts.second, count),
        same_rows(contacts.normal, count),
        rows(count),
        rows(count),
        rows(count),
        numbers(count),
        numbers(count),
    )
    for c in range(count):
        point = at(contacts.point, c)
        put(joints.arm_first, c, add_scaled(point, -1.0, at(bodies.centre, joints.first[c])))
        put(joints.arm_second, c, add_scaled(point, -1.0, at(bodies.centre, joints.second[c])))
        n = at(joints.normal, c)
        pull = local_response(joints, c, bodies, n)
        put(joints.pull, c, pull)
        joints.across[c] = dot(n, pull)
        one, two = tangents(n)
        of_one, of_two = (
            local_response(joints, c, bodies, one),
            local_response(joints, c, bodies, two),
        )
        mean = 0.5 * (dot(one, of_one) + dot(two, of_two))
        apart = 0.5 * (dot(one, of_one) - dot(two, of_two))
        joints.along[c] = mean + np.hypot(apart, dot(one, of_two))
        if joints.across[c] <= MOBILE * joints.along[c]:
            joints.across[c] = 0.0
        if joints.along[c] <= MOBILE * joints.across[c]:
            joints.along[c] = 0.0
    return joints

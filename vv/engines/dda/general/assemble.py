"""Assembles inertia, strains and springs into the equations of one step, or of Newton; kernels."""

from __future__ import annotations

from vv.engines.blocks.geometry import Index
from vv.engines.dda.general.bodies import Bodies
from vv.engines.dda.general.contact import Touch
from vv.engines.dda.general.setting import Law, Part, Setting, Work
from vv.engines.dda.law import OPEN, SLIDE, STICK
from vv.engines.kernels.arrays import smaller
from vv.engines.kernels.compiled import inlined, lent
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot
from vv.scene import Vector


@lent
def fill_profile(first: Index, bodies: Bodies, touch: Touch) -> None:
    """Fill first (q,): the first column in each row of the matrix that may differ from zero."""
    for i in range(len(bodies.mass)):
        for a in range(bodies.start[i], bodies.start[i + 1]):
            first[a] = bodies.start[i]
    for k in range(len(touch.key)):
        least = len(first)
        for m in range(touch.columns[k]):
            least = smaller(least, touch.column[k, m])
        for m in range(touch.columns[k]):
            a = touch.column[k, m]
            first[a] = smaller(first[a], least)


@lent
def assemble_stiffness(
    work: Work, touch: Touch, state: Index, setting: Setting, law: Law, part: Part
) -> None:
    """Fill the lower half of the matrix: weight/D^2 M + strains + springs of closed contacts."""
    matrix, first, mass = work.matrix, work.first, work.mass
    bodies, elastic, kn, ks = setting.bodies, setting.elastic, law.kn, law.ks
    scale = part.weight / (part.length * part.length)
    for a in range(len(first)):
        for b in range(first[a], a + 1):
            matrix[a, b] = 0.0
    for i in range(len(bodies.mass)):
        begin = bodies.start[i]
        for a in range(begin, bodies.start[i + 1]):
            for b in range(begin, a + 1):
                matrix[a, b] = scale * mass[a, b - begin] + elastic[a, b - begin]
    for k in range(len(touch.key)):
        if state[k] != OPEN:
            n = at(touch.normal, k)
            shear = ks if state[k] == STICK else 0.0
            for m in range(touch.columns[k]):
                one = at(touch.field[k], m)
                along = dot(one, n)
                for j in range(touch.columns[k]):
                    a, b = touch.column[k, m], touch.column[k, j]
                    if b <= a:
                        two = at(touch.field[k], j)
                        press = (kn - shear) * along * dot(two, n)
                        matrix[a, b] += press + shear * dot(one, two)


@inlined
def force_decrease(
    n: Triple,
    direction: Triple,
    state: int,
    turn: float,
    kn: float,
    ks: float,
    mu: float,
    opened: float,
    flat: Triple,
) -> Triple:
    """The decrease of a contact's force [N] as it opens [m] and slips by `flat` [m].

    turn: mu N/|trial| [N/m].
    """
    fall = add_scaled(NOWHERE, kn * opened, n)
    if state == STICK:
        return add_scaled(fall, ks, flat)
    fall = add_scaled(fall, -mu * kn * opened, direction)
    return add_scaled(fall, turn, add_scaled(flat, -dot(direction, flat), direction))


@lent
def assemble_tangent(
    touch: Touch, turn: Vector, work: Work, setting: Setting, law: Law, part: Part
) -> None:
    """Fill the matrix in its profile: inertia, strains, and derivatives of contact forces.

    turn: (c,) see `force_decrease`.
    """
    matrix, first, mass = work.matrix, work.first, work.mass
    bodies, elastic, kn, ks, mu = setting.bodies, setting.elastic, law.kn, law.ks, law.mu
    scale = part.weight / (part.length * part.length)
    for a in range(len(first)):
        for b in range(first[a], a + 1):
            matrix[a, b] = matrix[b, a] = 0.0
    for i in range(len(bodies.mass)):
        begin, end = bodies.start[i], bodies.start[i + 1]
        for a in range(begin, end):
            for b in range(begin, end):
                matrix[a, b] = scale * mass[a, b - begin] + elastic[a, b - begin]
    for k in range(len(touch.key)):
        if touch.state[k] != OPEN:
            n, direction = at(touch.normal, k), at(touch.direction, k)
            for j in range(touch.columns[k]):
                one = at(touch.field[k], j)
                along = dot(one, n)
                flat = add_scaled(one, -along, n)
                fall = force_decrease(
                    n, direction, touch.state[k], turn[k], kn, ks, mu, along, flat
                )
                for m in range(touch.columns[k]):
                    matrix[touch.column[k, m], touch.column[k, j]] += dot(
                        at(touch.field[k], m), fall
                    )


@lent
def apply_loads(outer: Vector, bodies: Bodies, shake: Triple) -> None:
    """Fill outer (q,) with the generalised forces of weight, dead loads and shaking [m/s2]."""
    for i in range(len(bodies.mass)):
        load = add_scaled(at(bodies.weight, i), 1.0, at(bodies.load, i))
        load = add_scaled(load, bodies.mass[i], shake)
        for a in range(bodies.start[i], bodies.start[i + 1]):
            outer[a] = dot(at(bodies.line, a), load)


@lent
def contact_force(
    k: int, touch: Touch, state: int, force: float, direction: Triple, moved: Triple, law: Law
) -> Triple:
    """The force [N] of contact k on its second body for zero unknowns.

    moved: the displacement of the wall [m]; state, force, direction: the assumed state, normal
    force [N] and direction opposite to friction.
    """
    pull = NOWHERE
    if state != OPEN:
        n = at(touch.normal, k)
        closing = dot(n, moved)
        pull = add_scaled(pull, -law.kn * (touch.gap[k] - closing), n)
        if state == STICK:
            stretch = add_scaled(at(touch.spring, k), -1.0, add_scaled(moved, -closing, n))
            pull = add_scaled(pull, -law.ks, stretch)
        if state == SLIDE:
            pull = add_scaled(pull, -law.mu * force, direction)
    return pull

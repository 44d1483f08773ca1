"""Contact points: their state from step to step, and kernels that detect them anew for a step."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.blocks.contacts import Contacts, detect, empty_contacts, matched
from vv.engines.blocks.geometry import Index
from vv.engines.dda.general.algebra.matrices import times_vector
from vv.engines.dda.general.bodies import Bodies, Motion
from vv.engines.dda.general.setting import Law, Setting
from vv.engines.dda.law import STICK
from vv.engines.kernels import rooms
from vv.engines.kernels.arrays import (
    counts,
    same_counts,
    same_numbers,
    same_rows,
    zero_counts,
    zero_numbers,
    zero_rows,
)
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot, put
from vv.scene import Vector

MOST = 24  # the most unknowns that a contact depends on: twelve of each block


@bundle
class Touch(NamedTuple):
    """The data of c contact points, in the order of detection.

    key: (c,); state: (c,) open, stick or slide; spring: (c, 3) tangential stretch [m]; push: (c,)
    normal force [N]; direction: (c, 3) unit vector opposite to friction on the second body; gap:
    (c,) [m]; normal: (c, 3); wall: (c,) number of the wall or -1; column: (c, MOST) unknowns;
    field: (c, MOST, 3) relative displacement of the second body per unknown; columns: (c,) number
    of unknowns; first, second: (c,) bodies; force: (c, 3) on the second body in the step [N].
    """

    key: Index
    state: Index
    spring: Vector
    push: Vector
    direction: Vector
    gap: Vector
    normal: Vector
    wall: Index
    column: Index
    field: Vector
    columns: Index
    first: Index
    second: Index
    force: Vector


@called
def contact_arrays(count: int) -> Touch:
    """Arrays for so many contact points, all open."""
    return Touch(
        zero_counts(count), zero_counts(count), zero_rows(count),
        zero_numbers(count), zero_rows(count), zero_numbers(count), zero_rows(count),
        zero_counts(count), rooms.count_table(count, MOST),
        rooms.row_table(count, MOST), zero_counts(count),
        counts(count), counts(count), zero_rows(count),
    )  # fmt: skip


@bundle
class States(NamedTuple):
    """Of contact points what an iteration changes, see `Touch`: copies from before it."""

    state: Index
    push: Vector
    direction: Vector
    spring: Vector


@called
def states_of(touch: Touch) -> States:
    """The present states of contacts."""
    count = len(touch.key)
    return States(
        same_counts(touch.state, count), same_numbers(touch.push, count),
        same_rows(touch.direction, count), same_rows(touch.spring, count),
    )  # fmt: skip


@lent
def restore_states(touch: Touch, before: States) -> None:
    """Restore the states of contacts after an iteration whose result is not used."""
    for k in range(len(touch.key)):
        touch.state[k], touch.push[k] = before.state[k], before.push[k]
        put(touch.direction, k, at(before.direction, k))
        put(touch.spring, k, at(before.spring, k))


@lent
def close_initial(touch: Touch, displacement: Vector, law: Law) -> None:
    """Set the points that overlap at the start to stick, with the normal forces of their springs.

    displacement: unknowns (q,) of the displacement from the positions in the scene; with hold 1 the
    tangential springs are stretched by it, as far as friction allows.
    """
    for k in range(len(touch.key)):
        if touch.gap[k] < 0.0:
            touch.state[k], touch.push[k] = STICK, -law.kn * touch.gap[k]
            spring, n = NOWHERE, at(touch.normal, k)
            for m in range(touch.columns[k]):
                spring = add_scaled(spring, displacement[touch.column[k, m]], at(touch.field[k], m))
            spring = add_scaled(spring, -dot(spring, n), n)
            force, limit = law.ks * np.sqrt(dot(spring, spring)), law.mu * touch.push[k]
            part = 1.0 if force <= limit else limit / force
            put(touch.spring, k, add_scaled(NOWHERE, law.hold * part, spring))


@lent
def add_columns(
    touch: Touch, k: int, body: int, sign: float, point: Vector, bodies: Bodies, motion: Motion
) -> None:
    """Add the unknowns of a body to those on which point k depends."""
    arm = add_scaled(at(point, k), -1.0, at(motion.centre, body))
    for a in range(bodies.start[body], bodies.start[body + 1]):
        m = touch.columns[k]
        touch.column[k, m] = a
        moved = add_scaled(at(bodies.line, a), 1.0, times_vector(bodies.slope[a], arm))
        put(touch.field[k], m, add_scaled(NOWHERE, sign, moved))
        touch.columns[k] = m + 1


@lent
def relative_motion(k: int, touch: Touch, u: Vector, shut: Vector) -> Triple:
    """The displacement [m] of the second body of contact k relative to the first.

    u: (q,) unknowns; shut: (c, 3) displacements of walls [m].
    """
    moves = add_scaled(NOWHERE, -1.0, at(shut, k))
    for m in range(touch.columns[k]):
        moves = add_scaled(moves, u[touch.column[k, m]], at(touch.field[k], m))
    return moves


@lent
def opening(k: int, touch: Touch, u: Vector, shut: Vector) -> float:
    """The part of `relative_motion` along the normal [m], without the rounding of slip.

    A step of 5 mm along a groove is rounded by 1e-18 m; springs that support a wedge of 1e-7 rad in
    steps of 1 ms turn that into 1e-5 of the force on a side.
    """
    n = at(touch.normal, k)
    opened = -dot(at(shut, k), n)
    for m in range(touch.columns[k]):
        opened += u[touch.column[k, m]] * dot(at(touch.field[k], m), n)
    return opened


@lent
def rotated_into_plane(a: Triple, n: Triple) -> Triple:
    """The vector a rotated into the plane normal to n, at constant length."""
    flat = add_scaled(a, -dot(a, n), n)
    before, after = np.sqrt(dot(a, a)), np.sqrt(dot(flat, flat))
    return add_scaled(NOWHERE, before / after, flat) if after > 0.0 else NOWHERE


@lent
def copy_state(touch: Touch, k: int, old: Touch, m: int) -> None:
    """Copy the state of old point m to point k; rotate its spring into the new contact plane."""
    n = at(touch.normal, k)
    touch.state[k], touch.push[k] = old.state[m], old.push[m]
    put(touch.spring, k, rotated_into_plane(at(old.spring, m), n))
    put(touch.direction, k, rotated_into_plane(at(old.direction, m), n))


@called
def find_contacts(old: Touch, setting: Setting, motion: Motion, shift: Vector) -> Touch:
    """The contact points within `setting.reach`, with the states of the same points in `old`.

    shift: (w, 3) the displacements of walls [m].
    """
    bodies, shapes, moves, planes = setting.bodies, setting.shapes, setting.moves, setting.planes
    depth, reach = setting.depth, setting.reach
    room = 16 + 2 * len(old.key)
    contacts: Contacts = empty_contacts(room)
    count = detect(
        contacts, shapes, motion.vertex, motion.normal, moves, planes, shift, depth, reach
    )
    if count > room:
        contacts = empty_contacts(count)
        count = detect(
            contacts, shapes, motion.vertex, motion.normal, moves, planes, shift, depth, reach
        )
    touch, blocks = contact_arrays(count), len(bodies.mass)
    before = matched(contacts.key, count, old.key)
    for k in range(count):
        first, second = contacts.first[k], contacts.second[k]
        touch.key[k], touch.gap[k] = contacts.key[k], contacts.gap[k]
        put(touch.normal, k, at(contacts.normal, k))
        touch.first[k], touch.second[k] = first, second
        touch.wall[k] = first - blocks if first >= blocks else -1
        add_columns(touch, k, second, 1.0, contacts.point, bodies, motion)
        if first < blocks:
            add_columns(touch, k, first, -1.0, contacts.point, bodies, motion)
        if before[k] >= 0:
            copy_state(touch, k, old, before[k])
    return touch

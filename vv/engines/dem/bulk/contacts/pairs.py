"""The forces of all pairs that touch, one batch at a time; parts of kernels.

Touching pairs are chosen from the list, the motion of their spheres is copied to scratch, the
contacts are computed in vectorised loops, and the forces are added to the spheres.
"""

from __future__ import annotations

import math

from vv.engines.dem.bonds.block_forces import store_vector, vector_of
from vv.engines.dem.bonds.blocks import WIDE
from vv.engines.dem.bulk.batches import LOST, NORMAL, SPRUNG
from vv.engines.dem.bulk.contacts.gather import (
    ACROSS,
    ALONG,
    ARMS,
    CAPS,
    CHANGED,
    FORCE,
    HOW_LONG,
    INSIDE,
    MIDWAY,
    NORMALS,
    OFFSET,
    OLD,
    RADII,
    RELATIVE,
    ROLLED,
    SLIDE,
    SPINS,
    SPRING,
    STIFF,
    TORQUE,
    add_forces,
    choose_touching,
    gather_motion,
    rounded_up,
)
from vv.engines.dem.bulk.contacts.slip import limit_friction
from vv.engines.dem.bulk.crowd import Crowd
from vv.engines.dem.contact.friction import share_closed, slide_in_step, trial_force
from vv.engines.dem.contact.law import Law, normal_force, shear_energy, shear_stiffness
from vv.engines.dem.contact.pairs import normals_in_step
from vv.engines.dem.contact.touch import Touch
from vv.engines.kernels.compiled import inlined, lent
from vv.engines.kernels.triples import NOWHERE, add_scaled, cross, dot
from vv.scene import Vector


@lent
def add_pair_forces(
    crowd: Crowd,
    c: int,
    some: tuple[int, int],
    beyond: tuple[int, int],
    with_energy: bool,
    law: Law,
    friction: tuple[float, float] | None,
    viscous: float | None,
) -> None:
    """Add the forces of pairs some[0] to some[1]; add the dissipated energy to the sums of chunk c.

    beyond: the sphere from which on forces go to spare rows, and the offset of these rows.
    with_energy: whether the energies of springs are summed.
    """
    grains, pairs, work, dt = crowd.grains, crowd.pairs, crowd.work, crowd.rules.dt
    scratch, ends = work.scratch, work.ends
    many = choose_touching(grains, pairs, scratch, ends, c, some, friction)
    gather_motion(grains.row, pairs, scratch, ends, c, many, friction, viscous)
    full = rounded_up(many)
    if friction is None:
        forces_without_friction(scratch, c, full, law)
    else:
        trial_forces(scratch, c, full, law, viscous, dt)
        work.sums[c, LOST] += limit_friction(grains.row, scratch, ends, c, many)
        total_forces(scratch, c, full)
    if with_energy:
        add_energies(work.sums, scratch, c, many, law, friction)
    add_forces(grains, pairs, scratch, ends, c, many, beyond, friction)


@inlined
def forces_without_friction(scratch: Vector, c: int, many: int, law: Law) -> None:
    """Compute the forces of contacts without friction."""
    for q in range(many):
        d = vector_of(scratch, c, OFFSET, q)
        first, second = scratch[c, RADII * WIDE + q], scratch[c, (RADII + 1) * WIDE + q]
        length = math.sqrt(dot(d, d))
        overlap = first + second - length
        along = normal_force(law, overlap, first * second / (first + second))[0]
        scratch[c, ARMS * WIDE + q] = first - 0.5 * overlap
        store_vector(scratch, c, FORCE, q, add_scaled(NOWHERE, along / length, d))


@inlined
def trial_forces(
    scratch: Vector, c: int, many: int, law: Law, viscous: float | None, dt: float
) -> None:
    """Compute the trial forces of contacts with friction, and the data for `limit_friction`."""
    for q in range(many):
        d, relative = vector_of(scratch, c, OFFSET, q), vector_of(scratch, c, RELATIVE, q)
        first, second = scratch[c, RADII * WIDE + q], scratch[c, (RADII + 1) * WIDE + q]
        length = math.sqrt(dot(d, d))
        overlap, n = first + second - length, add_scaled(NOWHERE, 1.0 / length, d)
        n_before, m, opened = normals_in_step(d, length, relative, dt)
        rates = 0.0, 0.0
        if viscous is not None:
            change = vector_of(scratch, c, CHANGED, q)
            rates = (
                dot(n_before, add_scaled(relative, -0.5, change)),
                dot(n, add_scaled(relative, 0.5, change)),
            )
        inside, spins = 0.5 * (overlap + 0.5 * opened), vector_of(scratch, c, SPINS, q)
        rolled = add_scaled(vector_of(scratch, c, ROLLED, q), -inside, spins)
        past = add_scaled(relative, -1.0, cross(rolled, m))
        twist = 0.5 * dt * dot(spins, m)
        touch = Touch(overlap, opened, n, n_before, m, rates, past, NOWHERE, twist)
        reduced, spring = first * second / (first + second), vector_of(scratch, c, SPRING, q)
        along = normal_force(law, overlap, reduced)[0]
        ks, caps = shear_stiffness(law, touch, reduced, 0.0, spring)  # laws here need no mass
        old, slide, trial = trial_force(spring, touch, slide_in_step(touch, dt)[0], ks)
        scratch[c, ALONG * WIDE + q] = along
        store_vector(scratch, c, NORMALS, q, n)
        store_vector(scratch, c, ACROSS, q, trial)
        store_vector(scratch, c, OLD, q, old)
        store_vector(scratch, c, SLIDE, q, slide)
        store_vector(scratch, c, MIDWAY, q, m)
        scratch[c, STIFF * WIDE + q] = ks
        scratch[c, CAPS * WIDE + q], scratch[c, (CAPS + 1) * WIDE + q] = caps
        scratch[c, HOW_LONG * WIDE + q] = dt * share_closed(overlap, opened)
        scratch[c, INSIDE * WIDE + q] = inside
        scratch[c, ARMS * WIDE + q] = first - 0.5 * overlap
        scratch[c, (ARMS + 1) * WIDE + q] = second - 0.5 * overlap


@inlined
def total_forces(scratch: Vector, c: int, many: int) -> None:
    """Compute the total force, and the torque for an arm of one metre."""
    for q in range(many):
        n, force = vector_of(scratch, c, NORMALS, q), vector_of(scratch, c, ACROSS, q)
        store_vector(scratch, c, FORCE, q, add_scaled(force, scratch[c, ALONG * WIDE + q], n))
        store_vector(scratch, c, TORQUE, q, cross(force, n))


@inlined
def add_energies(
    sums: Vector,
    scratch: Vector,
    c: int,
    many: int,
    law: Law,
    friction: tuple[float, float] | None,
) -> None:
    """Add the energy [J] of the springs of a batch to the sums of chunk c."""
    for q in range(many):
        first, second = scratch[c, RADII * WIDE + q], scratch[c, (RADII + 1) * WIDE + q]
        reduced, overlap = (
            first * second / (first + second),
            2.0 * (first - scratch[c, ARMS * WIDE + q]),
        )
        sums[c, NORMAL] += normal_force(law, overlap, reduced)[1]
        if friction is not None:
            sums[c, SPRUNG] += shear_energy(law, overlap, reduced, vector_of(scratch, c, ACROSS, q))

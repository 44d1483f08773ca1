"""Kernels for the inertial loads that arise as a block rotates and deforms.

A point r from the centre has the velocity L r and the acceleration (dL/dt + L L) r. The first part
is the inertia of a DDA step. The second loads unknown a, of slope S_a, by -tr(S_a M (L L)^T), with
the second moment M: for a rotation the gyroscopic torque -w x I w, for a strain the centrifugal
load. It equals tr(S_a L M L^T), which is zero for a rotation, minus the rate of tr(S_a M L^T)
through M alone. Evaluated over a whole step, it conserves the angular momentum of blocks that spin
without contact.
"""

from __future__ import annotations

from vv.engines.dda.general.algebra.linear import factorise, substitute
from vv.engines.dda.general.algebra.matrices import congruent, moment_product
from vv.engines.dda.general.bodies import (
    Bodies,
    Motion,
    fill_deformation,
    fill_gradient,
    times_blocks,
)
from vv.engines.kernels.arrays import (
    numbers,
    rows,
    same_numbers,
    zero_counts,
    zero_numbers,
    zero_table,
)
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import at, dot
from vv.scene import Vector


@lent
def has_rotational_loads(bodies: Bodies, i: int, rate: Vector) -> bool:
    """Whether block i rotates, and has more unknowns without translation than one rotation.

    A single rotation has no such load.
    """
    several, moves = 0, False
    for a in range(bodies.start[i], bodies.start[i + 1]):
        if dot(at(bodies.line, a), at(bodies.line, a)) == 0.0:
            several += 1
            moves = moves or rate[a] != 0.0
    return several > 1 and moves


@called
def rotational_loads(
    turn: Vector, bodies: Bodies, motion: Motion, mass: Vector, elastic: Vector,
    step: float, terms: int, rounds: int,
) -> None:  # fmt: skip
    """Fill turn (q,) with these loads [N m] over a step [s], in which only elasticity acts besides.

    mass, elastic: (q, 12), see `fill_masses`; terms: see `fill_deformation`; rounds: of the
    iteration for the loads and the motion at the end of the step, which depend on each other; 0 for
    no loads. It is one function since all of its parts share the arrays that it allocates.
    """
    q = len(turn)
    begin, whole, second, flow, end = rows(3), rows(3), rows(3), rows(3), rows(3)
    matrix, load, gain = zero_table(12, 12), zero_numbers(12), zero_numbers(12)
    ahead, d = same_numbers(motion.velocity, q), zero_numbers(q)
    reached, borne = numbers(q), numbers(q)
    for a in range(len(turn)):
        reached[a] = motion.strain[a] + step * motion.velocity[a]
    times_blocks(borne, elastic, bodies, reached)
    for i in range(len(bodies.mass)):
        first, last = bodies.start[i], bodies.start[i + 1]
        for a in range(first, last):
            turn[a] = 0.0
        if rounds == 0 or not has_rotational_loads(bodies, i, motion.velocity):
            continue
        fill_gradient(begin, bodies, first, last, motion.velocity)
        congruent(flow, begin, motion.second[i])
        for a in range(first, last):
            for b in range(a - first + 1):
                matrix[a - first, b] = mass[a, b] + 0.5 * step * step * elastic[a, b]
        columns = zero_counts(last - first)
        factorise(matrix, columns)
        for _ in range(rounds):
            for a in range(first, last):
                d[a] = 0.5 * step * (motion.velocity[a] + ahead[a])
            fill_deformation(whole, bodies, i, d, terms)
            congruent(second, whole, motion.second[i])
            fill_gradient(end, bodies, first, last, ahead)
            for a in range(first, last):
                slope = bodies.slope[a]
                load[a - first] = moment_product(motion.second[i], slope, end)
                load[a - first] -= moment_product(second, slope, end)
                for r in range(3):
                    load[a - first] += step * dot(at(slope, r), at(flow, r))
            for a in range(first, last):
                turn[a] = load[a - first] / step
                load[a - first] -= step * borne[a]
            substitute(matrix, columns, load, gain)
            for a in range(first, last):
                ahead[a] = motion.velocity[a] + gain[a - first]

"""The unknowns of DDA as coefficients of displacement fields, and kernels that move blocks by them.

Each block has the displacement u(x) = sum over its unknowns of d_a (line_a + slope_a (x - c)):
translations, rotations and, if it is elastic, strains (Yagoda-Biran 2016, Eqs. 2-4, in space).
"""

from __future__ import annotations

from typing import NamedTuple

from vv.engines.blocks.geometry import Index, Shapes
from vv.engines.blocks.placement import find_normals
from vv.engines.dda.general.algebra.matrices import (
    congruent,
    fill_exponential,
    moment_product,
    times_vector,
)
from vv.engines.kernels.arrays import rows
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot, put
from vv.scene import Vector


@bundle
class Bodies(NamedTuple):
    """The data of n blocks with q unknowns that do not change.

    start: (n + 1,) block i has the unknowns start[i] to start[i + 1] (exclusive); line: (q, 3);
    slope: (q, 3, 3); strains: (n,) the first unknown of each block that is a strain, strains being
    the last; mass: (n,) [kg]; weight, load: (n, 3) forces [N].
    """

    start: Index
    line: Vector
    slope: Vector
    strains: Index
    mass: Vector
    weight: Vector
    load: Vector


@bundle
class Motion(NamedTuple):
    """The positions and velocities of blocks.

    vertex: (v, 3) [m]; normal: (f, 3); centre: (n, 3) [m]; rounded: (n, 3) the rounding error of
    the centre [m], carried so that 1e5 steps do not add up to 1e-12 of the displacement; second:
    (n, 3, 3) integral of rho r r^T about the centre [kg m2]; velocity: (q,); strain: (q,) sums of
    all d, of which only those of strains are used; they rotate with their block.
    """

    vertex: Vector
    normal: Vector
    centre: Vector
    rounded: Vector
    second: Vector
    velocity: Vector
    strain: Vector


@lent
def only_shifts(bodies: Bodies) -> bool:
    """Whether no block can rotate or deform."""
    shifts = True
    for a in range(len(bodies.line)):
        shifts = shifts and dot(at(bodies.line, a), at(bodies.line, a)) > 0.0
    return shifts


@lent
def copy_rows(to: Vector, source: Vector) -> None:
    """Copy a (k, 3) array to another; numba would take seconds to compile slices."""
    for k in range(len(to)):
        put(to, k, at(source, k))


@lent
def copy_motion(to: Motion, source: Motion) -> None:
    """Copy a motion to another."""
    copy_rows(to.vertex, source.vertex)
    copy_rows(to.normal, source.normal)
    copy_rows(to.centre, source.centre)
    copy_rows(to.rounded, source.rounded)
    for i in range(len(to.second)):
        copy_rows(to.second[i], source.second[i])
    for a in range(len(to.velocity)):
        to.velocity[a], to.strain[a] = source.velocity[a], source.strain[a]


@lent
def fill_masses(mass: Vector, bodies: Bodies, motion: Motion) -> None:
    """Fill mass (q, 12), the mass matrix: row a has the entries of all unknowns of the same block.

    m_ab = m line_a . line_b + tr(slope_a second slope_b^T).
    """
    for i in range(len(bodies.mass)):
        first, second = bodies.start[i], motion.second[i]
        for a in range(first, bodies.start[i + 1]):
            for b in range(first, bodies.start[i + 1]):
                total = bodies.mass[i] * dot(at(bodies.line, a), at(bodies.line, b))
                mass[a, b - first] = total + moment_product(
                    second, bodies.slope[a], bodies.slope[b]
                )


@lent
def times_blocks(result: Vector, matrix: Vector, bodies: Bodies, vector: Vector) -> float:
    """Fill result (q,) with matrix (q, 12) times vector (q,); return vector . result.

    The matrix is laid out as that of `fill_masses`.
    """
    whole = 0.0
    for i in range(len(bodies.mass)):
        first = bodies.start[i]
        for a in range(first, bodies.start[i + 1]):
            total = 0.0
            for b in range(first, bodies.start[i + 1]):
                total += matrix[a, b - first] * vector[b]
            result[a] = total
            whole += vector[a] * total
    return whole


@lent
def centre_displacement(bodies: Bodies, i: int, d: Vector) -> Triple:
    """The displacement of the centre of block i for unknowns d (q,) [m]."""
    line = NOWHERE
    for a in range(bodies.start[i], bodies.start[i + 1]):
        line = add_scaled(line, d[a], at(bodies.line, a))
    return line


@lent
def fill_gradient(out: Vector, bodies: Bodies, first: int, last: int, d: Vector) -> None:
    """Fill out (3, 3): the displacement gradient of the unknowns first to last - 1 of d (q,)."""
    for r in range(3):
        row = NOWHERE
        for a in range(first, last):
            row = add_scaled(row, d[a], at(bodies.slope[a], r))
        put(out, r, row)


@called
def fill_deformation(whole: Vector, bodies: Bodies, i: int, d: Vector, terms: int) -> None:
    """Fill whole (3, 3): the exponential of the displacement gradient of block i.

    terms: how many terms of its series are summed.
    """
    slope = rows(3)
    fill_gradient(slope, bodies, bodies.start[i], bodies.start[i + 1], d)
    fill_exponential(whole, slope, terms)


@called
def rotate_strains(motion: Motion, bodies: Bodies, i: int, d: Vector, terms: int) -> None:
    """Rotate strains of block i with it: E becomes R E R^T, R = exp of the rotation in d (q,)."""
    spin, turn, tensor = rows(3), rows(3), rows(3)
    begin, end = bodies.strains[i], bodies.start[i + 1]
    fill_gradient(spin, bodies, bodies.start[i], begin, d)
    fill_exponential(turn, spin, terms)
    fill_gradient(tensor, bodies, begin, end, motion.strain)
    congruent(tensor, turn, tensor)
    for a in range(begin, end):
        part = size = 0.0
        for r in range(3):
            part += dot(at(bodies.slope[a], r), at(tensor, r))
            size += dot(at(bodies.slope[a], r), at(bodies.slope[a], r))
        motion.strain[a] = part / size


@called
def displace(
    motion: Motion, bodies: Bodies, shapes: Shapes, d: Vector, terms: int, follow: int
) -> None:
    """Move the blocks by d (q,); terms: see `fill_deformation`; follow: see `Formulation`."""
    whole = rows(3)
    for i in range(len(bodies.mass)):
        fill_deformation(whole, bodies, i, d, terms)
        before = at(motion.centre, i)
        owed = add_scaled(centre_displacement(bodies, i, d), -1.0, at(motion.rounded, i))
        centre = add_scaled(before, 1.0, owed)
        put(motion.rounded, i, add_scaled(add_scaled(centre, -1.0, before), -1.0, owed))
        for k in range(shapes.vertex_start[i], shapes.vertex_start[i + 1]):
            arm = add_scaled(at(motion.vertex, k), -1.0, before)
            put(motion.vertex, k, add_scaled(centre, 1.0, times_vector(whole, arm)))
        put(motion.centre, i, centre)
        congruent(motion.second[i], whole, motion.second[i])
    for a in range(len(d)):
        motion.strain[a] += d[a]
    for i in range(len(bodies.mass)):
        if follow > 0 and bodies.strains[i] < bodies.start[i + 1]:
            rotate_strains(motion, bodies, i, d, follow)
    find_normals(motion.normal, shapes, motion.vertex)

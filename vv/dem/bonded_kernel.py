"""The compiled kernel for spheres on bonds that never break: the leapfrog over all bonds."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from vv.compiled import compiled, inlined
from vv.dem.advance import kick, place
from vv.dem.limits import BLOW_UP, GAIN
from vv.scene import Vector
from vv.triples import NOWHERE, Triple, at, dot, plus, put

Index = npt.NDArray[np.intp]
Springs = tuple[Index, Vector, Vector, Vector, Vector]


@inlined
def pull(
    push: Vector,
    u: Vector,
    v: Vector,
    dt: float,
    springs: Springs,
    ks: Vector | None,
    slip: Vector,
) -> tuple[float, float]:
    """Add the forces of all bonds to push (m + 1, 3) [N]; return normal and shear energies [J].

    springs: rows (b, 2), first offset (b, 3) and its length (b,), stretch at t = 0 (b,), kn (b,).
    A stretch is its first value plus what the displacements add, so that small strains keep
    their digits. slip: (b, 3) displacement across each bond, brought from where it pointed before
    to where it points now: mirrored in the plane across the direction c halfway, which turns it
    with the bond and keeps its length, and grown by the motion m in that plane, which makes it
    the integral of L times the angle. Together that is s + m - (c.(2s + m)/c.c) c. What little
    of m is left along the bond changes sign with the next mirror and does not gather.
    """
    rows, offset, first, strained, kn = springs
    normal = sheared = 0.0
    for p in range(len(rows)):
        i, j = rows[p, 0], rows[p, 1]
        w, r = plus(at(u, j), -1.0, at(u, i)), at(offset, p)
        now = plus(r, 1.0, w)
        length = math.sqrt(dot(now, now))
        n = plus(NOWHERE, 1.0 / length, now)
        stretch = strained[p] + dot(plus(plus(NOWHERE, 2.0, r), 1.0, w), w) / (length + first[p])
        force = plus(NOWHERE, kn[p] * stretch, n)
        normal += 0.5 * kn[p] * stretch * stretch
        if ks is not None:
            s, m = at(slip, p), plus(NOWHERE, dt, plus(at(v, j), -1.0, at(v, i)))
            half = plus(now, -0.5, m)
            share = dot(half, plus(m, 2.0, s)) / dot(half, half)
            s = plus(plus(s, 1.0, m), -share, half)
            put(slip, p, s)
            force = plus(force, ks[p], s)
            sheared += 0.5 * ks[p] * dot(s, s)
        put(push, i, plus(at(push, i), 1.0, force))
        put(push, j, plus(at(push, j), -1.0, force))
    return normal, sheared


@inlined
def outer(push: Vector, mass: Vector, gravity: Triple | None, load: Vector | None) -> None:
    """Set push (m + 1, 3) [N] to weight and dead loads."""
    for i in range(len(mass)):
        put(push, i, NOWHERE)
        if gravity is not None:
            put(push, i, plus(NOWHERE, mass[i], gravity))
        if load is not None:
            put(push, i, plus(at(push, i), 1.0, at(load, i)))


@compiled
def move_bonded(
    path: Vector,
    energy: Vector,
    watched: Index,
    stride: int,
    dt: float,
    velocity: Vector,
    mass: Vector,
    gravity: Triple | None,
    load: Vector | None,
    hold: Vector | None,
    springs: Springs,
    ks: Vector | None,
    eta: float | None,
    lag: float,
    back: float,
) -> int:
    """Step m u'' = load + bonds - eta u' by the leapfrog; return rows filled.

    velocity: (m, 3) at t = 0; mass: (m,); hold: (m, 3, 3) projectors on the free directions;
    springs: see `pull`, row m is the ground; ks: (b,). An absent term is None. lag, back and what
    is written are those of `vv.dem.space_kernel.move_in_space`: path (k, b, 6), energy (k, 7).
    """
    m = len(mass)
    u, v, before = np.zeros((m + 1, 3)), np.zeros((m + 1, 3)), np.zeros((m + 1, 3))
    push = np.zeros((m + 1, 3))
    slip = np.zeros((0, 3))
    if ks is not None:
        slip = np.zeros((len(ks), 3))
    outer(push, mass, gravity, load)
    normal, sheared = pull(push, u, v, dt, springs, ks, slip)
    put_in = normal + sheared + place(v, velocity, push, mass, hold, back * dt, eta)
    kinetic, _, ahead = kick(v, before, push, mass, hold, dt, eta, lag)
    dragged = done = 0.0
    for row in range(len(path)):
        for _ in range(stride if row else 0):
            for i in range(m):
                put(u, i, plus(at(u, i), dt, at(v, i)))
            outer(push, mass, gravity, load)
            normal, sheared = pull(push, u, v, dt, springs, ks, slip)
            dragged += ahead
            kinetic, behind, ahead = kick(v, before, push, mass, hold, dt, eta, lag)
            dragged += behind
        for k in range(len(watched)):
            for c in range(3):
                path[row, k, c] = u[watched[k], c]
                path[row, k, 3 + c] = 0.5 * (before[watched[k], c] + v[watched[k], c])
        fallen = loaded = fast = 0.0
        for i in range(m):
            fast += 0.5 * mass[i] * dot(at(v, i), at(v, i))
            if gravity is not None:
                fallen += mass[i] * dot(gravity, at(u, i))
            if load is not None:
                loaded += dot(at(load, i), at(u, i))
        done = max(done, fallen + loaded)
        energy[row, 0], energy[row, 1], energy[row, 2] = kinetic, normal, sheared
        energy[row, 3], energy[row, 4] = 0.0, 0.5 * dt * dragged
        energy[row, 5], energy[row, 6] = fallen, loaded
        total = kinetic + normal + sheared
        if row and not (total <= GAIN * (put_in + done) and fast <= BLOW_UP * (put_in + done)):
            return row
    return len(path)

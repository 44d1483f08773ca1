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
    normals: Vector,
) -> tuple[float, float]:
    """Add the forces of all bonds to push (m + 1, 3) [N]; return normal and shear energies [J].

    springs: rows (b, 2), first offset (b, 3) and its length (b,), stretch at t = 0 (b,), kn (b,).
    A stretch is its first value plus what the displacements add, so that small strains keep
    their digits. slip: (b, 3) displacement across each bond, brought from normals (b, 3), where
    the bonds pointed before, to where they point now. It turns with the bond, exactly; it grows
    by the motion across the direction halfway, which makes it the integral of L times the angle.
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
            before, s = at(normals, p), at(slip, p)
            both = plus(n, 1.0, before)
            s = plus(s, -dot(n, s) / (1.0 + dot(n, before)), both)
            moved = plus(NOWHERE, dt, plus(at(v, j), -1.0, at(v, i)))
            moved = plus(moved, -dot(both, moved) / dot(both, both), both)
            s = plus(plus(s, 1.0, moved), -dot(n, moved), n)
            put(slip, p, s)
            put(normals, p, n)
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
    slip = normals = np.zeros((0, 3))
    if ks is not None:
        slip = np.zeros((len(ks), 3))
        normals = springs[1] / springs[2].reshape(-1, 1)
    outer(push, mass, gravity, load)
    normal, sheared = pull(push, u, v, dt, springs, ks, slip, normals)
    put_in = normal + sheared + place(v, velocity, push, mass, hold, back * dt, eta)
    kinetic, _, ahead = kick(v, before, push, mass, hold, dt, eta, lag)
    dragged = done = 0.0
    for row in range(len(path)):
        for _ in range(stride if row else 0):
            for i in range(m):
                put(u, i, plus(at(u, i), dt, at(v, i)))
            outer(push, mass, gravity, load)
            normal, sheared = pull(push, u, v, dt, springs, ks, slip, normals)
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

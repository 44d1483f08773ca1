"""The kernel's output: the path of the observed rows, and the energies."""

from __future__ import annotations

from vv.engines.dem.rows import Index
from vv.engines.dem.space.advance import free_part
from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.hooks import Terms, book, resistance
from vv.engines.dem.space.ledger import column
from vv.engines.dem.terms.drag import Drag, add_steady
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import Triple, add_scaled, at, dot
from vv.scene import Form, Vector

WALLS = column(Form.WALLS)


@inlined
def observe(
    path: Vector, row: int, watched: Index, terms: Terms, bodies: Bodies, motion: Motion
) -> None:
    """Fill a row of path (k, b, 12): displacement, mean velocity, mean spin, force of the locks.

    The means are those of the values before and after. Spin and force are left out where no sphere
    rotates or is locked.
    """
    for k in range(len(watched)):
        i = watched[k]
        for c in range(3):
            path[row, k, c] = motion.u[i, c]
            path[row, k, 3 + c] = 0.5 * (motion.before[i, c] + motion.v[i, c])
        observe_spin(path, row, k, i, motion.w, motion.spun)
        if i < len(bodies.mass):
            observe_lock(path, row, k, at(motion.push, i), bodies.hold, resistance(terms), i)


@inlined
def observe_spin(
    path: Vector, row: int, k: int, i: int, w: Vector | None, spun: Vector | None
) -> None:
    """Fill in the mean spin of body i, if any body rotates."""
    if w is not None and spun is not None and len(w):
        for c in range(3):
            path[row, k, 6 + c] = 0.5 * (spun[i, c] + w[i, c])


@inlined
def observe_lock(
    path: Vector, row: int, k: int, push: Triple, hold: Vector, drag: Drag | None, i: int
) -> None:
    """Fill in the force [N] of the locks of body i, if any body is locked."""
    if len(hold):
        force = add_scaled(free_part(push, hold, i), -1.0, push)
        if drag is not None:
            force = add_steady(force, drag.eta, drag.steady, i)
        for c in range(3):
            path[row, k, path.shape[2] - 3 + c] = force[c]


@inlined
def write_energies(
    energy: Vector,
    row: int,
    terms: Terms,
    bodies: Bodies,
    motion: Motion,
    held: tuple[float, float, float, float, float],
    moved: float,
) -> float:
    """Fill a row of energy (`ledger.py`) [J]; return the work of all terms [J].

    held: m v- v+/2 and I w- w+/2, normal springs, tangential springs, friction, drag and viscous
    contacts; moved: the work of walls.
    """
    for c in range(5):
        energy[row, c] = held[c]
    if energy.shape[1] > WALLS:
        energy[row, WALLS] = moved
    return book(terms, bodies, motion, energy, row)[0] + moved


@inlined
def kinetic_energy(bodies: Bodies, motion: Motion) -> float:
    """The kinetic energy as m v- v+/2 and I w- w+/2 [J]."""
    fast = kinetic_sum(bodies.mass, motion.before, motion.v)
    return fast + rotational_energy(bodies.inertia, motion.spun, motion.w)


@inlined
def kinetic_energy_after(bodies: Bodies, motion: Motion) -> float:
    """The kinetic energy after the kick, m v+^2/2 and I w+^2/2 [J]."""
    fast = kinetic_sum(bodies.mass, motion.v, motion.v)
    return fast + rotational_energy(bodies.inertia, motion.w, motion.w)


@inlined
def rotational_energy(inertia: Vector, w: Vector | None, other: Vector | None) -> float:
    """As `kinetic_sum`, for spins; zero if no sphere rotates."""
    return 0.0 if w is None or other is None else kinetic_sum(inertia, w, other)


@inlined
def kinetic_sum(mass: Vector, v: Vector, other: Vector) -> float:
    """The sum of m v v'/2 [J] over all bodies."""
    fast = 0.0
    for i in range(len(mass)):
        fast += 0.5 * mass[i] * dot(at(v, i), at(other, i))
    return fast

"""The parts of a step of all spheres, with or without rotation; inlined into the kernel."""

from __future__ import annotations

from vv.engines.dem.space import advance
from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.hooks import Terms, resistance
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import add_scaled, at, put
from vv.scene import Vector


@inlined
def drift(motion: Motion, m: int, dt: float) -> None:
    """Displace the spheres by their velocities times dt."""
    for i in range(m):
        put(motion.u, i, add_scaled(at(motion.u, i), dt, at(motion.v, i)))


@inlined
def place(terms: Terms, bodies: Bodies, motion: Motion, time: float) -> float:
    """Set v to the velocity `time` [s] before t = 0; return sum m v v/2 [J] at t = 0."""
    v, velocity, mass = motion.v, bodies.velocity, bodies.mass
    return advance.place(v, velocity, motion.push, mass, bodies.hold, time, resistance(terms))


@inlined
def place_spins(
    w: Vector | None, spin: Vector | None, turn: Vector | None, bodies: Bodies, time: float
) -> float:
    """As `place`, for spins; zero if no sphere rotates."""
    if w is None or spin is None or turn is None:
        return 0.0
    return advance.place(w, spin, turn, bodies.inertia, bodies.hold_spin, time, None)


@inlined
def kick(
    terms: Terms, bodies: Bodies, motion: Motion, dt: float, lag: float, slowed: tuple[float, float]
) -> tuple[float, float]:
    """Update v from half a step before to half a step after; copy the old v to before.

    Returns the powers [W] dissipated before and after: those in `slowed`, plus those of drag.
    """
    v, before, push = motion.v, motion.before, motion.push
    return advance.kick(
        v, before, push, bodies.mass, bodies.hold, dt, resistance(terms), lag, slowed
    )


@inlined
def kick_spins(
    w: Vector | None, spun: Vector | None, turn: Vector | None, bodies: Bodies, dt: float
) -> None:
    """As `kick`, for spins, if any sphere rotates."""
    if w is not None and spun is not None and turn is not None:
        advance.kick_free(w, spun, turn, bodies.inertia, bodies.hold_spin, dt)

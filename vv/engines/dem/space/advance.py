"""Velocities of the leapfrog at t = 0, and their update in a step; inlined into kernels."""

from __future__ import annotations

from vv.engines.dem.terms.drag import Drag, add_steady
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot, put
from vv.scene import Vector


@inlined
def free_part(a: Triple, hold: Vector | None, i: int) -> Triple:
    """The part of vector a in the free directions of body i; hold: as in `Bodies`, or None."""
    if hold is None:
        return a
    if len(hold) == 0:
        return a
    return (
        hold[i, 0, 0] * a[0] + hold[i, 0, 1] * a[1] + hold[i, 0, 2] * a[2],
        hold[i, 1, 0] * a[0] + hold[i, 1, 1] * a[1] + hold[i, 1, 2] * a[2],
        hold[i, 2, 0] * a[0] + hold[i, 2, 1] * a[1] + hold[i, 2, 2] * a[2],
    )


@inlined
def place(
    v: Vector,
    velocity: Vector,
    force: Vector,
    mass: Vector,
    hold: Vector,
    time: float,
    drag: Drag | None,
) -> float:
    """Set v (m + 1, 3) to the velocity `time` [s] before t = 0; return sum m v v/2 [J] at t = 0.

    mass: (m,) [kg], or the moments of inertia if v is a spin.
    """
    kinetic = 0.0
    for i in range(len(mass)):
        start = at(velocity, i)
        rate = free_part(at(force, i), hold, i)
        if drag is not None:
            rate = add_steady(add_scaled(rate, -drag.eta, start), drag.eta, drag.steady, i)
        put(v, i, add_scaled(start, -time / mass[i], rate))
        kinetic += 0.5 * mass[i] * dot(start, start)
    return kinetic


@inlined
def kick(
    v: Vector,
    before: Vector,
    force: Vector,
    mass: Vector,
    hold: Vector,
    dt: float,
    drag: Drag | None,
    lag: float,
    slowed: tuple[float, float],
) -> tuple[float, float]:
    """Update v (m + 1, 3) from half a step before to half a step after; copy the old v to before.

    mass: (m,) [kg]. Returns the dissipated powers [W] at the velocities before and after: those in
    `slowed`, plus D v- and D v+ of the drag D = eta (lag v- + (1 - lag) v+).
    """
    if drag is None:
        kick_free(v, before, force, mass, hold, dt)
        return slowed
    if drag.eta == 0.0:
        kick_free(v, before, force, mass, hold, dt)
        return slowed
    behind, ahead = slowed
    for i in range(len(mass)):
        old, push = at(v, i), free_part(at(force, i), hold, i)
        new = next_velocity(old, push, mass[i], dt, drag, lag, i)
        loss = add_scaled(add_scaled(NOWHERE, drag.eta * lag, old), drag.eta * (1.0 - lag), new)
        behind += dot(loss, old)
        ahead += dot(loss, new)
        put(before, i, old)
        put(v, i, new)
    return behind, ahead


@inlined
def kick_free(
    v: Vector, before: Vector, force: Vector, mass: Vector, hold: Vector, dt: float
) -> None:
    """As `kick`, without drag; also used for spins, with moments of inertia for masses."""
    for i in range(len(mass)):
        old = at(v, i)
        put(before, i, old)
        put(v, i, add_scaled(old, dt / mass[i], free_part(at(force, i), hold, i)))


@inlined
def next_velocity(
    old: Triple, push: Triple, mass: float, dt: float, drag: Drag | None, lag: float, i: int
) -> Triple:
    """The velocity of body i half a step after the present time, from that half a step before."""
    if drag is None:
        return add_scaled(old, dt / mass, push)
    if drag.eta == 0.0:
        return add_scaled(old, dt / mass, push)
    rate = drag.eta * dt / mass
    share = 1.0 / (1.0 + (1.0 - lag) * rate)
    kept = add_scaled(NOWHERE, share * (1.0 - lag * rate), old)
    return add_scaled(add_steady(kept, share * rate, drag.steady, i), share * dt / mass, push)

"""The velocities of a leapfrog, and how a step carries them on; inlined into kernels."""

from __future__ import annotations

from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, at, dot, plus, put
from vv.scene import Vector


@inlined
def held(a: Triple, hold: Vector | None, i: int) -> Triple:
    """The part of a along the free directions of body i; hold: (m, 3, 3) projectors."""
    if hold is None:
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
    hold: Vector | None,
    time: float,
    eta: float | None,
    carried: Vector | None,
) -> float:
    """Set v (m + 1, 3) to the velocity at `time` [s] before t = 0; return sum m v v/2 [J] at 0.

    carried: (m, 3) the part of each velocity that does not change.
    """
    kinetic = 0.0
    for i in range(len(mass)):
        start = at(velocity, i)
        rate = held(at(force, i), hold, i)
        if eta is not None:
            rate = plus(rate, -eta, start)
            if carried is not None:
                rate = plus(rate, eta, at(carried, i))
        put(v, i, plus(start, -time / mass[i], rate))
        kinetic += 0.5 * mass[i] * dot(start, start)
    return kinetic


@inlined
def kick(
    v: Vector,
    before: Vector,
    force: Vector,
    mass: Vector,
    hold: Vector | None,
    dt: float,
    eta: float | None,
    lag: float,
    carried: Vector | None,
) -> Triple:
    """Carry v (m + 1, 3) from half a step before now to half a step after; keep it in before.

    mass: (m,), the moment of inertia where v is a spin; carried: see `place`.
    Returns sum m v- v+/2 [J] and the powers [W] lost to the drag D = eta (lag v- + (1 - lag) v+)
    before and after now: D v-, D v+.
    """
    kinetic = behind = ahead = 0.0
    for i in range(len(mass)):
        old, push = at(v, i), held(at(force, i), hold, i)
        new = carried_on(old, push, mass[i], dt, eta, lag, carried, i)
        if eta is not None:
            drag = plus(plus(NOWHERE, eta * lag, old), eta * (1.0 - lag), new)
            behind += dot(drag, old)
            ahead += dot(drag, new)
        put(before, i, old)
        put(v, i, new)
        kinetic += 0.5 * mass[i] * dot(old, new)
    return kinetic, behind, ahead


@inlined
def carried_on(
    old: Triple,
    push: Triple,
    mass: float,
    dt: float,
    eta: float | None,
    lag: float,
    carried: Vector | None,
    i: int,
) -> Triple:
    """The velocity of body i half a step after now, from that half a step before."""
    if eta is None:
        return plus(old, dt / mass, push)
    rate = eta * dt / mass
    share = 1.0 / (1.0 + (1.0 - lag) * rate)
    kept = plus(NOWHERE, share * (1.0 - lag * rate), old)
    if carried is not None:
        kept = plus(kept, share * rate, at(carried, i))
    return plus(kept, share * dt / mass, push)


@inlined
def upheld(push: Vector, carried: Vector, eta: float | None) -> float:
    """The power [W] of what carries bodies at their steady velocities (m, 3) against push."""
    power = 0.0
    for i in range(len(carried)):
        c = at(carried, i)
        power -= dot(c, at(push, i))
        if eta is not None:
            power += eta * dot(c, c)
    return power

"""The compiled kernel for one unknown: a sphere moves along a contact normal or along a wall."""

from __future__ import annotations

from vv.engines.dem.contact.linear import closing_factor
from vv.engines.dem.limits import BLOW_UP, GAIN
from vv.engines.kernels.compiled import compiled, inlined
from vv.scene import Vector


@inlined
def viscous_kick(
    before: float,
    after: float,
    load: float,
    spring: float,
    eta_n: float,
    eta: float | None,
    mass: float,
    dt: float,
    lag: float,
) -> tuple[float, float]:
    """v+ [m/s] of a sphere in a viscous contact, and the viscous part of the contact force [N].

    The viscous force is at most the spring's push, so that the contact never pulls. after: v+
    without viscosity; load [N]: all forces except drags, that of the spring included; spring: the
    latter.
    """
    rate = eta_n * dt / mass
    still = 1.0
    if eta is not None:
        rate += eta * dt / mass
        still += (1.0 - lag) * eta * dt / mass
    slower = ((1.0 - lag * rate) * before + dt / mass * load) / (1.0 + (1.0 - lag) * rate)
    slowed = eta_n * (lag * before + (1.0 - lag) * slower)
    if slowed > spring:
        return after - dt / mass * spring / still, spring
    return slower, slowed


@compiled
def move_on_line(  # noqa: PLR0912, PLR0915 - a branch per term, decided by the compiler
    path: Vector,
    energy: Vector,
    stride: int,
    dt: float,
    velocity: Vector,
    mass: float,
    force: float | None,
    normal: tuple[float, float] | None,
    friction: tuple[float, float] | None,
    eta: float | None,
    eta_n: float | None,
    lag: float,
    back: float,
) -> int:
    """Integrate m q'' = force + Fn + Fs - eta q' by the leapfrog; return the rows filled.

    Fn = max(0, kn U - eta_n q') while U = -(gap + q) > 0, else 0. velocity: (1,) [m/s] at t = 0;
    mass [kg]; force [N]; normal: kn [N/m] and the gap [m] at t = 0; eta_n [N s/m]; friction: ks
    [N/m] and the limit [N] in Fs' = -ks q', |Fs| <= limit. A term that the scene lacks is None.
    Both drags act on lag v- + (1 - lag) v+: with 1/2 at the midpoint, with 1 on the previous mean
    velocity. back: by how many dt before t = 0 the first velocity is set.

    Every `stride` steps a row is written: path (k, 2): q [m], mean of v- and v+ [m/s]; energy (k,
    6) [J]: m v- v+/2, normal spring, tangential spring, dissipated by friction, dissipated by
    drags, and a bound on the energy error of contacts that closed or opened. The loop ends before a
    later row if energy was created (vv.engines.dem.limits). It is one function since all parts of a
    step share its variables.
    """
    q = shear = slipped = dragged = ahead = kinks = overlap = load = done = 0.0
    start = velocity[0]
    kick, decay, slow = dt / mass, 1.0, 0.0
    if force is not None:
        load = force
    if normal is not None:
        kn, gap = normal
        overlap = -gap
        load += kn * max(overlap, 0.0)
    if eta is not None:
        slow = eta * start
        rate = eta * dt / mass
        kick = kick / (1.0 + (1.0 - lag) * rate)
        decay = (1.0 - lag * rate) / (1.0 + (1.0 - lag) * rate)
    if friction is not None:
        ks, cap = friction
    if eta_n is not None and overlap > 0.0:
        slow += min(eta_n * start, kn * overlap)
    before = start - back * dt / mass * (load - slow)
    after = decay * before + kick * load
    if eta_n is not None and overlap > 0.0:
        after, slowed = viscous_kick(before, after, load, kn * overlap, eta_n, eta, mass, dt, lag)
        ahead = slowed * after
    if eta is not None:
        ahead += eta * (lag * before + (1.0 - lag) * after) * after
    put_in = 0.5 * mass * start * start
    if normal is not None:
        put_in += 0.5 * kn * max(overlap, 0.0) ** 2

    for row in range(len(path)):
        for _ in range(stride if row else 0):
            q += dt * after
            load = 0.0
            if force is not None:
                load = force
            if normal is not None:
                was_open = overlap <= 0.0
                overlap = -(gap + q)
                load += kn * max(overlap, 0.0)
                if was_open != (overlap <= 0.0):
                    kinks += after * after
            if friction is not None:
                trial = shear - ks * dt * after
                capped = min(max(trial, -cap), cap)
                slipped += (trial - capped) * (shear + capped)
                shear = capped
                load += shear
            before = after
            after = decay * before + kick * load
            drag = 0.0
            if eta_n is not None and overlap > 0.0:
                share = 1.0
                if was_open:
                    share = closing_factor(overlap, -dt * before)
                after, drag = viscous_kick(
                    before, after, load, kn * overlap, share * eta_n, eta, mass, dt, lag
                )
            if eta is not None:
                drag += eta * (lag * before + (1.0 - lag) * after)
            if eta is not None or eta_n is not None:
                dragged += ahead + drag * before
                ahead = drag * after

        path[row, 0] = q
        path[row, 1] = 0.5 * (before + after)
        energy[row, 0] = 0.5 * mass * before * after
        for column in range(1, 6):
            energy[row, column] = 0.0
        if normal is not None:
            energy[row, 1] = 0.5 * kn * max(overlap, 0.0) ** 2
            energy[row, 5] = 0.125 * kn * dt * dt * kinks
        if friction is not None:
            energy[row, 2] = 0.5 * shear * shear / ks
            energy[row, 3] = 0.5 * slipped / ks
        if eta is not None or eta_n is not None:
            energy[row, 4] = 0.5 * dt * dragged
        if force is not None:
            done = max(done, force * q)
        held = energy[row, 0] + energy[row, 1] + energy[row, 2]
        fast = 0.5 * mass * after * after
        if row and not (held <= GAIN * (put_in + done) and fast <= BLOW_UP * (put_in + done)):
            return row
    return len(path)

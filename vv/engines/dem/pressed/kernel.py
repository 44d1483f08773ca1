"""The compiled kernel for two unknowns: a sphere moves along a wall's normal and one tangent."""

from __future__ import annotations

from vv.engines.dem.contact.friction import share_closed
from vv.engines.dem.limits import BLOW_UP, GAIN
from vv.engines.kernels.compiled import compiled
from vv.engines.kernels.drive import Drive, travel, value
from vv.scene import Vector


@compiled
def move_on_wall(  # noqa: PLR0912, PLR0915 - a branch per term, decided by the compiler
    path: Vector,
    energy: Vector,
    stride: int,
    dt: float,
    velocity: Vector,
    mass: float,
    force: tuple[float, float],
    kn: float,
    gap: float,
    friction: tuple[float, float, float] | None,
    eta: float | None,
    shaking: Drive | None,
    base: Drive | None,
    lag: float,
    back: float,
) -> int:
    """Integrate m (p, q)'' = force + contact + m shaking - eta (p, q)' by the leapfrog.

    Returns the rows filled. p, q [m]: displacements along the normal and the tangent. velocity:
    (2,) [m/s] at t = 0; mass [kg]; force [N]; kn [N/m]; gap [m] at t = 0; friction: ks [N/m], mu,
    and the tangential force [N] at t = 0; shaking: accelerations [m/s2]; base: the displacement of
    the wall. A term that the scene lacks is None. The contact force is kn U, U = P - gap - p, with
    the wall's displacement (P, Q), and tangentially S' = -ks (q' - Q'), |S| <= mu kn U. Positions,
    forces and motions are evaluated at n dt; the wall moves linearly within a step. lag, back: see
    `move_on_line`.

    Every `stride` steps a row is written: path (k, 4): p, q, means of v- and v+; energy (k, 8) [J]:
    m v- v+/2, normal spring, tangential spring, dissipated by friction, dissipated by drag, work of
    shaking, work of the wall; the last column counts how often the contact opened or closed. The
    loop ends before a later row if energy was created (vv.engines.dem.limits). It is one function
    since all parts of a step share its variables.
    """
    p = q = shear = slipped = dragged = shook = moved = done = now_p = now_q = now = 0.0
    wall_p = wall_q = slow_p = slow_q = 0.0
    steps = changes = 0
    start_p, start_q = velocity[0], velocity[1]
    overlap = -gap
    push = kn * max(overlap, 0.0)
    load_p, load_q = push + force[0], force[1]
    put_in = 0.5 * mass * (start_p * start_p + start_q * start_q) + 0.5 * push * max(overlap, 0.0)
    if friction is not None:
        ks, mu, shear = friction
        cap = mu * push
        shear = min(max(shear, -cap), cap)
        load_q += shear
        put_in += 0.5 * shear * shear / ks
    if shaking is not None:
        now_p, now_q, _ = value(shaking, 0.0)
        load_p, load_q = load_p + mass * now_p, load_q + mass * now_q
    kick, decay = dt / mass, 1.0
    if eta is not None:
        slow_p, slow_q = eta * start_p, eta * start_q
        rate = eta * dt / mass
        kick = kick / (1.0 + (1.0 - lag) * rate)
        decay = (1.0 - lag * rate) / (1.0 + (1.0 - lag) * rate)
    before_p = start_p - back * dt / mass * (load_p - slow_p)
    before_q = start_q - back * dt / mass * (load_q - slow_q)
    after_p, after_q = decay * before_p + kick * load_p, decay * before_q + kick * load_q
    if eta is not None:
        now = eta * (
            (lag * before_p + (1.0 - lag) * after_p) * after_p
            + (lag * before_q + (1.0 - lag) * after_q) * after_q
        )

    for row in range(len(path)):
        for _ in range(stride if row else 0):
            steps += 1
            went_p, went_q = dt * after_p, dt * after_q
            p, q = p + went_p, q + went_q
            opened, slide = went_p, went_q
            was_push, was_shear, was_open = push, shear, overlap <= 0.0
            overlap = -(gap + p)
            if base is not None:
                old_p, old_q = wall_p, wall_q
                wall_p, wall_q, _ = travel(base, steps * dt)
                opened, slide = opened - (wall_p - old_p), slide - (wall_q - old_q)
                overlap += wall_p
            push = kn * max(overlap, 0.0)
            changes += was_open != (overlap <= 0.0)
            load_p, load_q = push + force[0], force[1]
            if friction is not None:
                shear = 0.0
                if overlap > 0.0:
                    trial = was_shear - ks * share_closed(overlap, opened) * slide
                    cap = mu * push
                    shear = min(max(trial, -cap), cap)
                    slipped += (trial - shear) * (was_shear + shear)
                load_q += shear
            if base is not None:
                moved += 0.5 * (was_push + push) * (wall_p - old_p)
                moved += 0.5 * (was_shear + shear) * (wall_q - old_q)
            if shaking is not None:
                old_a, old_b = now_p, now_q
                now_p, now_q, _ = value(shaking, steps * dt)
                shook += 0.5 * mass * ((old_a + now_p) * went_p + (old_b + now_q) * went_q)
                load_p, load_q = load_p + mass * now_p, load_q + mass * now_q
            before_p, before_q = after_p, after_q
            after_p = decay * before_p + kick * load_p
            after_q = decay * before_q + kick * load_q
            if eta is not None:
                drag_p = eta * (lag * before_p + (1.0 - lag) * after_p)
                drag_q = eta * (lag * before_q + (1.0 - lag) * after_q)
                dragged += now + drag_p * before_p + drag_q * before_q
                now = drag_p * after_p + drag_q * after_q

        path[row, 0], path[row, 1] = p, q
        path[row, 2], path[row, 3] = 0.5 * (before_p + after_p), 0.5 * (before_q + after_q)
        energy[row, 0] = 0.5 * mass * (before_p * after_p + before_q * after_q)
        energy[row, 1] = 0.5 * push * max(overlap, 0.0)
        energy[row, 2] = energy[row, 3] = 0.0
        if friction is not None:
            energy[row, 2], energy[row, 3] = 0.5 * shear * shear / ks, 0.5 * slipped / ks
        energy[row, 4], energy[row, 5], energy[row, 6] = 0.5 * dt * dragged, shook, moved
        energy[row, 7] = changes
        work = shook + moved + (force[0] * p + force[1] * q)
        done = max(done, work)
        held = energy[row, 0] + energy[row, 1] + energy[row, 2]
        fast = 0.5 * mass * (after_p * after_p + after_q * after_q)
        if row and not (held <= GAIN * (put_in + done) and fast <= BLOW_UP * (put_in + done)):
            return row
    return len(path)

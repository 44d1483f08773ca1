"""The compiled kernel of DDA for one block that cannot turn on one wall: up to three unknowns."""

from __future__ import annotations

import numpy as np

from vv.engines.dda.law import OPEN, SLIDE, STICK, respond
from vv.engines.dda.limits import CUTS, GAIN
from vv.engines.kernels.compiled import compiled
from vv.engines.kernels.drive import Drive, travel, value
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, dot
from vv.scene import Vector


@compiled
def slide_point(  # noqa: PLR0912, PLR0915 - one loop, whose parts share all its variables
    path: Vector,
    energy: Vector,
    report: Vector,
    stride: int,
    dt: float,
    settling: int,
    tolerance: float,
    iterations: int,
    dd: float,
    pressed: bool,
    hold: float,
    mass: float,
    points: int,
    kn: float,
    ks: float | None,
    mu: float | None,
    velocity: Triple,
    gravity: Triple,
    load: Triple,
    normal: Triple,
    gap: float,
    base: Drive | None,
    shaking: Drive | None,
) -> int:
    """Step m d'' = m (gravity + shaking) + load + contact by DDA; return rows filled.

    points: how many points of contact share the load, each with springs kn, ks [N/m]; ks, mu
    None without friction; gravity, load, shaking: their parts along the free directions, which
    hold the normal and all motion of the base; gap [m] at t = 0, before which `settling` steps
    are taken with drives at rest. tolerance, hold: see `move_blocks`.

    d'' = (2/D^2)(d - D v0), v = (2/D) d - v0 (Yagoda-Biran 2016, Eq. 5 corrected). Rows are
    those of `move_blocks`: path (k, 6), energy (k, 13), report (k, 9).
    """
    x, v, shift, spring, way = NOWHERE, velocity, NOWHERE, NOWHERE, NOWHERE
    rounded = NOWHERE  # what the sums of x lost, which 1e5 steps make 1e-12 of x
    state, push, done = OPEN, 0.0, -settling
    if pressed:
        push = max(0.0, -dot(add_scaled(load, mass, gravity), normal)) / points
        if push > 0.0:
            x, state = (
                add_scaled(NOWHERE, -gap - push / kn, normal),
                STICK if ks is not None else SLIDE,
            )
            if ks is not None and mu is not None:
                pull = add_scaled(load, mass, gravity)
                pull = add_scaled(pull, -dot(pull, normal), normal)
                size = np.sqrt(dot(pull, pull)) / points
                part = 1.0 if size <= mu * push else mu * push / size
                spring = add_scaled(NOWHERE, hold * part / (points * ks), pull)
    origin = x
    rubbed = lost = damped = fallen = worked = carried = shaken = created = 0.0
    residual = deepest = excess = adrift = peak = 0.0
    most = cuts = failed = solved = 0
    put_in = ever = 0.0

    for row in range(len(path)):
        for _ in range((stride if row else 0) + (settling if row == 0 else 0)):
            begin, part = 0.0, dt
            while begin < dt:
                wall, shake = shift, NOWHERE
                if base is not None and done >= 0:
                    wall = travel(base, done * dt + begin + part)
                if shaking is not None and done >= 0:
                    shake = value(shaking, done * dt + begin + part)
                moved = add_scaled(wall, -1.0, shift)
                space = gap + dot(normal, add_scaled(x, -1.0, shift))
                c = 2.0 * mass / (part * part)
                outer = add_scaled(add_scaled(load, mass, gravity), mass, shake)
                f = add_scaled(outer, c * part, v)
                f_n = dot(f, normal)
                f_t = add_scaled(f, -f_n, normal)
                moved_n = dot(moved, normal)
                moved_t = add_scaled(moved, -moved_n, normal)
                now, force, along, wrong, ended = state, push, way, 0.0, False
                for count in range(1, iterations + 1):
                    used, rub = now, NOWHERE
                    closed = points * kn if used != OPEN else 0.0
                    d_n = (f_n - closed * (space - moved_n)) / (c + closed)
                    d_t = add_scaled(NOWHERE, 1.0 / c, f_t)
                    if mu is not None and ks is not None:
                        if used == STICK:
                            pull = add_scaled(spring, -1.0, moved_t)
                            held = add_scaled(f_t, -points * ks, pull)
                            d_t = add_scaled(NOWHERE, 1.0 / (c + points * ks), held)
                        elif used == SLIDE:
                            rub = add_scaled(NOWHERE, mu * force, along)
                            d_t = add_scaled(NOWHERE, 1.0 / c, add_scaled(f_t, -points, rub))
                    after = space + d_n - moved_n
                    slip = add_scaled(d_t, -1.0, moved_t)
                    ease = c / points
                    now, force, along = respond(
                        used, after, slip, spring, along, kn, ks, mu, hold, ease, tolerance < np.inf
                    )
                    ended = now == used
                    if mu is not None and used == SLIDE and now == SLIDE:
                        off = add_scaled(add_scaled(NOWHERE, mu * force, along), -1.0, rub)
                        wrong = np.sqrt(dot(off, off))
                        ended = ended and not wrong > tolerance * mu * force
                    solved, most = solved + 1, max(most, count)
                    if ended:
                        break
                if not ended and part > dt / CUTS:
                    part, cuts = 0.5 * part, cuts + 1
                    continue
                failed += 0 if ended else 1
                d = add_scaled(d_t, d_n, normal)
                new = add_scaled(add_scaled(NOWHERE, 2.0 / part, d), -1.0, v)
                before, beyond = max(-space, 0.0), max(-after, 0.0)
                held_n = -kn * after if used != OPEN else 0.0
                left = 0.5 * kn * (before * before - beyond * beyond) - held_n * (after - space)
                lost += points * left
                created += max(0.0, -points * left)
                carried += points * held_n * moved_n
                pull = add_scaled(NOWHERE, points * held_n, normal)
                if ks is not None and mu is not None:
                    old = 0.5 * points * ks * dot(spring, spring)
                    if used == STICK:
                        spring = add_scaled(spring, 1.0, slip)
                        lost += points * ks * dot(spring, slip)
                        lost += old - 0.5 * points * ks * dot(spring, spring)
                        carried -= points * ks * dot(spring, moved_t)
                    elif used == SLIDE:
                        was, spring = spring, add_scaled(NOWHERE, hold / ks, rub)
                        jump = add_scaled(spring, -1.0, was)
                        lost += points * hold * dot(rub, jump)
                        lost += old - 0.5 * points * ks * dot(spring, spring)
                        slip = add_scaled(slip, -hold, jump)
                    else:
                        spring = NOWHERE
                        lost += old
                    if used == SLIDE:
                        gained = -points * dot(rub, slip)
                        rubbed -= gained
                        created += max(0.0, gained)
                        carried -= points * dot(rub, moved_t)
                        if now == SLIDE:
                            residual = max(residual, wrong)
                    rubs = (
                        add_scaled(NOWHERE, -ks, spring)
                        if used == STICK
                        else add_scaled(NOWHERE, -1.0, rub)
                    )
                    pull = add_scaled(pull, points, rubs)
                    excess = max(excess, np.sqrt(dot(rubs, rubs)) - mu * max(held_n, 0.0))
                gain = add_scaled(add_scaled(NOWHERE, c, d), -c * part, v)
                off = add_scaled(add_scaled(gain, -1.0, outer), -1.0, pull)
                adrift = max(adrift, np.sqrt(dot(off, off)))
                peak = max(peak, held_n, np.sqrt(dot(gain, gain)), np.sqrt(dot(outer, outer)))
                deepest = max(deepest, -after)
                fallen += mass * dot(gravity, d)
                worked += dot(load, d)
                shaken += mass * dot(shake, d)
                damped += 0.5 * mass * (1.0 - dd * dd) * dot(new, new)
                owed = add_scaled(d, -1.0, rounded)
                there = add_scaled(x, 1.0, owed)
                rounded = add_scaled(add_scaled(there, -1.0, x), -1.0, owed)
                x, v, shift = there, add_scaled(NOWHERE, dd, new), wall
                state, push, way = now, force, along
                begin += part
                if begin + part > dt * (1.0 + 1e-12):
                    begin = dt
            done += 1
        if row == 0:
            origin = x
            rubbed = lost = damped = fallen = worked = carried = shaken = created = 0.0
        moved = add_scaled(x, -1.0, origin)
        over = max(0.0, -(gap + dot(normal, add_scaled(x, -1.0, shift))))
        for c_ in range(3):
            path[row, c_], path[row, 3 + c_] = moved[c_], v[c_]
        energy[row, 0] = 0.5 * mass * dot(v, v)
        energy[row, 1] = 0.5 * points * kn * over * over
        energy[row, 2] = 0.0
        if ks is not None:
            energy[row, 2] = 0.5 * points * ks * dot(spring, spring)
        energy[row, 3], energy[row, 4], energy[row, 5] = 0.0, rubbed, lost
        energy[row, 6], energy[row, 7], energy[row, 8] = damped, fallen, worked
        energy[row, 9], energy[row, 10], energy[row, 11] = carried, shaken, 0.0
        energy[row, 12] = created
        report[row, 0], report[row, 1], report[row, 2] = residual, most, deepest
        report[row, 3], report[row, 4], report[row, 5] = cuts, failed, solved
        report[row, 6], report[row, 7], report[row, 8] = excess, adrift, peak
        held_now = energy[row, 0] + energy[row, 1] + energy[row, 2]
        if row == 0:
            put_in = held_now
        ever = max(ever, fallen + worked + carried + shaken)
        if not held_now <= GAIN * (put_in + ever):
            return row
    return len(path)

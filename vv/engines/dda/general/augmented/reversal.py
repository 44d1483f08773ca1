"""Friction in a step with velocities at its middle, where the slide of one block turns in it.

Friction acts in one direction between two mid-step velocities, so that a block would stop before it
slides back, and lack up to what friction gives it in a step. With all other forces constant, slip
slows down evenly until it is zero, and then grows evenly at another rate. Friction's impulse is the
difference of the two parts.
"""

from __future__ import annotations

from vv.engines.blocks.geometry import Index
from vv.engines.dda.general.bodies import Bodies, Motion
from vv.engines.dda.general.contact import Touch
from vv.engines.dda.law import OPEN, SLIDE, STICK
from vv.engines.dda.limits import ALONG
from vv.engines.kernels.arrays import square_of
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.drive import Drive, Starts, one_of, travel
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot, put
from vv.scene import Vector


@lent
def share_of(along: Triple, bodies: Bodies) -> float:
    """The squared length of the part of a unit vector that lies in the free directions."""
    total = 0.0
    for a in range(len(bodies.line)):
        total += square_of(dot(at(bodies.line, a), along))
    return total


@lent
def slip_alike(
    touch: Touch, state: Index, direction: Vector, used: Index, relative: Vector, along: Triple,
    way: float, least: float,
) -> bool:  # fmt: skip
    """Whether all closed contacts slid along a direction, and now slip by `way` [m] along it.

    least: a slip [m] that is taken for none.
    """
    for k in range(len(used)):
        n, moves = at(touch.normal, k), at(relative, k)
        flat = add_scaled(moves, -dot(moves, n), n)
        aside = add_scaled(flat, -way, along)
        unlike = add_scaled(at(direction, k), -1.0, along)
        slid = state[k] == SLIDE and dot(unlike, unlike) <= square_of(ALONG)
        if used[k] != OPEN and not (slid and dot(aside, aside) <= square_of(least)):
            return False
    return True


@called
def slip_before(
    k: int, touch: Touch, motion: Motion, base: Drive, starts: Starts, time: float, part: float
) -> Triple:
    """The velocity [m/s] of contact k in the middle of the step before `time`."""
    speed = NOWHERE
    for m in range(touch.columns[k]):
        speed = add_scaled(speed, motion.velocity[touch.column[k, m]], at(touch.field[k], m))
    if touch.wall[k] >= 0:
        drive = one_of(base, starts, touch.wall[k])
        speed = add_scaled(speed, -1.0 / part, travel(drive, time))
        speed = add_scaled(speed, 1.0 / part, travel(drive, time - part))
    return speed


@called
def turn_slide(
    u: Vector, touch: Touch, state: Index, direction: Vector, used: Index, rub: Vector,
    relative: Vector, bodies: Bodies, motion: Motion, base: Drive, starts: Starts, time: float,
    part: float, ks: float, mu: float,
) -> None:  # fmt: skip
    """Give friction the impulse of a slide that turns in a step, if all contacts slid alike.

    state (c,), direction (c, 3): of the contacts before the step, of which none slides before the
    first; used (c,), rub (c, 3) [N], relative (c, 3) [m], u (q,): what the step was solved with,
    corrected here; touch: as `iterate_multipliers` left it. part [s]: of the step from `time` on.
    `lost` [m/s] is what slip would lose in it without friction, and `most` what friction can take.
    """
    lead = 0
    while lead < len(used) and used[lead] == OPEN:
        lead += 1
    if lead == len(used) or state[lead] != SLIDE:
        return
    along, held, most = at(direction, lead), 0.0, 0.0
    for k in range(len(used)):
        if used[k] == STICK:
            put(rub, k, add_scaled(NOWHERE, ks, at(touch.spring, k)))
        if used[k] != OPEN:
            held += part / bodies.mass[0] * dot(at(rub, k), along)
            most += part / bodies.mass[0] * mu * touch.push[k]
    before = dot(slip_before(lead, touch, motion, base, starts, time, part), along)
    way = dot(at(relative, lead), along)
    lost = before - way / part - held
    if not (0.0 < before < lost + most and lost > most and share_of(along, bodies) > 1.0 - ALONG):
        return
    least = ALONG * part * (lost + most)
    if not slip_alike(touch, state, direction, used, relative, along, way, least):
        return
    share = 2.0 * before / (lost + most) - 1.0
    gain = part * (held - most * share)
    for a in range(len(u)):
        u[a] += gain * dot(at(bodies.line, a), along)
    for k in range(len(used)):
        if used[k] != OPEN:
            used[k] = touch.state[k] = SLIDE
            put(touch.direction, k, add_scaled(NOWHERE, -1.0, along))
            put(rub, k, add_scaled(NOWHERE, share * mu * touch.push[k], along))
            put(touch.spring, k, add_scaled(NOWHERE, 1.0 / ks, at(rub, k)))
            put(relative, k, add_scaled(at(relative, k), gain, along))

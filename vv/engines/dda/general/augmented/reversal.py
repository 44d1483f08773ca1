"""Friction in a step with velocities at its middle, where the slide of one block turns in it.

Friction acts in one direction between two mid-step velocities, so that a block would stop before it
slides back, and lack up to what friction gives it in a step. With all other forces constant, slip
slows down evenly until it is zero, and then grows evenly at another rate. Friction's impulse is the
difference of the two parts.
"""

from __future__ import annotations

from vv.engines.dda.general.bodies import Bodies, Motion
from vv.engines.dda.general.contact import States, Touch
from vv.engines.dda.general.setting import Law, Part, Setting, Trial
from vv.engines.dda.law import OPEN, SLIDE, STICK
from vv.engines.dda.limits import ALONG
from vv.engines.kernels.arrays import square_of
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.drive import one_of, travel
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
    touch: Touch, before: States, trial: Trial, along: Triple, way: float, least: float, mu: float
) -> bool:
    """Whether all closed contacts slid along a direction, and now slip by `way` [m] along it.

    Nor may friction hold one across it: such a slide passes by rest and turns, instead of turning
    back. least: a slip [m] that is taken for none.
    """
    used, relative = trial.used, trial.relative
    for k in range(len(used)):
        n, moves, rubs = at(touch.normal, k), at(relative, k), at(trial.rub, k)
        held = add_scaled(rubs, -dot(rubs, along), along)
        if used[k] != OPEN and dot(held, held) > square_of(ALONG * mu * touch.push[k]):
            return False
        flat = add_scaled(moves, -dot(moves, n), n)
        aside = add_scaled(flat, -way, along)
        unlike = add_scaled(at(before.direction, k), -1.0, along)
        slid = before.state[k] == SLIDE and dot(unlike, unlike) <= square_of(ALONG)
        if used[k] != OPEN and not (slid and dot(aside, aside) <= square_of(least)):
            return False
    return True


@called
def slip_before(
    k: int, touch: Touch, motion: Motion, setting: Setting, time: float, part: float
) -> Triple:
    """The velocity [m/s] of contact k in the middle of the step of length `part` before `time`."""
    speed = NOWHERE
    for m in range(touch.columns[k]):
        speed = add_scaled(speed, motion.velocity[touch.column[k, m]], at(touch.field[k], m))
    if touch.wall[k] >= 0:
        drive = one_of(setting.base, setting.starts, touch.wall[k])
        speed = add_scaled(speed, -1.0 / part, travel(drive, time))
        speed = add_scaled(speed, 1.0 / part, travel(drive, time - part))
    return speed


@called
def turn_slide(
    u: Vector, touch: Touch, before: States, trial: Trial, setting: Setting, motion: Motion,
    part: Part,
) -> None:  # fmt: skip
    """Give friction the impulse of a slide that turns in a step, if all contacts slid alike.

    before: the contacts before the step, of which none slides before the first; trial, u (q,): what
    the step was solved with, corrected here; touch: as `iterate_multipliers` left it. `lost` [m/s]
    is what slip would lose in it without friction, and `most` what friction can take.
    """
    used, rub, law, bodies, length = trial.used, trial.rub, setting.law, setting.bodies, part.length
    lead = 0
    while lead < len(used) and used[lead] == OPEN:
        lead += 1
    if lead == len(used) or before.state[lead] != SLIDE:
        return
    along, held, most = at(before.direction, lead), 0.0, 0.0
    for k in range(len(used)):
        if used[k] == STICK:
            put(rub, k, add_scaled(NOWHERE, law.ks, at(touch.spring, k)))
        if used[k] != OPEN:
            held += length / bodies.mass[0] * dot(at(rub, k), along)
            most += length / bodies.mass[0] * law.mu * touch.push[k]
    speed = dot(slip_before(lead, touch, motion, setting, part.time, length), along)
    way = dot(at(trial.relative, lead), along)
    lost = speed - way / length - held
    if not (0.0 < speed < lost + most and lost > most and share_of(along, bodies) > 1.0 - ALONG):
        return
    least = ALONG * length * (lost + most)
    if not slip_alike(touch, before, trial, along, way, least, law.mu):
        return
    share = 2.0 * speed / (lost + most) - 1.0
    gain = length * (held - most * share)
    for a in range(len(u)):
        u[a] += gain * dot(at(bodies.line, a), along)
    turn_contacts(touch, trial, along, share, gain, law)


@lent
def turn_contacts(
    touch: Touch, trial: Trial, along: Triple, share: float, gain: float, law: Law
) -> None:
    """Let closed contacts slide back with a share of their friction, and `gain` [m] farther."""
    used, rub, relative = trial.used, trial.rub, trial.relative
    for k in range(len(used)):
        if used[k] != OPEN:
            used[k] = touch.state[k] = SLIDE
            put(touch.direction, k, add_scaled(NOWHERE, -1.0, along))
            put(rub, k, add_scaled(NOWHERE, share * law.mu * touch.push[k], along))
            put(touch.spring, k, add_scaled(NOWHERE, 1.0 / law.ks, at(rub, k)))
            put(relative, k, add_scaled(at(relative, k), gain, along))

"""Augmented Lagrangian: multipliers take up the forces of a step's springs until gaps are nil.

A spring that bears what its multiplier does not is shorter by that much, so that open-close and
Newton's iteration see a contact whose gap and shear stretch are other ones (Lin, Amadei, Jung and
Dwyer 1996; with friction Simo and Laursen 1992). Nothing is stored in such a contact.
"""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index
from vv.engines.dda.general.bodies import Bodies, Motion
from vv.engines.dda.general.contact import Touch
from vv.engines.dda.general.energy import (
    BASE,
    CREATED,
    DEEPEST,
    EXCESS,
    FRICTION,
    NUMERICAL,
    PEAK,
)
from vv.engines.dda.general.iterate import iterate, lightness
from vv.engines.dda.law import OPEN, SLIDE, STICK
from vv.engines.dda.limits import FIRM, HELD, PATIENT, SLOW, STUCK
from vv.engines.kernels.arrays import larger, same_numbers
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot, put
from vv.scene import Vector

EPS = float(np.finfo(float).eps)
ROUNDINGS = 1024.0  # of coordinates: a walk of a million steps, of which each rounds


@lent
def length(a: Triple) -> float:
    """Its length."""
    return float(np.sqrt(dot(a, a)))


@lent
def fall(bodies: Bodies, reach: float) -> float:
    """What loads give to blocks that go so far [J], where nothing is stored that rounding is to."""
    total = 0.0
    for i in range(len(bodies.mass)):
        total += reach * length(add_scaled(at(bodies.weight, i), 1.0, at(bodies.load, i)))
    return total


@lent
def taken_up(
    touch: Touch, used: Index, rub: Vector, relative: Vector, gap: Vector, stiff: float,
    shear: float, mu: float,
) -> tuple[float, float, bool]:  # fmt: skip
    """Make touch.push and touch.spring what multipliers bear from now on: all of each force.

    gap: (c,) the true ones before the step [m]; stiff, shear: of the springs [N/m], by which
    touch.spring is a force. Returns the largest force [N], the most by which one is not what it
    will be: what springs bear, and what breaks the law of a contact; and whether friction turns
    slowly somewhere, since a pass turns it by the slip times the springs over mu N.
    """
    off, most, turns = 0.0, 0.0, False
    for k in range(len(touch.key)):
        n, moves = at(touch.normal, k), at(relative, k)
        opened, spring = dot(moves, n), NOWHERE
        push = -stiff * (touch.gap[k] + opened)
        if used[k] == OPEN:
            off, push = larger(off, push), 0.0
        else:
            off = larger(larger(off, stiff * abs(gap[k] + opened)), -push)
            most = larger(most, push)
        if used[k] == STICK:
            slip = add_scaled(moves, -opened, n)
            spring = add_scaled(at(touch.spring, k), 1.0, slip)
            off = larger(larger(off, shear * length(slip)), shear * length(spring) - mu * push)
        elif used[k] == SLIDE and shear > 0.0:
            spring = add_scaled(NOWHERE, 1.0 / shear, at(rub, k))
            turned = add_scaled(spring, -1.0, at(touch.spring, k))
            off = larger(off, shear * length(turned))
            slip = add_scaled(moves, -opened, n)
            faint = shear * length(slip) < FIRM * mu * push
            turns = turns or (faint and shear * length(turned) > HELD * mu * push)
            due = add_scaled(NOWHERE, mu * push, at(touch.way, k))
            off = larger(off, length(add_scaled(due, -1.0, at(rub, k))))
        touch.push[k] = push
        put(touch.spring, k, spring)
    return most, off, turns


@lent
def blurred(motion: Motion) -> float:
    """Below which a gap [m] is rounding of the coordinates that it is made of."""
    far = 0.0
    for k in range(len(motion.vertex)):
        far = larger(far, length(at(motion.vertex, k)))
    return ROUNDINGS * EPS * far


@lent
def relieve(touch: Touch, gap: Vector, stiff: float, times: float) -> None:
    """Shorten springs by what multipliers bear, as springs become so many times as stiff."""
    for k in range(len(touch.key)):
        touch.gap[k] = gap[k] - touch.push[k] / stiff
        put(touch.spring, k, add_scaled(NOWHERE, 1.0 / times, at(touch.spring, k)))


@lent
def jammed(touch: Touch) -> None:
    """Begin anew with contacts that stick: where one jams, none of its slips has an answer."""
    for k in range(len(touch.key)):
        touch.state[k], touch.push[k] = STICK, 0.0
        put(touch.spring, k, NOWHERE)


@called
def bear(
    d: Vector, touch: Touch, bodies: Bodies, motion: Motion, mass: Vector, outer: Vector,
    moved: Vector, begun: Vector, step: float, weight: float, kn: float, ks: float, mu: float,
    hold: float, tolerance: float, iterations: int, newton: int, elastic: Vector, most: int,
) -> tuple[bool, int, Index, Vector, Vector]:  # fmt: skip
    """As `iterate`, again and again, in at most so many passes, until springs bear nothing.

    kn, ks: where the springs begin, which become stiffer than the inertia of contacts, and again
    where a pass leaves more than SLOW, unless that is rounding and friction has turned as slip has.
    A pass that does not end is begun once more with all contacts stuck. touch: its pushes become
    the multipliers, and its springs those along the contact, over ks.
    """
    gap, firm = same_numbers(touch.gap, len(touch.key)), kn
    for light in lightness(touch, touch.state, bodies, step, weight):
        firm = larger(firm, FIRM * light)
    times, passes, solved, before, ended, anew = firm / kn, 0, 0, np.inf, False, False
    blur = blurred(motion)
    relieve(touch, gap, firm, times)
    while True:
        still, more, used, rub, relative = iterate(
            d, touch, bodies, motion, mass, outer, moved, begun, step, weight, firm,
            ks * times, mu, hold, tolerance, iterations, newton, elastic,
        )  # fmt: skip
        solved, passes = solved + more, passes + 1
        force, off, turns = taken_up(touch, used, rub, relative, gap, firm, ks * times, mu)
        slow = off > SLOW * before
        stuck = off > STUCK * before and off <= firm * blur
        ended = off <= HELD * force or (stuck and (not turns or passes >= PATIENT))
        if ended or passes >= most or (anew and not still):
            break
        if not still:
            jammed(touch)
            anew = True
        grow = 10.0 if slow else 1.0
        before, firm, times = off, firm * grow, times * grow
        relieve(touch, gap, firm, grow)
    relieve(touch, gap, np.inf, 1.0 / times)
    return ended, solved, used, rub, relative


@lent
def close_borne(
    ledger: Vector, worst: Vector, pull: Vector, touch: Touch, used: Index, rub: Vector,
    relative: Vector, moved: Vector, ks: float, mu: float,
) -> None:  # fmt: skip
    """As `close_step`, for contacts that store nothing: what they do not rub away is lost.

    touch: what `bear` made of it.
    """
    for a in range(len(pull)):
        pull[a] = 0.0
    for k in range(len(touch.key)):
        n, push, rubs = at(touch.normal, k), touch.push[k], NOWHERE
        opened = dot(at(relative, k), n)
        slip = add_scaled(at(relative, k), -opened, n)
        if used[k] == STICK:
            rubs = add_scaled(NOWHERE, -ks, at(touch.spring, k))
            ledger[NUMERICAL] -= dot(rubs, slip)
        elif used[k] == SLIDE:
            rubs = add_scaled(NOWHERE, -1.0, at(rub, k))
            ledger[FRICTION] -= dot(rubs, slip)
            ledger[CREATED] += larger(0.0, dot(rubs, slip))
        ledger[NUMERICAL] -= push * opened
        ledger[CREATED] += larger(0.0, push * opened)
        force = add_scaled(rubs, push, n)
        put(touch.force, k, force)
        for m in range(touch.columns[k]):
            pull[touch.column[k, m]] += dot(at(touch.field[k], m), force)
        worst[EXCESS] = larger(worst[EXCESS], length(rubs) - mu * push)
        worst[PEAK] = larger(worst[PEAK], push)
        if touch.wall[k] >= 0:
            ledger[BASE] += dot(force, at(moved, touch.wall[k]))
        touch.gap[k] += opened
        worst[DEEPEST] = larger(worst[DEEPEST], -touch.gap[k])

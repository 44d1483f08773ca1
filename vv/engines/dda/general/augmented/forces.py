"""What multipliers take over from springs, and below which size it is rounding."""

from __future__ import annotations

import numpy as np

from vv.engines.dda.general.bodies import Motion
from vv.engines.dda.general.contact import Touch, opening
from vv.engines.dda.general.setting import Law, Trial
from vv.engines.dda.law import OPEN, SLIDE, STICK
from vv.engines.dda.limits import FIRM, HELD
from vv.engines.kernels.arrays import larger, same_numbers
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot, put
from vv.scene import Vector

EPS = float(np.finfo(float).eps)
FRESH = 4.0  # roundings in a gap: of the vertex, the wall's point, their difference, and a product
ROUNDINGS = 1024.0  # of coordinates: the random walk of a million rounded steps


@lent
def length(a: Triple) -> float:
    """The length of a vector."""
    return float(np.sqrt(dot(a, a)))


@lent
def slip_rounding(k: int, touch: Touch, u: Vector, shut: Vector) -> float:
    """The size [m] below which slip of contact k is rounding of the sum from which it is computed.

    u: (q,) unknowns; shut: (c, 3) displacements of walls [m]. Each term adds at most a unit of
    rounding of the sum of all sizes.
    """
    terms = length(at(shut, k))
    for m in range(touch.columns[k]):
        terms += abs(u[touch.column[k, m]]) * length(at(touch.field[k], m))
    return float((1.0 + touch.columns[k]) * EPS * terms)


@lent
def take_over_forces(
    touch: Touch, trial: Trial, gap: Vector, u: Vector, law: Law
) -> tuple[float, float, bool]:
    """Set touch.push and touch.spring to the whole contact forces, which the multipliers take over.

    gap: (c,) actual gaps before the step [m]; u: (q,) unknowns; touch.spring is a force divided by
    ks. Returns the largest force [N]; the largest error of a force [N], either carried by a spring
    or violating the contact law; and whether friction still rotates slowly somewhere. A pass
    rotates friction by the slip times ks over mu N: where slip is rounding, it rotates for ever.
    """
    used, rub, relative = trial.used, trial.rub, trial.relative
    stiff, shear, mu = law.kn, law.ks, law.mu
    off, most, turns = 0.0, 0.0, False
    for k in range(len(touch.key)):
        n, moves = at(touch.normal, k), at(relative, k)
        opened, spring = opening(k, touch, u, trial.shut), NOWHERE
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
            least = larger(HELD * mu * push, shear * slip_rounding(k, touch, u, trial.shut))
            turns = turns or (faint and shear * length(turned) > least)
            due = add_scaled(NOWHERE, mu * push, at(touch.direction, k))
            off = larger(off, length(add_scaled(due, -1.0, at(rub, k))))
        touch.push[k] = push
        put(touch.spring, k, spring)
    return most, off, turns


@lent
def gap_rounding(motion: Motion) -> float:
    """The size below which a gap [m] is rounding of the coordinates from which it is computed."""
    far = 0.0
    for k in range(len(motion.vertex)):
        far = larger(far, length(at(motion.vertex, k)))
    return ROUNDINGS * EPS * far


@called
def gaps_beyond_rounding(touch: Touch, motion: Motion) -> Vector:
    """The gaps (c,) before the step [m]; those that fresh rounding explains are zero.

    A narrow groove magnifies a gap by 1/sin(xi/2) to the displacement that closes it. At a block
    that hardly slides, this would turn friction, which then carries the block.
    """
    gap, least = same_numbers(touch.gap, len(touch.key)), FRESH / ROUNDINGS * gap_rounding(motion)
    for k in range(len(gap)):
        if abs(gap[k]) <= least:
            gap[k] = 0.0
    return gap


@lent
def shorten_springs(touch: Touch, gap: Vector, stiff: float, times: float) -> None:
    """Shorten springs by what multipliers carry, when springs become `times` as stiff."""
    for k in range(len(touch.key)):
        touch.gap[k] = gap[k] - touch.push[k] / stiff
        put(touch.spring, k, add_scaled(NOWHERE, 1.0 / times, at(touch.spring, k)))

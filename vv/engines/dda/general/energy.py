"""The energy ledger of a DDA step, as kernels; no term is computed as a remainder."""

from __future__ import annotations

import numpy as np

from vv.engines.dda.general.bodies import Bodies, Motion, times_blocks
from vv.engines.dda.general.contact import Touch
from vv.engines.dda.general.setting import Law, Part, Setting, Trial, Work
from vv.engines.dda.law import OPEN, SLIDE, STICK
from vv.engines.kernels.arrays import larger, numbers
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot, put
from vv.scene import Vector

KINETIC, NORMAL, SHEAR, STRAIN, FRICTION, NUMERICAL, DAMPED = range(7)
GRAVITY, LOAD, BASE, SHAKING, FOUND, CREATED = range(7, 13)
TERMS = 13
RESIDUAL, ITERATIONS, DEEPEST, CUT, FAILED, SOLVED, EXCESS, ADRIFT, PEAK, QUICKEST = range(10)
REPORTS = 10
PUT_IN, WORKED, SPARE, LIMIT = range(4)
FUNDS = 4


@called
def store_energies(
    ledger: Vector, touch: Touch, bodies: Bodies, motion: Motion, mass: Vector,
    kn: float, ks: float, elastic: Vector,
) -> None:  # fmt: skip
    """Set the kinetic and elastic energies in the ledger to their present values [J]."""
    flow = numbers(len(motion.velocity))
    ledger[KINETIC] = 0.5 * times_blocks(flow, mass, bodies, motion.velocity)
    ledger[STRAIN] = 0.5 * times_blocks(flow, elastic, bodies, motion.strain)
    ledger[NORMAL] = ledger[SHEAR] = 0.0
    for k in range(len(touch.key)):
        over = larger(-touch.gap[k], 0.0)
        ledger[NORMAL] += 0.5 * kn * over * over
        ledger[SHEAR] += 0.5 * ks * dot(at(touch.spring, k), at(touch.spring, k))


@lent
def add_contact_energies(work: Work, touch: Touch, trial: Trial, over: float, law: Law) -> None:
    """Add the energies of contacts in a step to the ledger; update springs and gaps (c,).

    `pull` is set to their generalised forces. Displacements of contacts and walls are those at the
    time at which forces are evaluated; those of the whole step are `over` times as large. A force F
    does the work F d over a step d; the difference to the energy of its spring is numerical
    dissipation. It is one function since all energies of a contact follow from the same few
    numbers.
    """
    ledger, worst, used, rub, relative = (
        work.ledger, work.worst, trial.used, trial.rub, trial.relative,
    )  # fmt: skip
    kn, ks, mu, hold = law.kn, law.ks, law.mu, law.hold
    for a in range(len(work.pull)):
        work.pull[a] = 0.0
    for k in range(len(touch.key)):
        n = at(touch.normal, k)
        opened = dot(at(relative, k), n)
        slip = add_scaled(at(relative, k), -opened, n)
        before, after = touch.gap[k], touch.gap[k] + over * opened
        deep, deeper = larger(-before, 0.0), larger(-after, 0.0)
        sprung = 0.5 * kn * (deep * deep - deeper * deeper)
        push = -kn * (before + opened) if used[k] != OPEN else 0.0
        left = sprung - push * (over * opened)
        ledger[NUMERICAL] += left
        ledger[CREATED] += larger(0.0, -left)
        rubs, spring = NOWHERE, at(touch.spring, k)
        stretch = 0.5 * ks * dot(spring, spring)
        if used[k] == STICK:
            rubs = add_scaled(NOWHERE, -ks, add_scaled(spring, 1.0, slip))
            slip = add_scaled(NOWHERE, over, slip)
            spring = add_scaled(spring, 1.0, slip)
            stretch -= dot(rubs, slip) + 0.5 * ks * dot(spring, spring)
        elif used[k] == SLIDE:
            taken, was = at(rub, k), spring
            borne = add_scaled(NOWHERE, hold / ks if ks > 0.0 else 0.0, taken)
            spring = add_scaled(borne, over - 1.0, add_scaled(borne, -1.0, was))
            jump = add_scaled(spring, -1.0, was)
            stretch += hold * dot(taken, jump) - 0.5 * ks * dot(spring, spring)
            slip = add_scaled(add_scaled(NOWHERE, over, slip), -hold, jump)
        else:
            spring = NOWHERE
        put(touch.spring, k, spring)
        ledger[NUMERICAL] += stretch
        if used[k] == SLIDE:
            taken = at(rub, k)
            gained = -dot(taken, slip)
            ledger[FRICTION] -= gained
            ledger[CREATED] += larger(0.0, gained)
            rubs = add_scaled(NOWHERE, -1.0, taken)
            if touch.state[k] == SLIDE:
                due = add_scaled(NOWHERE, mu * touch.push[k], at(touch.direction, k))
                off = add_scaled(due, -1.0, taken)
                worst[RESIDUAL] = larger(worst[RESIDUAL], np.sqrt(dot(off, off)))
        add_force(work, touch, k, push, rubs, over)
        worst[EXCESS] = larger(worst[EXCESS], np.sqrt(dot(rubs, rubs)) - mu * larger(push, 0.0))
        touch.gap[k] = after
        worst[DEEPEST] = larger(worst[DEEPEST], -after)


@lent
def add_force(work: Work, touch: Touch, k: int, push: float, rubs: Triple, over: float) -> None:
    """Add the force of contact k to the generalised ones, and its work on a wall to the ledger."""
    worst, force = work.worst, add_scaled(rubs, push, at(touch.normal, k))
    put(touch.force, k, force)
    for m in range(touch.columns[k]):
        work.pull[touch.column[k, m]] += dot(at(touch.field[k], m), force)
    worst[PEAK] = larger(worst[PEAK], push)
    if touch.wall[k] >= 0:
        work.ledger[BASE] += over * dot(force, at(work.moved, touch.wall[k]))


@called
def check_momentum(work: Work, setting: Setting, motion: Motion, part: Part) -> None:
    """Store the largest error of a block's momentum balance in a part of a step, and the peak [N].

    The peak is the largest of all forces.
    """
    worst, pull, outer, u, predictor = work.worst, work.pull, work.outer, work.u, work.predictor
    bodies, step, weight = setting.bodies, part.length, part.weight
    q = len(u)
    change, strain = numbers(q), numbers(q)
    gain, held_back = numbers(q), numbers(q)
    for a in range(q):
        change[a] = weight / step * (u[a] / step - predictor[a])
        strain[a] = motion.strain[a] + u[a]
    times_blocks(gain, work.mass, bodies, change)
    times_blocks(held_back, setting.elastic, bodies, strain)
    for a in range(q):
        line = at(bodies.line, a)
        if dot(line, line) > 0.0:
            off = gain[a] + held_back[a] - outer[a] - pull[a]
            worst[ADRIFT] = larger(worst[ADRIFT], abs(off))
            worst[PEAK] = larger(larger(worst[PEAK], abs(gain[a])), abs(outer[a]))

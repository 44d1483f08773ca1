"""Augmented Lagrangian: multipliers take over the forces of springs until gaps are zero.

A spring carries only the force that its multiplier does not: its gap and stretch are shifted by the
multiplier over the stiffness, and open-close and Newton's iteration take the shifted values for
those of the contact (Lin, Amadei, Jung and Dwyer 1996; with friction Simo and Laursen 1992). Such a
contact stores no energy.
"""

from __future__ import annotations

import numpy as np

from vv.engines.dda.general.augmented.firmness import firm_springs
from vv.engines.dda.general.augmented.forces import (
    gap_rounding,
    gaps_beyond_rounding,
    length,
    shorten_springs,
    take_over_forces,
)
from vv.engines.dda.general.augmented.restarts import go_back, iterate_anew, restart_sticking
from vv.engines.dda.general.bodies import Bodies, Motion
from vv.engines.dda.general.contact import Touch, opening, states_of
from vv.engines.dda.general.energy import (
    CREATED,
    DEEPEST,
    EXCESS,
    FRICTION,
    NUMERICAL,
    add_force,
)
from vv.engines.dda.general.iterate import iterate, trial_of
from vv.engines.dda.general.setting import Law, Part, Setting, Trial, Work
from vv.engines.dda.law import SLIDE, STICK
from vv.engines.dda.limits import HELD, PATIENT, SLOW, STUCK
from vv.engines.kernels.arrays import larger, same_numbers, smaller
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import NOWHERE, add_scaled, at, dot
from vv.scene import Vector


@lent
def energy_of_fall(bodies: Bodies, reach: float) -> float:
    """The energy [J] that blocks gain if all move by `reach` [m] under their loads.

    It takes the place of stored energy in the limit beyond which a run has diverged.
    """
    total = 0.0
    for i in range(len(bodies.mass)):
        total += reach * length(add_scaled(at(bodies.weight, i), 1.0, at(bodies.load, i)))
    return total


@called
def iterate_softly(
    touch: Touch, work: Work, setting: Setting, motion: Motion, law: Law, part: Part, gap: Vector,
    trial: Trial,
) -> tuple[int, Trial]:  # fmt: skip
    """Repeat `iterate` with these springs, from multipliers that stiffer ones have found.

    The stiffer springs turn rounding of displacements into forces that nothing balances. Passes end
    when springs carry nothing; one that does not converge is undone, and so is one that leaves more
    than STUCK. gap: (c,) before the step [m]; trial: the solution so far. Returns how many
    solutions were made, and the last that holds.
    """
    solved, before, last = 0, np.inf, trial
    for _ in range(PATIENT):
        shorten_springs(touch, gap, law.kn, 1.0)
        kept, u = states_of(touch), same_numbers(work.u, len(work.u))
        still, more, trial = iterate(touch, work, setting, motion, law, part)
        solved += more
        force, off, _ = take_over_forces(touch, trial, gap, work.u, law)
        if not still or off > STUCK * before:
            go_back(touch, kept, work, u)
            break
        before, last = off, trial
        if off <= HELD * force:
            break
    return solved, last


@called
def iterate_multipliers(
    touch: Touch, work: Work, setting: Setting, motion: Motion, part: Part
) -> tuple[bool, int, Trial]:
    """Repeat `iterate` in at most so many passes as choices say, until springs carry nothing.

    The stiffnesses of springs are first raised by `firm_springs`, and again after passes that leave
    more than SLOW of the forces, unless the rest is rounding and friction has rotated with the
    slip. A pass that does not converge is repeated once with all contacts sticking, and those after
    it, see `iterate_anew`; where it follows one that left rounding alone, that one is the solution.
    At the end springs are softened again, see `iterate_softly`. The normal forces in touch become
    the multipliers, and its springs the tangential multipliers over ks.
    """
    most, kn, ks = setting.choices.multipliers, setting.law.kn, setting.law.ks
    gap = gaps_beyond_rounding(touch, motion)
    soft, start = firm_springs(touch, setting.bodies, part, kn)
    firm, times, passes, solved = soft, start, 0, 0  # times: shear springs over ks
    before, ended, anew, grow = np.inf, False, False, 1.0
    blur, last = gap_rounding(motion), trial_of(touch, work.moved)
    shorten_springs(touch, gap, firm, times)
    while True:
        law = Law(firm, ks * times, setting.law.mu, setting.law.hold)
        kept, u = states_of(touch), same_numbers(work.u, len(work.u))
        still, more, trial = iterate(touch, work, setting, motion, law, part)
        solved, passes = solved + more, passes + 1
        if anew and not still:
            still, more, trial = iterate_anew(touch, kept, work, setting, motion, law, part)
            solved += more
        force, off, turns = take_over_forces(touch, trial, gap, work.u, law)
        slow, close = off > SLOW * before, still and off <= HELD * force
        undone = not still and before <= firm * blur
        even = grow == 1.0 or turns  # else springs that stiffened may bear more, and converge
        stuck = undone or (still and even and STUCK * before < off <= firm * blur)
        ended = close or (stuck and (not turns or passes >= PATIENT))
        if ended and undone:
            go_back(touch, kept, work, u)
            trial = last
        if ended or passes >= most or (anew and not still):
            break
        if not still:
            restart_sticking(touch)
            anew = True
        grow = 10.0 if slow and (turns or off > firm * blur) else 1.0
        before, firm, times, last = off if still else np.inf, firm * grow, times * grow, trial
        shorten_springs(touch, gap, firm, grow)
    if ended and firm > soft:
        times = start
        law = Law(soft, ks * times, setting.law.mu, setting.law.hold)
        shorten_springs(touch, gap, soft, soft / firm)
        more, trial = iterate_softly(touch, work, setting, motion, law, part, gap, trial)
        solved += more
    shorten_springs(touch, gap, np.inf, 1.0 / times)
    return ended, solved, trial


@lent
def add_multiplier_energies(work: Work, touch: Touch, trial: Trial, law: Law) -> None:
    """As `add_contact_energies`, for contacts that store none: all work but friction's is lost.

    touch: as `iterate_multipliers` left it.
    """
    ledger, worst, pull = work.ledger, work.worst, work.pull
    used, relative, ks, mu = trial.used, trial.relative, law.ks, law.mu
    for a in range(len(pull)):
        pull[a] = 0.0
    for k in range(len(touch.key)):
        n, push, rubs = at(touch.normal, k), touch.push[k], NOWHERE
        opened = opening(k, touch, work.u, trial.shut)
        slip = add_scaled(at(relative, k), -opened, n)
        if used[k] == STICK:
            rubs = add_scaled(NOWHERE, -ks, at(touch.spring, k))
            ledger[NUMERICAL] -= dot(rubs, slip)
        elif used[k] == SLIDE:
            rubs = add_scaled(NOWHERE, -1.0, at(trial.rub, k))
            gained = dot(rubs, slip)  # positive in steps in which a slide turns
            ledger[FRICTION] -= smaller(gained, 0.0)
            ledger[NUMERICAL] -= larger(gained, 0.0)
            ledger[CREATED] += larger(0.0, gained)
        ledger[NUMERICAL] -= push * opened
        ledger[CREATED] += larger(0.0, push * opened)
        add_force(work, touch, k, push, rubs, 1.0)
        worst[EXCESS] = larger(worst[EXCESS], length(rubs) - mu * push)
        touch.gap[k] += opened
        worst[DEEPEST] = larger(worst[DEEPEST], -touch.gap[k])

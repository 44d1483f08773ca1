"""How passes of the augmented Lagrangian start again that did not converge, or go back."""

from __future__ import annotations

from vv.engines.dda.general.bodies import Motion
from vv.engines.dda.general.contact import States, Touch, restore_states
from vv.engines.dda.general.iterate import iterate
from vv.engines.dda.general.setting import Law, Part, Setting, Trial, Work
from vv.engines.dda.law import OPEN, STICK
from vv.engines.dda.limits import EIGHTHS
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import NOWHERE, put
from vv.scene import Vector


@lent
def restart_sticking(touch: Touch) -> None:
    """Restart with all contacts sticking: for a jammed block no slipping state has a solution."""
    for k in range(len(touch.key)):
        touch.state[k], touch.push[k] = STICK, 0.0
        put(touch.spring, k, NOWHERE)


@called
def iterate_anew(
    touch: Touch, kept: States, work: Work, setting: Setting, motion: Motion, law: Law, part: Part
) -> tuple[bool, int, Trial]:
    """Repeat `iterate` from open contacts while friction grows in EIGHTHS from none to mu N.

    Without friction the problem is convex, and from each solution Newton's iteration finds the next
    in most scenes. Where a corner strikes that friction drags, it can end elsewhere at a residual
    that no increment reduces. kept: the contacts before the pass. Returns what `iterate` does with
    the whole friction.
    """
    restore_states(touch, kept)
    for k in range(len(touch.key)):
        touch.state[k], touch.push[k] = OPEN, 0.0
    still, solved, trial = iterate(
        touch, work, setting, motion, Law(law.kn, law.ks, 0.0, law.hold), part
    )
    for rise in range(1, EIGHTHS + 1):
        grown = Law(law.kn, law.ks, law.mu * rise / EIGHTHS, law.hold)
        still, more, trial = iterate(touch, work, setting, motion, grown, part)
        solved += more
    return still, solved, trial


@lent
def go_back(touch: Touch, kept: States, work: Work, u: Vector) -> None:
    """Set contacts and the unknowns `work.u` to what they were before a pass."""
    restore_states(touch, kept)
    for a in range(len(u)):
        work.u[a] = u[a]

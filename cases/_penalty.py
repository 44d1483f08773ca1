"""Settings for scenes with rigid contact: stiffnesses of the springs, and steps for each."""

from vv.ask import Knobs
from vv.case import Level

# w dt is 0.2 at most, where w = sqrt(kn/m) of a cubic metre of rock; three steps to each stiffness,
# so that errors of the step and of the stiffness can be separated
STEPS = {
    1e8: (1e-3, 5e-4, 2.5e-4),
    1e9: (1e-4, 5e-5, 2.5e-5),
    1e10: (5e-5, 2.5e-5, 1.25e-5),
}
RUNGS = tuple(Knobs(dt, kn) for kn, steps in STEPS.items() for dt in steps)


def levels(*stiffer: Knobs) -> dict[Level, tuple[Knobs, ...]]:
    """Two steps on the softest springs, where they are cheapest, and one for each stiffer one.

    These are finer, so that a code whose contact is rigid has three steps at least, of which order
    is fitted. At the level of the paper there are all settings, with three steps to each stiffness.
    """
    usual = (*RUNGS[:2], *stiffer)
    whole = sorted({*usual, *RUNGS}, key=lambda rung: (rung.kn or 0.0, -(rung.dt or 0.0)))
    return {Level.QUICK: RUNGS[:2], Level.DEFAULT: usual, Level.PAPER: tuple(whole)}

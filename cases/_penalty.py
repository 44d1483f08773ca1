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
COARSEST = tuple(Knobs(steps[0], kn) for kn, steps in STEPS.items())  # of each stiffness: timed
LEVELS = {
    Level.QUICK: RUNGS[:2],
    Level.DEFAULT: (*RUNGS[:3], *COARSEST[1:]),  # three steps where they are cheapest
    Level.PAPER: RUNGS,
}
# for variants that are not timed: the stiffest springs are left out
FEWER = {**LEVELS, Level.DEFAULT: RUNGS[:4]}

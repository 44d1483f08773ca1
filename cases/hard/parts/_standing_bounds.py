"""Bounds of stacks and arches that stand, and of an arch that falls."""

from __future__ import annotations

from vv.ask import Method
from vv.case import Exact, Tolerance

SPRUNG = (Method.PENALTY, Method.LAGGING)
PRESSED = (
    "springs start compressed by the loads; they neither oscillate nor open, and rounding adds up "
    "along a stack"
)
SETTLES = (
    "springs start compressed by the weights; where a joint opens at one edge, the other "
    "sinks by W/kn, 1e-6 m"
)
RESTS = Tolerance(
    5e-9,
    "nothing moves, so that the energies of motion give no scale for rounding errors. These move a "
    "stack by 3e-7 of its size in 10 s at most, which changes its energy by a fraction of the work "
    "of its weight over that",
)
SINKING = Tolerance(
    2e-8,
    "contacts are solved to 5e-6 m/s or better, in fact to about 1e-8 m/s, at which the blocks "
    "would sink by 2e-9 of their size in 0.2 s: friction may add some times the energy of that",
)
STANDS = Exact(
    {
        Method.SECOND_ORDER: Tolerance(
            1e-10, "contacts whose loads do not change are solved to rounding, over one second"
        ),
        Method.FIRST_ORDER: Tolerance(1e-7, "contacts are solved to about 1e-8 m/s, over a second"),
        Method.PENALTY: Tolerance(1e-6, SETTLES),
        Method.LAGGING: Tolerance(
            1e-5,
            SETTLES,
            slack="springs that start with the forces of rest settle less",
        ),
    }
)
HINGED = (
    "joints that yield act like a thinner arch: it falls twice as fast on 1e9 N/m, 1.2 times as "
    "fast on 1e10 N/m and 1.04 times on 1e11 N/m. With lagging friction, open-close iterations end "
    "beyond Coulomb's limit, and the run diverges at steps of 5e-3 s and 6.25e-4 s, which are left "
    "out here"
)


def stack_bounds(n: float) -> Exact:
    """The judge of a stack of n blocks, whose tilts add up towards the top."""
    creep = Tolerance(
        5e-7 * (n / 20) ** 2,
        "contacts are solved to about 1e-9 m/s; over 10 s, with tilts that add up, a stack of "
        "twenty may creep by half a micrometre, and another in proportion to the square of its "
        "height",
        slack="a short stack is solved to rounding in most steps",
    )
    sweeps = Tolerance(
        1e-5 * max(1.0, (n / 20) ** 2),
        "contacts that a code solves to a tolerance of its own creep by micrometres in 10 s, in "
        "proportion to the square of the height",
    )
    rigid = {Method.SECOND_ORDER: creep, Method.FIRST_ORDER: sweeps}
    return Exact(rigid | dict.fromkeys(SPRUNG, Tolerance(1e-12 * max(1.0, n / 20), PRESSED)))


def fall_bounds(pace: float) -> Exact:
    """The judge of an arch that falls; pace: by what its steps are multiplied."""
    return Exact(
        {
            Method.SECOND_ORDER: Tolerance(
                3e-4, "contacts are solved to 5e-6 m/s, and the arch sinks at up to 1e-2 m/s",
                dt=2.5e-3 * pace, order=2,
            ),
            Method.FIRST_ORDER: Tolerance(
                2.5e-2, "the fall starts half a step late, an error of dt over the 0.2 s of the "
                "fall; twice that is allowed",
                dt=2.5e-3 * pace, order=1,
            ),
        },
        not_judged=dict.fromkeys(SPRUNG, HINGED),
    )  # fmt: skip

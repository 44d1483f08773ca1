"""T3 for 20 s: a shear spring that oscillates exactly up to the limit of friction."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np

from cases._papers import LI_2018
from cases.contact.single_contact import CASE as SINGLE_CONTACT
from reference_solutions.contact import single_contact as closed
from vv.ask import Displacement, History, Knobs, Method, Run
from vv.case import (
    Case,
    Count,
    Exact,
    Ladder,
    Level,
    Parameters,
    Scalar,
    Shown,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Vector

SHEAR = SINGLE_CONTACT.variant("T3")
OWN = ("rho", "r", "kn", "ks", "mu", "eta", "v_b")
SPHERE = Displacement(1)
GOAL = History(20.0, 1e-3)
SEEN = 1e-8  # of the largest stretch: a smaller shift of an oscillation's centre is due to rounding
NEAR = 2  # outputs beside a turning point that a slip there may have affected


def _declare(variant: str, p: Parameters) -> Trial:
    own = {name: p[name] for name in OWN}
    scene = SINGLE_CONTACT.declare("T3", {**SINGLE_CONTACT.defaults("T3"), **own}).study.scene
    usual = SINGLE_CONTACT.defaults("T3")
    unit = _swings(usual) / _swings(p)  # the duration of an oscillation over that at the defaults
    goal = History(unit * GOAL.duration, unit * GOAL.interval)
    levels = {
        level: tuple(Knobs(dt=unit * (one.dt or 0.0)) for one in rungs)
        for level, rungs in LEVELS.items()
    }
    limit = p["mu"] * p["kn"] * closed.overlap(**own) / p["ks"]
    return Trial(Ladder(scene, goal, (SPHERE,), levels), _quantities(scene.axes[1], limit))


def _quantities(along: Vector, limit: float) -> tuple[Count, Scalar]:
    """The slips of a sphere that moves `along` a direction, whose spring stretches to limit [m]."""

    def steps(run: Run) -> Vector:
        """The shift of the centre of each oscillation from the one before, over the limit."""
        middles = list(_centres(run.values[SPHERE] @ along))
        return np.asarray(np.abs(np.diff([0.0, *middles])) / limit)

    slips = Count(
        name="slips",
        symbol="n",
        meaning="number of slips: the centre of an oscillation differs from that of the one before",
        observe=lambda run: int(np.count_nonzero(steps(run) > SEEN)),
        reference=1,
        judge=Exact(
            {
                Method.EXACT: Tolerance(
                    1e-6,
                    "the sphere slips once, at the beginning; the number of slips is either right "
                    "or wrong",
                    slack="a number that is right has no error",
                )
            },
            not_judged={Method.SECOND_ORDER: GRAZES},
        ),
    )
    crept = Scalar(
        name="crept",
        symbol="sum |c|",
        unit="",
        meaning="total shift of the centres after the first slip, over the largest stretch",
        observe=lambda run: float(steps(run)[1:].sum()),
        reference=None,
        scale=1.0,
        judge=Shown("the displacement by spurious slips; there is none in the exact motion"),
    )
    return slips, crept


def _swings(p: Parameters) -> float:
    """The rate of the oscillation on the shear spring [1/s]."""
    return float(np.sqrt(p["ks"] / closed.mass(p["rho"], p["r"])))


def _centres(y: Vector) -> Iterator[float]:
    """The centre of each half oscillation between turning points, from its outputs (k,) [m].

    An oscillation about c obeys y_(n+1) + y_(n-1) - 2c = q (y_n - c) at equal intervals, at any
    frequency and, in a leapfrog, at any step: a straight line in y_n, which is fitted.
    """
    turns = np.flatnonzero(np.diff(y[:-1]) * np.diff(y[1:]) < 0) + 1
    for begin, end in itertools.pairwise(turns):
        swing = y[begin + NEAR : end - NEAR + 1]
        inner, around = swing[1:-1], swing[2:] + swing[:-2]
        mean = inner.mean()
        off = inner - mean
        q = float(off @ around / (off @ off))
        yield float((around.mean() - q * mean) / (2 - q))


RUNGS = tuple(Knobs(dt=dt) for dt in (4e-3, 2e-3, 1e-3, 5e-4, 1e-4))
# no step is judged but by its energy; three show that the number of slips does not converge
LEVELS = {Level.QUICK: RUNGS[:3:2], Level.DEFAULT: RUNGS[:3], Level.PAPER: RUNGS}
GRAZES = (
    "the largest shear force equals the limit of friction to the last digit: the sign of an error "
    "decides whether the sphere slips, so that the number of slips does not converge with the step"
)
COUNTED = (
    "slips are counted, and there is one at any parameters, since the wall is pressed in as far as "
    "they require; single-contact:T3 judges the path"
)
CASE = Case(
    name="grazing",
    title="Touching the limit of friction",
    source=Source(
        *LI_2018,
        "T3, which ends at 0.4 s in the paper, goes on for 20 s. In its third stage the sphere "
        "oscillates about b with the amplitude y1 = mu kn dx/ks, at which the shear force is mu Fn "
        "and the velocity is zero.",
    ),
    parameters=tuple(one for one in SINGLE_CONTACT.parameters if one.name in OWN),
    variants=(
        Variant(
            "T3",
            SHEAR.summary,
            SHEAR.formula,
            inert=SHEAR.inert - {"v_a"},
            unseen=dict.fromkeys(("rho", "r", "ks", "eta", "v_b"), COUNTED),
        ),
    ),
    declare=_declare,
)

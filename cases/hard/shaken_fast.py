"""The responding block on a base that shakes so fast that the block hardly moves."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from cases.blocks.responding_block import CASE as RESPONDING_BLOCK
from vv.ask import Displacement, History, Knobs, Method, Run
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Parameters,
    Scalar,
    Series,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Vector

OWN = ("D", "f", "mu", "g", "duration")
BLOCK = Displacement(1)
SAMPLES = 20  # outputs in a period
ALONG_X = RESPONDING_BLOCK.variant("1d")


def _declare(variant: str, p: Parameters) -> Trial:
    whole = {**RESPONDING_BLOCK.defaults("1d"), **p}
    one = RESPONDING_BLOCK.declare("1d", whole)
    goal = History(p["duration"], 1 / (SAMPLES * p["f"]))
    study = Ladder(one.study.scene, goal, (BLOCK,), LEVELS[variant])
    path = one.quantities[0]
    assert isinstance(path, Series)
    judged = PATH if _friction_share(p) < SLIPS else {**PATH, Method.SECOND_ORDER: _follows(p)}
    d2 = dataclasses.replace(path, judge=Exact(judged, not_judged=SPRINGS))
    settled = p["duration"] * 4 * _friction_share(p) * p["f"] > 10 * (1 - 1e-9)
    return Trial(study, (d2, _mean(p)) if settled and _friction_share(p) < SLIPS else (d2,))


def _friction_share(p: Parameters) -> float:
    """The largest acceleration by friction over that of the base, mu g/(D w^2)."""
    return p["mu"] * p["g"] / (p["D"] * (2 * math.pi * p["f"]) ** 2)


def _follows(p: Parameters) -> Tolerance:
    """The bound of a block that sticks to the base for a while."""
    dt, located = FIVE[0].dt, PATH[Method.SECOND_ORDER]
    assert dt is not None
    return Tolerance(
        (2 * math.pi * p["f"] * dt) ** 2 / 6,
        "while the block sticks its velocity is that of the base, whose mean over a step has an "
        f"error of (w dt)^2/12; twice that is allowed. Also, {located.reason}",
        dt=dt, order=2, floor=located.value,
    )  # fmt: skip


def _mean(p: Parameters) -> Scalar:
    """The mean place that the block reaches, after ten time constants pi D w/(2 mu g)."""
    part = _friction_share(p)
    limit = p["D"] * math.pi**2 / 4 * (1 - 2.3708 * part**2 + 0.32 * part**4)
    bound = Tolerance(
        1.5 * math.exp(-10) + 4 * part / SAMPLES**3 + 3 * part**6,
        "1.5 exp(-10) of the start is left after ten time constants; straight lines between n "
        "outputs a period cause 4 s/n^3, s = mu g/(D w^2), where the period begins and at its two "
        "reversals; the next term of the series is 3 s^6",
    )

    def last(run: Run) -> float:
        return period_mean(run.times, run.values[BLOCK] @ X, 1 / p["f"])

    return Scalar(
        name="mean",
        symbol="d2 mean",
        unit="m",
        meaning="mean of the last period, against D (pi^2/4)(1 - 2.3708 s^2 + 0.32 s^4), "
        "s = mu g/(D w^2)",
        observe=last,
        reference=limit,
        scale=limit,
        judge=Exact(dict.fromkeys(PATH, bound), not_judged=SPRINGS),
    )


def period_mean(times: Vector, moved: Vector, period: float) -> float:
    """Mean over the last period [s], which may begin between two outputs."""
    begin = times[-1] - period
    within = times > begin
    at = np.append(begin, times[within])
    values = np.append(np.interp(begin, times, moved), moved[within])
    return float(np.trapezoid(values, at) / period)


X = np.array([1.0, 0.0, 0.0])
SLIPS = 0.35  # of the base's acceleration: with more friction the block may stick for a while
FIVE = (Knobs(5e-4, 1e8), Knobs(2.5e-4, 1e8), Knobs(1e-4, 1e9))
TWENTY = (Knobs(2.5e-4, 1e8), Knobs(1e-4, 1e9))
HUNDRED = (Knobs(4e-5, 1e9), Knobs(2e-5, 1e10))
LEVELS = {
    "5hz": {Level.QUICK: FIVE[:2], Level.DEFAULT: FIVE, Level.PAPER: FIVE},
    "20hz": {Level.QUICK: TWENTY[:1], Level.DEFAULT: TWENTY[:1], Level.PAPER: TWENTY},
    "100hz": {Level.QUICK: HUNDRED[:1], Level.DEFAULT: HUNDRED, Level.PAPER: HUNDRED},
}
PATH = {
    Method.EXACT: Tolerance(
        5e-12,
        "rounding errors of the times of up to 2700 reversals; time itself is rounded to 1e-14 s "
        "at 67 s, in which the base moves by 3e-13 of the block's displacement",
        slack="at 100 Hz the run lasts a second only, and time is rounded less; one bound serves "
        "all",
    ),
    Method.SECOND_ORDER: Tolerance(
        2e-9,
        "the block's velocity is linear between reversals, which are located within the step: the "
        "tolerance of their location remains",
    ),
}
SPRINGS = dict.fromkeys(
    (Method.FIRST_ORDER, Method.PENALTY, Method.LAGGING),
    "friction that reverses on whole steps, or with the delay of a spring, leaves an error of "
    "velocity of up to what the base gains in that time, D w^2 dt: at 5 Hz and 5e-4 s that is 0.1 "
    "m/s of the 0.3 m/s that friction can give in half a period, and at 20 Hz ten times as much",
)
BOTH = {"D": 0.2, "mu": 0.6, "duration": 17.0}
CASE = Case(
    name="shaken-fast",
    title="Shaken fast",
    source=Source(
        *YAGODA_BIRAN_2016,
        "The paper has no high frequencies. D = 0.2 m and mu = 0.6 are chosen. The block's "
        "velocity decays with the time constant pi D w/(2 mu g), 1.7 s at 5 Hz and 6.7 s at 20 Hz, "
        "of which ten are simulated; at 100 Hz it is 33.5 s, and only the start is simulated.",
    ),
    parameters=tuple(one for one in RESPONDING_BLOCK.parameters if one.name in OWN),
    variants=(
        Variant("5hz", "ten time constants at 5 Hz", ALONG_X.formula, {**BOTH, "f": 5.0}),
        Variant(
            "20hz",
            "ten time constants at 20 Hz",
            ALONG_X.formula,
            {**BOTH, "f": 20.0, "duration": 68.0},
            level=Level.PAPER,
        ),
        Variant(
            "100hz",
            "a second at 100 Hz",
            ALONG_X.formula,
            {**BOTH, "f": 100.0, "duration": 1.0},
            level=Level.DEFAULT,
        ),
    ),
    declare=_declare,
)

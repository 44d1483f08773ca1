"""Quantities of a rocking block: its lean, errors until an impact, and its overturning."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

import numpy as np

from cases.blocks.parts._leaning import CENTRE, MOVING, Leaning, Y
from cases.blocks.parts._rocking_bounds import at_threshold
from reference_solutions.blocks import rocking
from vv.ask import Run
from vv.case import Exact, Parameters, Quantity, RotationAbout, Scalar, Series, Shown
from vv.scene import Vector

Law = dict[str, float]
NEARLY = (
    "relative to the lean, the error has no bound when the block starts to lean; so near the "
    "threshold it is the error of the threshold, which grows as exp(p t)"
)
JUDGED = "displacements are judged instead: the rate jumps at every impact"


@dataclass(frozen=True)
class ExactMotion:
    """The exact lean and its rate at times (k,) [s], which differ between settings."""

    law: tuple[tuple[str, float], ...]
    drive: tuple[tuple[str, float], ...]
    start: float

    def leans(self, t: Vector) -> Vector:
        return np.asarray(_phases_at(self, np.asarray(t, float).tobytes())[:, 0])

    def rates(self, t: Vector) -> Vector:
        return np.asarray(_phases_at(self, np.asarray(t, float).tobytes())[:, 1])


@functools.lru_cache(maxsize=16)  # for one setting, four quantities ask for the same times
def _phases_at(exact: ExactMotion, times: bytes) -> Vector:
    law = dict((*exact.law, *exact.drive))
    return rocking.phases(np.frombuffer(times), **law, theta=exact.start)


def phases(block: Leaning, rate: float, exact: ExactMotion) -> tuple[Quantity, ...]:
    """The lean over alpha and its rate over p alpha, which together make the phase plot."""
    alpha = block.alpha

    def angle(run: Run) -> Vector:
        return block.lean(run)[0] / alpha

    def swift(run: Run) -> Vector:
        return block.lean(run)[1] / (rate * alpha)

    return (
        Series("lean", "theta/alpha", "", "lean of the block over alpha",
               RotationAbout(CENTRE.body, Y, alpha, angle), lambda t: exact.leans(t) / alpha,
               Shown(JUDGED), 1.0),
        Series("rate", "theta'/(p alpha)", "", "rate of the lean over p alpha; plotted over the "
               "lean it gives the phase plot", swift, lambda t: exact.rates(t) / (rate * alpha),
               Shown(JUDGED), 1.0),
    )  # fmt: skip


def first_swing(block: Leaning, exact: ExactMotion, judge: Exact) -> Scalar:
    """The largest error of the lean up to the first impact, over alpha; it judges springs too."""

    def largest(run: Run) -> float:
        due = exact.leans(run.times)
        back = np.flatnonzero(due <= 0.0)
        swing = slice(0, int(back[0]) if len(back) else None)
        return float(np.abs(block.lean(run)[0][swing] - due[swing]).max() / block.alpha)

    return Scalar(
        "first swing", "max|e|/alpha", "", "largest error of the lean until the first impact, over "
        "alpha", largest, 0.0, 1.0, judge,
    )  # fmt: skip


def before_impact(block: Leaning, exact: ExactMotion) -> tuple[Quantity, ...]:
    """The paper's own measure of the error: of the lean under a pulse, until the block returns."""

    def largest(after: float, run: Run) -> float:
        lean, due = block.lean(run)[0], exact.leans(run.times)
        down = np.flatnonzero((due <= 0.0) & (run.times > after))
        there = (run.times >= after) & (run.times < (run.times[down[0]] if len(down) else np.inf))
        return float(np.abs(100.0 * (lean[there] / due[there] - 1.0)).max())

    return tuple(
        Scalar(f"E_N after {after:g} s", "E_N", "", f"largest E_N [%] after {after:g} s; the paper "
               f"states below {limit:g} %", functools.partial(largest, after), None, 1.0,
               Shown(NEARLY))
        for after, limit in ((0.3, 10.0), (0.5, 1.0))
    )  # fmt: skip


def overturning_time(block: Leaning, due: float, judge: Exact) -> Scalar:
    """The time that the block takes to overturn, `due` [s] if it is exact."""

    def when(run: Run) -> float:
        """The time at which the lean reaches 2 alpha, between outputs; nan if it does not."""
        lean, due_lean = block.lean(run)[0], 2 * block.alpha
        if not (lean > due_lean).any():
            return math.nan
        k = int(np.argmax(lean > due_lean))
        part = slice(max(0, k - 3), k + 3)
        from scipy.interpolate import CubicSpline

        return float(CubicSpline(lean[part], run.times[part])(due_lean))

    meaning = "time to overturn, when the block leans by 2 alpha"
    return Scalar("time", "t_o", "s", meaning, when, due, due, judge)


def threshold(p: Parameters, law: Law, w: float, most: float) -> Scalar:
    """The amplitude that would just overturn the block, from the energy that the pulse left."""
    step = 1e-5 * most
    rate = rocking.slenderness(**law)[1]
    far = math.hypot(p["b"], p["h"])

    def seen(run: Run) -> float:
        """The amplitude minus the excess of energy over its derivative by the amplitude."""
        x, _, z = run.values[CENTRE][-1] + np.array([-p["b"], 0.0, p["h"]])
        speed = float(np.linalg.norm(run.values[MOVING][-1])) / far
        too_much = speed**2 / 2 + rate**2 * (z / math.hypot(x, z) - 1)
        gain = (
            rocking.excess(most + step, **law, w=w) - rocking.excess(most - step, **law, w=w)
        ) / (2 * step)
        return float(most - (too_much - rocking.excess(most, **law, w=w)) / gain)

    meaning = "amplitude of the half-sine pulse that just overturns the block"
    return Scalar("threshold", "A", "m/s2", meaning, seen, most, most, at_threshold(w))

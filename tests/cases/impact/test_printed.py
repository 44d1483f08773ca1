"""Claims about values that MFiX prints: derived from outputs, and reproduced to 0.3 %."""

from collections.abc import Mapping

import numpy as np
import pytest

from cases.impact import mfix
from cases.impact.parts._printed import FALLS, TOPS
from reference_solutions.impact.dropped import Drop, path
from reference_solutions.impact.sinking import Sinking, motion
from vv.ask import Displacement, Observable, Run, Status, Velocity
from vv.case import CodeToCode, Level, Quantity, Trial
from vv.scene import Vector

Z = np.array([0.0, 0.0, 1.0])


def _trial(variant: str) -> tuple[Trial, dict[str, float]]:
    given = dict(mfix.CASE.defaults(variant))
    return mfix.CASE.declare(variant, given), given


def _run(times: Vector, values: Mapping[Observable, Vector]) -> Run:
    return Run(Status.RAN, "", times, {one: rows[:, None] * Z for one, rows in values.items()})


def _exact(variant: str) -> tuple[Trial, Run]:
    """A variant and its exact solution at the output times of codes."""
    trial, p = _trial(variant)
    goal = trial.study.goal
    times = goal.times(trial.study.rungs[Level.QUICK][0].dt)
    if variant == "dem06":
        law = Sinking(2.0 * p["R"], p["rho"], p["rho_f"], p["viscosity"], p["g"], p["v"])
        depth, speed = motion(times, law)
        return trial, _run(times, {Displacement(0): -depth, Velocity(0): -speed})
    mass = p["rho"] * 4.0 / 3.0 * np.pi * p["R"] ** 3
    drop, fall = Drop(mass, p["kn"], p["z"], p["g"]), p["h"] - p["R"]
    bounces = 1 if variant == "dem01" else 5
    return trial, _run(times, {Displacement(0): path(times, fall, bounces, drop) - fall})


def _beside(trial: Trial) -> list[Quantity]:
    return [one for one in trial.quantities if isinstance(one.judge, CodeToCode)]


def test_tops_of_bounces_are_read_between_outputs() -> None:
    trial, run = _exact("dem02-0.9")
    p = mfix.CASE.defaults("dem02-0.9")
    drop = Drop(2600 * 4 / 3 * np.pi * 1e-3, p["kn"], p["z"], p["g"])
    due = [0.1 + top for top in drop.tops(0.4, 5)]
    assert [one.observe(run) for one in _beside(trial)] == pytest.approx(due, rel=1e-9)


@pytest.mark.parametrize("variant", ["dem02-0.9", "dem06"])
def test_exact_answers_are_within_three_thousandths_of_what_mfix_prints(variant: str) -> None:
    trial, run = _exact(variant)
    kept = _beside(trial)
    assert len(kept) == (len(TOPS) if variant == "dem02-0.9" else 4)
    for one in kept:
        assert isinstance(one.judge, CodeToCode)
        assert one.observe(run) == pytest.approx(one.judge.answer.value, rel=3e-3)


def test_contact_that_never_pulls_stays_an_eighth_of_a_millimetre_from_mfix_s() -> None:
    trial, run = _exact("dem01")
    seen = np.array([one.observe(run) for one in _beside(trial)])
    off = np.abs(seen - list(FALLS.values())).max()
    assert 1.1e-4 < off < 1.25e-4

"""Claims about body accelerations that end, also in codes that have sines only."""

import math
from pathlib import Path

import numpy as np
import pytest

import adapters.dda
import adapters.liggghts
import adapters.rigid
import adapters.yade
from cases.blocks.rocking import CASE
from tests.scenes.blocks.block_scenes import box
from tests.support.installed import require
from vv.ask import Ask, Displacement, History, Knobs, Status
from vv.case import Ladder
from vv.codes import Adapter
from vv.scene import Contact, Harmonic, Pulse, Scene, Spheres

CODES: dict[str, Adapter] = {"yade": adapters.yade.ADAPTER, "liggghts": adapters.liggghts.ADAPTER}
OURS: dict[str, Adapter] = {"rigid": adapters.rigid.ADAPTER, "dda": adapters.dda.ADAPTER}
KN = {"dda": 1e8}  # N/m
A, F, CUT, END = 3.0, 2.0, 0.09, 0.2  # m/s2, Hz, s, s
X = np.array([1.0, 0.0, 0.0])


def shaken() -> Scene:
    """A sphere in the open, under a sine that is cut off long before it is zero."""
    ball = Spheres(np.zeros((1, 3)), np.zeros((1, 3)), np.array([0.1]), np.array([2.0]),
                   np.array([[True, False, False]]))  # fmt: skip
    pulse = Pulse(Harmonic(A * X, F * X), CUT)
    return Scene((ball,), Contact(1e6, 1e6, 0.5), shaking=pulse)


def shaken_block() -> Scene:
    """A block in the open, likewise."""
    block = box("box", np.zeros(3), np.full(3, 0.5), free=X > 0, free_spin=X > 1)
    pulse = Pulse(Harmonic(A * X, F * X), CUT)
    return Scene((block,), Contact(np.inf, mu=0.5), shaking=pulse)


@pytest.mark.parametrize("code", [*CODES, *OURS])
def test_a_body_coasts_once_its_pulse_has_ended(code: str, tmp_path: Path) -> None:
    w, adapter = 2.0 * math.pi * F, {**CODES, **OURS}[code]
    require(adapter)
    scene = shaken_block() if code in OURS else shaken()
    ask = Ask(scene, History(END, END / 20), (Displacement(0),), Knobs(1e-4, KN.get(code)))
    (run,) = adapter.run([ask], "default", tmp_path, 0.0)
    assert run.status is Status.RAN, run
    speed, went = A / w * (1.0 - math.cos(w * CUT)), A / w * (CUT - math.sin(w * CUT) / w)
    assert run.values[Displacement(0)][-1, 0] == pytest.approx(went + speed * (END - CUT), rel=2e-3)


@pytest.mark.parametrize("code", CODES)
def test_a_clump_overturns_at_the_threshold_but_for_its_round_corners(
    code: str, tmp_path: Path
) -> None:
    trial, adapter = CASE.declare("threshold", CASE.defaults("threshold")), CODES[code]
    require(adapter)
    assert isinstance(trial.study, Ladder)
    (run,) = adapter.run([trial.study.ask(Knobs(5e-5, 1e10))], "clump", tmp_path, 0.0)
    (seen,) = trial.quantities
    assert seen.observe(run) == pytest.approx(seen.reference, rel=2e-3)


@pytest.mark.parametrize("code", CODES)
def test_a_step_that_throws_a_clump_about_is_refused(code: str) -> None:
    trial = CASE.declare("threshold", CASE.defaults("threshold"))
    assert isinstance(trial.study, Ladder)
    reason = CODES[code].refuses(trial.study.ask(Knobs(2.5e-4, 1e10)), "clump")
    assert reason == "dt = 0.00025 s; the springs of its corners are stable up to 5.66e-05 s"

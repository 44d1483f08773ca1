"""Claims about the case of close-packed blocks: loads end at rest, wrong springs are detected."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from cases.bonds.close_packed_lattice import CASE, LEANS
from reference_solutions.bonds import lattice_directions
from vv.ask import Ask, Knobs, Method, Run, Status
from vv.case import Exact, Level, Scalar, Trial, evaluated
from vv.engines import dem
from vv.plan.plan import Options
from vv.plan.planning import make_plan
from vv.plan.project import find

TRIAL = CASE.declare("82", CASE.defaults("82"))


def ran(ask: Ask) -> Run:
    run = dem.solve_default(ask)
    assert run.status is Status.RAN, run.reason
    return run


def off(trial: Trial, run: Run) -> dict[str, float]:
    """The errors over their tolerances, by name of the quantity."""
    errors = {}
    for q in trial.quantities:
        if isinstance(q, Scalar) and isinstance(q.judge, Exact) and q.reference is not None:
            allowed = q.judge.tolerances[Method.SECOND_ORDER].value
            gap = abs(q.observe(run) - evaluated(q.reference))
            errors[q.name] = gap / evaluated(q.scale) / allowed
    return errors


@pytest.mark.parametrize("dt", [1e-7, 2.5e-8])
def test_no_step_counts_at_a_steady_rate(dt: float) -> None:
    assert max(off(TRIAL, ran(TRIAL.study.ask(Knobs(dt=dt)))).values()) < 0.3


@pytest.mark.parametrize("gamma", [0.0005, 0.03, 0.09, 0.3])
def test_modes_have_decayed_on_soft_shear_springs_too(gamma: float) -> None:
    """At so small a strain that bonds hardly rotate, what is left of them would show."""
    small = CASE.declare("82", {**CASE.defaults("82"), "gamma": gamma, "strain": 1e-9})
    for knobs in small.study.rungs[Level.QUICK]:
        assert max(off(small, ran(small.study.ask(knobs))).values()) < 0.7


def test_springs_that_are_wrong_by_a_ten_thousandth_are_seen() -> None:
    ask = TRIAL.study.ask(Knobs(dt=1e-7))
    bonds = ask.scene.bonds
    assert bonds is not None
    stiff = dataclasses.replace(bonds, kn=1.0001 * bonds.kn)
    for wrong in (stiff, dataclasses.replace(bonds, ks=1.001 * bonds.ks)):
        scene = dataclasses.replace(ask.scene, bonds=wrong)
        assert max(off(TRIAL, ran(dataclasses.replace(ask, scene=scene))).values()) > 5


def test_a_heavier_element_changes_nothing() -> None:
    heavy = CASE.declare("82", {**CASE.defaults("82"), "m": 4e-6})
    assert max(off(heavy, ran(heavy.study.ask(Knobs(dt=1e-7)))).values()) < 0.3


def test_the_costly_blocks_wait_for_the_level_paper() -> None:
    project = find(Path(__file__))
    shown = {
        level: {job.variant for job in make_plan(project, [CASE.name], Options(level)).jobs}
        for level in (Level.QUICK, Level.DEFAULT)
    }
    assert shown[Level.QUICK] == {"82"}
    assert shown[Level.DEFAULT] == {"82", "255", "580", "1105", "82-turning"}
    assert all(v.runs_at(Level.PAPER) for v in CASE.variants)


def test_blocks_are_cut_where_the_lattice_is_softest_of_all_leans() -> None:
    p = CASE.defaults("softest")
    springs = {"kn": p["kn"], "ks": p["gamma"] * p["kn"], "d": p["d"]}

    def modulus(degrees: float) -> float:
        lean = np.radians(degrees)
        return lattice_directions.modulus([np.sin(lean), 0.0, np.cos(lean)], **springs)

    leans = np.linspace(0.0, 90.0, 181)
    least = float(leans[np.argmin([modulus(lean) for lean in leans])])
    assert LEANS["softest"] == pytest.approx(least, abs=1.0)

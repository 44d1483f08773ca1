"""Claims about the energies of a block pulled in two: they balance, and errors are detected."""

from __future__ import annotations

import dataclasses
import functools
from pathlib import Path

import numpy as np
import pytest

from cases.bonds.close_packed_energy import CASE
from vv.ask import Knobs, Method, Run, Status
from vv.case import Exact, Level, Scalar, Trial, evaluated
from vv.engines import dem
from vv.plan.plan import Options
from vv.plan.planning import make_plan
from vv.plan.project import find
from vv.scene import Form

TRIAL = CASE.declare("pulled-82", CASE.defaults("pulled-82"))
Q = {q.name: q for q in TRIAL.quantities}
COARSE, FINE = Knobs(dt=8e-8), Knobs(dt=4e-8)


@functools.cache
def pulled(knobs: Knobs) -> Run:
    return ran(TRIAL, knobs)


def ran(trial: Trial, knobs: Knobs) -> Run:
    run = dem.solve_default(trial.study.ask(knobs))
    assert run.status is Status.RAN, run.reason
    return run


def observed(name: str, run: Run) -> float:
    scalar = Q[name]
    assert isinstance(scalar, Scalar)
    return scalar.observe(run)


def test_energy_balances_through_failure_to_second_order_in_the_step() -> None:
    judge = Q["balance"].judge
    assert isinstance(judge, Exact)
    coarse, fine = (observed("balance", pulled(knobs)) for knobs in (COARSE, FINE))
    assert 0 < fine < judge.tolerances[Method.SECOND_ORDER].at(FINE)
    assert np.log2(coarse / fine) == pytest.approx(2, abs=0.2)


@pytest.mark.parametrize("form", [Form.BROKEN_NORMAL, Form.BROKEN_SHEAR, Form.DRAG])
def test_heat_that_is_not_booked_is_seen(form: Form) -> None:
    run = pulled(FINE)
    lost = {**run.energies, form: 0.999 * run.energies[form]}
    judge = Q["balance"].judge
    assert isinstance(judge, Exact)
    allowed = judge.tolerances[Method.SECOND_ORDER].at(FINE)
    assert observed("balance", dataclasses.replace(run, energies=lost)) > 2 * allowed


def test_elastic_energy_is_that_of_the_static_lattice_and_sees_wrong_springs() -> None:
    half = Q["E_e(half)"]
    assert isinstance(half, Scalar)
    assert isinstance(half.judge, Exact)
    assert half.reference is not None
    bound = half.judge.tolerances[Method.SECOND_ORDER].value
    p = CASE.defaults("pulled-82")
    stiff = ran(CASE.declare("pulled-82", {**p, "kn": 1.001 * p["kn"]}), COARSE)
    exact = evaluated(half.reference)
    errors = [abs(half.observe(run) / exact - 1) for run in (pulled(COARSE), stiff)]
    assert errors[0] < bound < errors[1]


def test_a_block_in_two_has_turned_its_elastic_energy_into_heat() -> None:
    run = pulled(FINE)
    end = {form: series[-1] for form, series in run.energies.items()}
    assert end[Form.NORMAL] + end[Form.SHEAR] < 1e-4 * -end[Form.CARRYING]
    assert end[Form.DRAG] > end[Form.BROKEN_NORMAL] > end[Form.BROKEN_SHEAR] > 0
    assert 0.1 < observed("kinetic share", run) < 0.2
    assert 3e-7 < observed("crack time", run) < 2e-6


def test_what_never_breaks_has_no_crack() -> None:
    run = pulled(FINE)
    whole = dict.fromkeys((Form.BROKEN_NORMAL, Form.BROKEN_SHEAR), np.zeros(len(run.times)))
    assert np.isnan(
        observed("crack time", dataclasses.replace(run, energies={**run.energies, **whole}))
    )


def test_the_costly_blocks_wait_for_the_level_paper() -> None:
    jobs = make_plan(find(Path(__file__)), [CASE.name], Options(Level.DEFAULT)).jobs
    assert {job.variant for job in jobs} == {"pulled-82", "pressed-82"}


def test_where_broken_bonds_rub_the_balance_is_judged_until_then_and_to_the_end() -> None:
    given = {"kn": 1.62e7, "ks": 8.88e6}
    rubbed = CASE.declare("pulled-82", {**CASE.defaults("pulled-82"), **given})
    until, to_the_end = (q for q in rubbed.quantities if q.name.startswith("balance"))
    assert isinstance(until, Scalar)
    assert isinstance(to_the_end, Scalar)
    assert isinstance(until.judge, Exact)
    bound = until.judge.tolerances[Method.SECOND_ORDER].at(COARSE)
    run = ran(rubbed, COARSE)
    assert until.observe(run) < 0.1 * bound < bound < to_the_end.observe(run)
    whole = pulled(COARSE)  # nothing is touched again
    assert observed("balance", whole) == observed("balance of all", whole)

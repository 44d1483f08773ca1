"""Claims about the allowed errors of two spheres that bounce on each other, for any parameters."""

from __future__ import annotations

import pytest

from vv.ask import Method
from vv.case import Level
from vv.engines import dem
from vv.plan.project import find
from vv.records.outcomes import Verdict
from vv.records.record import measured

CASE = find().load_case("bounce")


@pytest.mark.parametrize(
    "given",
    [
        {"w1": -1.0},
        {"load": 55.0, "v_n": 0.012, "w1": 1.7, "w2": -1.3, "mu": 0.7},
        {"r2": 0.11, "kn": 1.5e7, "ks": 3e6, "v_t": 0.09, "mu": 0.15},
    ],
)
def test_a_leapfrog_is_as_close_as_the_ends_of_contacts_within_steps_allow(
    given: dict[str, float],
) -> None:
    trial = CASE.declare("again", {**CASE.defaults("again"), **given})
    for knobs in trial.study.rungs[Level.QUICK]:
        run = dem.solve_default(trial.study.ask(knobs))
        for quantity in trial.quantities:
            found, _ = measured(run, quantity, Method.SECOND_ORDER, knobs)
            assert found.verdict is Verdict.PASS, (knobs, found.name, found.error, found.tolerance)

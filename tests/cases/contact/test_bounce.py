"""Claims about the allowed errors of two spheres that bounce on each other, for any parameters."""

from __future__ import annotations

import pytest

from reference_solutions.contact import bouncing_pair
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


def stages(**given: float) -> tuple[bouncing_pair.Stage, ...]:
    law = {**CASE.defaults("pair"), **given}
    return bouncing_pair.pair_stages(0.036, **{k: v for k, v in law.items() if k != "g"})


@pytest.mark.parametrize("given", [{"r1": 1e-6}, {"r2": 1e-6}, {"ks": 4e12}])
def test_a_contact_that_takes_too_many_evaluations_is_refused(given: dict[str, float]) -> None:
    with pytest.raises(ValueError, match="evaluations of the rates in a contact; at most"):
        stages(**given)


def test_a_contact_soon_after_the_start_is_found() -> None:
    gap = 1e-9  # which is crossed in a four-hundredth of the first part that is searched
    assert stages(gap=gap)[1].begin == pytest.approx(gap / CASE.defaults("pair")["v_n"], rel=1e-6)


def test_more_bounces_than_are_solved_are_refused() -> None:
    with pytest.raises(ValueError, match=r"load = 26.0 N; more than 100 stages by 0.036 s"):
        stages(r1=1e-3, load=26.0)

"""Claims that the loaded unit is at rest when it is measured, for any kind of damping."""

from __future__ import annotations

import pytest

from cases.bonds import tetrahedral_unit
from cases.bonds.parts import _detour
from vv.ask import Method
from vv.case import Level, Scalar, evaluated
from vv.engines import dem
from vv.plan.project import find
from vv.records.outcomes import Verdict
from vv.records.record import measured

CASE = find().load_case("tetrahedral-unit")


@pytest.mark.parametrize("given", [{"m": 1e-3}, {"kn": 1e6}, {"eta": 0.2}, {"eta": 100.0}])
def test_mass_stiffness_and_viscosity_do_not_enter_the_state_of_rest(
    given: dict[str, float],
) -> None:
    trial = CASE.declare("pulled", {**CASE.defaults("pulled"), **given})
    run = dem.solve_default(trial.study.ask(trial.study.rungs[Level.QUICK][0]))
    (modulus,) = (q for q in trial.quantities if isinstance(q, Scalar) and q.name == "E")
    assert modulus.reference is not None
    assert modulus.observe(run) == pytest.approx(evaluated(modulus.reference), rel=2e-7)


@pytest.mark.parametrize("given", [{"m": 1e-3}, {"gamma": 0.5, "m": 3e-4, "eta": 4.0}, {}])
def test_what_a_spring_keeps_of_the_way_to_rest_is_the_error_and_within_its_tolerance(
    given: dict[str, float],
) -> None:
    p = {**CASE.defaults("pulled"), **given}
    trial, ks = CASE.declare("pulled", p), p["gamma"] * p["kn"]
    knobs = trial.study.rungs[Level.QUICK][0]
    run = dem.solve_default(trial.study.ask(knobs))
    off = _detour.rest_errors(p, ks, tetrahedral_unit._force(p, ks), trial.study.ask(knobs).dt)
    for quantity in trial.quantities[: len(off)]:
        found, _ = measured(run, quantity, Method.SECOND_ORDER, knobs)
        assert found.verdict is Verdict.PASS
        assert found.error == pytest.approx(off[quantity.name].kept, rel=0.05)


@pytest.mark.parametrize("variant", ["pulled", "gamma-0", "gamma-1-pressed", "turning"])
def test_the_parameters_of_the_case_keep_their_durations(variant: str) -> None:
    study = CASE.declare(variant, CASE.defaults(variant)).study
    assert study.goal.duration == (2.4e-4 if variant == "turning" else 6e-5)


def test_a_unit_that_nothing_brings_to_rest_is_refused() -> None:
    with pytest.raises(ValueError, match=r"eta = 0\.0 N s/m; it must be positive"):
        CASE.declare("pulled", {**CASE.defaults("pulled"), "eta": 0.0})


@pytest.mark.parametrize("given", [{"kn": 1e4}, {"eta": 600.0}])
def test_a_unit_that_rounding_of_places_stops_on_its_way_to_rest_is_refused(
    given: dict[str, float],
) -> None:
    with pytest.raises(ValueError, match="rounding of positions in each step stops it"):
        CASE.declare("pulled", {**CASE.defaults("pulled"), **given})

"""Claims about schemes whose positions are of second order where slip keeps its line."""

import dataclasses
import math

import pytest

from tests.findings.figures import PROJECT
from vv.ask import Knobs, Method, Run
from vv.case import Exact, Level, Trial
from vv.engines import dda
from vv.engines.dda.formulation import BORNE, Formulation
from vv.records.outcomes import Verdict
from vv.records.record import measured

LATE = dataclasses.replace(BORNE, shaking_at=0.5)  # drives half a step after they act
SHAKEN = ("incline:newmark-35", "incline:two-way", "incline:newmark-3d", "at-yield:above")


def trial(name: str) -> Trial:
    case, _, variant = name.partition(":")
    declared = PROJECT.load_case(case)
    return declared.declare(variant, declared.defaults(variant))


def verdicts(one: Trial, formulation: Formulation, method: Method) -> set[Verdict]:
    """Of the positions, at the settings of the quick level."""
    found = set()
    for knobs in one.study.rungs[Level.QUICK]:
        run: Run = dda.solve(one.study.ask(knobs), formulation)
        for quantity in one.quantities:
            if isinstance(quantity.judge, Exact) and Method.STRAIGHT in quantity.judge.tolerances:
                found.add(measured(run, quantity, method, knobs)[0].verdict)
    return found


@pytest.mark.parametrize("name", SHAKEN)
def test_half_a_step_late_is_seen_of_a_code_whose_positions_are_of_second_order(name: str) -> None:
    """As a code of first order at all, it would pass."""
    one = trial(name)
    assert verdicts(one, BORNE, Method.STRAIGHT) == {Verdict.PASS}
    assert Verdict.FAIL in verdicts(one, LATE, Method.STRAIGHT)
    assert verdicts(one, LATE, Method.FIRST_ORDER) == {Verdict.PASS}


@pytest.mark.parametrize("name", ["incline:two-directions", "responding-block:3d"])
def test_where_slip_turns_such_a_code_is_of_first_order(name: str) -> None:
    along = trial(name).quantities[0].judge
    assert isinstance(along, Exact)
    assert along.tolerance(Method.STRAIGHT) is along.tolerance(Method.FIRST_ORDER)


@pytest.mark.parametrize(("variant", "ratio"), [("1d", 0.1864), ("1d-1m", 0.1491)])
def test_what_reverses_within_a_step_is_allowed_a_part_of_a_step_s_angle_of_what_waits_for_its_end(
    variant: str, ratio: float
) -> None:
    """2 r/(a + r) of it, r = mu g/(D w^2), a^2 = 1 - (pi r/2)^2 of the base as slip reverses."""
    along = trial(f"responding-block:{variant}").quantities[0].judge
    omega = 2 * math.pi * PROJECT.load_case("responding-block").defaults(variant)["f"]
    angle = omega * 2 * ratio / (math.sqrt(1 - (math.pi * ratio / 2) ** 2) + ratio)
    assert isinstance(along, Exact)
    for dt in (1e-3, 1e-4):
        within, whole = (
            along.tolerance(method).at(Knobs(dt))
            for method in (Method.STRAIGHT, Method.FIRST_ORDER)
        )
        assert within == pytest.approx(angle * dt * whole, rel=1e-3)

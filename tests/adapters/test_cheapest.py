"""Claims about what errors cost: `exact` is cheapest, but for coarse answers to endless turning."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.installed import require
from vv.ask import Knobs, Run, Status
from vv.case import Ladder, Norm, Trial
from vv.codes import Scheme
from vv.plan.project import find
from vv.records.record import measured
from vv.run.search import answers

PROJECT = find(Path(__file__))
STRAIGHT = (
    *(f"single-contact:T{test}" for test in (1, 2, 3, 4)),
    "incline:newmark-30",
    "responding-block:1d",
)
TURNING = ("responding-block:2d", "responding-block:3d")
VISITS = 3  # of which the least counts: another process may have had the core


def declared(name: str) -> tuple[Trial, Ladder]:
    case, _, variant = name.partition(":")
    trial = (found := PROJECT.load_case(case)).declare(variant, found.defaults(variant))
    assert isinstance(trial.study, Ladder)
    return trial, trial.study


def timed(name: str, scheme: str, knobs: Knobs, scratch: Path) -> tuple[Run, Scheme, float]:
    """An answer, and the least CPU time [s] of its stepping loop."""
    code, _, which = scheme.partition("/")
    adapter, (_, study) = PROJECT.load_adapter(code), declared(name)
    require(adapter)
    own = next(one for one in adapter.schemes if one.name == which)
    asks = [study.ask(knobs)] * VISITS
    runs = list(answers(adapter, asks, which, scratch, 0.01))
    assert all(run.status is Status.RAN for run in runs)
    return runs[0], own, min(run.cost.solve_cpu for run in runs)


@pytest.mark.parametrize("scheme", ["dem/default", "liggghts/default", "yade/default"])
@pytest.mark.parametrize("name", STRAIGHT)
def test_an_exact_answer_costs_less_than_the_coarsest_steps(
    name: str, scheme: str, tmp_path: Path
) -> None:
    _, study = declared(name)
    *_, exact = timed(name, "exact/default", Knobs(), tmp_path)
    *_, steps = timed(name, scheme, study.timed[0], tmp_path)
    assert exact < steps


@pytest.mark.parametrize("scheme", ["dem/default", "dda/default"])
@pytest.mark.parametrize("name", ["incline:two-directions", *TURNING])
def test_where_slip_turns_it_costs_less_than_errors_of_1e_3(
    name: str, scheme: str, tmp_path: Path
) -> None:
    """And less than any in two directions on a slope, where slip stops now and then."""
    trial, study = declared(name)
    *_, exact = timed(name, "exact/default", Knobs(), tmp_path)
    wanted = next(one for one in trial.quantities if one.name == "distance")
    for knobs in study.timed:
        run, own, cost = timed(name, scheme, knobs, tmp_path)
        method = own.method_for(trial.study.scene.terms())
        error = measured(run, wanted, method, knobs)[0].errors[Norm.MAX]
        assert error is not None
        assert exact < cost or (error > 1e-3 and name in TURNING)

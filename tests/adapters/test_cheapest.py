"""Claims about what errors cost: `exact` costs less than the coarsest steps of any code."""

from __future__ import annotations

import itertools
from pathlib import Path

import pytest

from tests.support.installed import require
from vv.ask import Knobs, Status
from vv.case import Ladder
from vv.plan.project import find
from vv.run.search import answers

PROJECT = find(Path(__file__))
STRAIGHT = (
    *(f"single-contact:T{test}" for test in (1, 2, 3, 4)),
    "incline:newmark-30",
    "responding-block:1d",
)
TURNING = ("incline:two-directions", "responding-block:2d", "responding-block:3d")
STEPPING = ("dem/default", "liggghts/default", "yade/default")
VISITS = 3  # of which the least counts: another process may have had the core


def declared(name: str) -> Ladder:
    """The settings of a variant, the coarsest first among those that are timed."""
    case, _, variant = name.partition(":")
    found = PROJECT.load_case(case)
    study = found.declare(variant, found.defaults(variant)).study
    assert isinstance(study, Ladder)
    return study


def cost(name: str, scheme: str, knobs: Knobs, scratch: Path) -> float:
    """The least CPU time [s] of a scheme's stepping loop."""
    code, _, which = scheme.partition("/")
    adapter = PROJECT.load_adapter(code)
    require(adapter)
    asks = [declared(name).ask(knobs)] * VISITS
    runs = list(answers(adapter, asks, which, scratch, 0.01))
    assert all(run.status is Status.RAN for run in runs)
    return min(run.cost.solve_cpu for run in runs)


@pytest.mark.parametrize(
    ("name", "scheme"),
    [
        *itertools.product(STRAIGHT, STEPPING),
        *itertools.product(TURNING, (*STEPPING, "dda/default", "rigid/default")),
    ],
)
def test_an_exact_answer_costs_less_than_the_coarsest_steps(
    name: str, scheme: str, tmp_path: Path
) -> None:
    """Also where slip turns all the time, on a base that shakes in two and three directions."""
    exact = cost(name, "exact/default", Knobs(), tmp_path)
    assert exact < cost(name, scheme, declared(name).timed[0], tmp_path)

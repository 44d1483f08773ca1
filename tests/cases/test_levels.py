"""Claims about the settings of each level: they show the order in the step and the stiffness."""

from __future__ import annotations

from pathlib import Path

import pytest

from cases._penalty import RUNGS, levels
from vv.ask import Knobs
from vv.case import Case, Exact, Judge, Ladder, Level
from vv.plan.project import find

PROJECT = find(Path(__file__))
DEFAULTS = [
    (case, variant.name)
    for case in map(PROJECT.load_case, PROJECT.case_names())
    for variant in case.variants
    if variant.runs_at(Level.DEFAULT)
]


def claims_order(judge: Judge) -> bool:
    """Whether a tolerance decreases with the step."""
    return isinstance(judge, Exact) and any(one.order for one in judge.tolerances.values())


def test_springs_for_rigid_contact_have_two_steps_and_another_stiffness_by_default() -> None:
    stiffer = Knobs(2.5e-4, 1e9)
    found = levels(stiffer)
    assert found[Level.DEFAULT] == (*RUNGS[:2], stiffer)
    assert {rung.kn for rung in RUNGS[:2]} == {RUNGS[0].kn}
    assert len({rung.dt for rung in found[Level.DEFAULT]}) == 3
    for kn in {rung.kn for rung in RUNGS}:
        assert len([rung for rung in found[Level.PAPER] if rung.kn == kn]) >= 3


@pytest.mark.parametrize(("case", "variant"), DEFAULTS, ids=lambda x: getattr(x, "name", x))
def test_where_an_order_is_claimed_the_default_level_has_two_of_the_steps(
    case: Case, variant: str
) -> None:
    """This applies to scenes computed at several steps; settings of a publication are single."""
    trial = case.declare(variant, case.defaults(variant))
    steps = {level: {one.dt for one in rungs} for level, rungs in trial.study.rungs.items()}
    ordered = any(claims_order(one.judge) for one in trial.quantities)
    ladder = isinstance(trial.study, Ladder) and not trial.study.search
    assert not (ordered and ladder) or len(steps[Level.DEFAULT]) >= min(2, len(steps[Level.PAPER]))

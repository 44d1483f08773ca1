"""Claims that every case runs with a parameter of zero, or refuses it by name."""

from __future__ import annotations

import re

import numpy as np
import pytest

from vv.ask import History
from vv.base.errors import UsageError
from vv.case import Case, Series, Trial, evaluated
from vv.plan.planning import declare_trial
from vv.plan.project import find
from vv.plan.selection import select

SLOW = "close-packed-"  # blocks of bonds, whose equilibrium takes an iteration for each parameter
VARIANTS = [
    (case, variant) for case, variant in select(find(), ["*"]) if not case.name.startswith(SLOW)
]


def answered(case: Case, variant: str, parameters: dict[str, float]) -> Trial | str:
    """The trial, or the reason of its refusal."""
    try:
        return declare_trial(case, variant, parameters)
    except UsageError as refused:
        return str(refused)


def zero_without_scale(trial: Trial) -> list[str]:
    """The quantities whose exact history is zero throughout and that state no scale."""
    goal = trial.study.goal
    if not isinstance(goal, History):
        return []
    series = [q for q in trial.quantities if isinstance(q, Series) and q.reference is not None]
    times = goal.times(None)
    return [
        q.name for q in series
        if q.reference and q.still is None and not (q.scale and evaluated(q.scale))
        and not np.any(q.reference(times))
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("case", "variant"), VARIANTS, ids=[f"{case.name}:{variant}" for case, variant in VARIANTS]
)
def test_a_parameter_of_zero_is_answered_or_refused_by_name(case: Case, variant: str) -> None:
    usual = case.defaults(variant)
    for name in [name for name, value in usual.items() if value]:
        answer = answered(case, variant, {**usual, name: 0.0})
        if isinstance(answer, Trial):
            assert answer.quantities, name
            assert zero_without_scale(answer) == [], name
        else:
            assert re.search(rf"\b{re.escape(name)} = ", answer)
            assert "division" not in answer

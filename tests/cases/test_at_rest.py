"""Claims about parameters that keep bodies at rest: zero displacement passes, creep fails.

A reference of zeros, or of their rounding, gives no scale for errors; a case states a physical one.
"""

from __future__ import annotations

import numpy as np
import pytest

from vv.ask import Displacement, Knobs, Method, Observable, Run, Status
from vv.case import Quantity, Series, Trial
from vv.plan.project import find
from vv.records.record import measured
from vv.scene import Vector

HELD = [
    ("incline", "gravity-10", {"alpha": 20.0, "phi": 25.0}, 0),
    ("responding-block", "1d", {"mu": 0.0}, 1),
    ("responding-block", "2d", {"mu": 0.0}, 1),
    ("wedge", "xi-1", {"dip": 0.0}, 2),
    ("wedge", "sphere", {"dip": 0.0}, 2),
]


def trial_of(case: str, variant: str, given: dict[str, float]) -> Trial:
    made = find().load_case(case)
    return made.declare(variant, {**made.defaults(variant), **given})


def verdict(trial: Trial, quantity: Quantity, body: int, moved: float) -> str:
    times = trial.study.goal.times(None)
    path = np.full((len(times), 3), moved)
    path[0] = 0.0
    run = Run(Status.RAN, times=times, values={Displacement(body): path})
    return measured(run, quantity, Method.SECOND_ORDER, Knobs(dt=1e-3))[0].verdict.value


@pytest.mark.parametrize(("case", "variant", "given", "body"), HELD)
def test_what_is_held_is_judged_by_a_physical_scale(
    case: str, variant: str, given: dict[str, float], body: int
) -> None:
    trial = trial_of(case, variant, given)
    for quantity in trial.quantities:
        assert verdict(trial, quantity, body, 0.0) == "pass", quantity.name
        assert verdict(trial, quantity, body, 1.0) == "fail", quantity.name


@pytest.mark.parametrize(("case", "variant", "given", "body"), HELD)
def test_what_moves_is_judged_by_its_way(
    case: str, variant: str, given: dict[str, float], body: int
) -> None:
    trial = trial_of(case, variant, {})
    for quantity in trial.quantities:
        if isinstance(quantity, Series) and quantity.reference is not None:
            times = trial.study.goal.times(None)
            way = np.abs(quantity.reference(times)).max()
            moved: dict[Observable, Vector] = {Displacement(body): np.zeros((len(times), 3))}
            run = Run(Status.RAN, times=times, values=moved)
            found, _ = measured(run, quantity, Method.SECOND_ORDER, Knobs(dt=1e-3))
            assert found.scale is not None
            assert found.scale == pytest.approx(way) or quantity.scale is not None
            assert found.verdict.value == "fail"

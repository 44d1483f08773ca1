"""Claims about what a point mass does in the rest of a step in which its slip ended, by script."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.engines.rigid.by_hand.point.test_point_events import PULL, RIGHT, SPAN, ground
from vv.engines.rigid.limits import NEARLY
from vv.engines.rigid.point import kernel
from vv.engines.rigid.point.trial import Touch
from vv.scene import Vector

pytestmark = pytest.mark.usefixtures("in_python")


@pytest.mark.parametrize(("part", "slips"), [(0.98, False), (1.02, True)])
@pytest.mark.parametrize("slow", [1.0, 1e-3])
def test_what_is_left_of_a_slip_that_ended_goes_on_unless_it_is_nearly_nothing(
    monkeypatch: pytest.MonkeyPatch, part: float, slips: bool, slow: float
) -> None:
    """The slip ends halfway in a step, with a velocity across it; its direction is told then."""
    left = (0.0, part * NEARLY * slow * PULL * SPAN, 0.0)
    directions, ends = list[Any](), iter([True, False])

    def trial(made: Any, x: Any, v: Any, now: float, span: float, d: Any) -> Touch:
        directions.append(tuple(d))
        return Touch(left, 1.0, (0.0, 0.0, 0.0))

    monkeypatch.setattr(kernel, "trial_step", trial)
    monkeypatch.setattr(kernel, "resolved_part", lambda g, x, v, now, whole, *_: whole)
    monkeypatch.setattr(kernel, "slip_ended", lambda *_: next(ends))
    monkeypatch.setattr(kernel, "time_to_event", lambda *_: 0.5 * SPAN)
    path, energy, report, reaction = (np.zeros((2, k)) for k in (6, 8, 4, 3))
    acted: Vector = reaction[:, None]
    made = ground(pull=slow * PULL, fine=1e-15)
    assert kernel.move_point(path, energy, report, acted, 1, SPAN, RIGHT, made) == 2
    assert directions[:3] == [RIGHT, RIGHT, (0.0, 1.0 * slips, 0.0)]

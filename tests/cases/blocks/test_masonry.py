"""Claims about the case of masonry: how far a wall that turns about often may be off."""

from __future__ import annotations

import pytest

from cases.blocks.masonry import CASE
from vv.ask import Method
from vv.case import Exact, Series


def late(given: dict[str, float]) -> tuple[float, float]:
    """What a step adds to the bound of springs [1/s], and the bound where steps are not cut."""
    p = {**CASE.defaults("slides"), **given}
    (lowest, _) = CASE.declare("slides", p).quantities
    assert isinstance(lowest, Series)
    assert isinstance(lowest.judge, Exact)
    penalty, cut = (lowest.judge.tolerance(m) for m in (Method.PENALTY, Method.SECOND_ORDER))
    return penalty.late, cut.value


def test_bounds_grow_with_how_often_slip_turns_about_over_the_way() -> None:
    """By mu g f T^2 over twenty times D, where that is more than one."""
    assert late({}) == pytest.approx((10.0, 2e-2))  # 0.2 9.81 2 0.5^2 over 1 is 0.981
    assert late({"D": 0.05 * 0.981 / 3.0}) == pytest.approx((30.0, 6e-2))

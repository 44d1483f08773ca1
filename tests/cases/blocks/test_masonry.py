"""Claims about the case of masonry: the bounds of walls whose slip reverses often."""

from __future__ import annotations

import pytest

from cases.blocks.masonry import CASE
from vv.ask import Method
from vv.case import Exact, Series


def late(given: dict[str, float]) -> tuple[float, float]:
    """The bound of springs per step [1/s], and the bound of schemes that do not divide steps."""
    p = {**CASE.defaults("slides"), **given}
    (lowest, _) = CASE.declare("slides", p).quantities
    assert isinstance(lowest, Series)
    assert isinstance(lowest.judge, Exact)
    penalty, cut = (lowest.judge.tolerance(m) for m in (Method.PENALTY, Method.SECOND_ORDER))
    return penalty.late, cut.value


def test_bounds_grow_with_how_often_slip_turns_about_over_the_way() -> None:
    """They grow as mu g f T^2 over twenty times D, where that is more than one."""
    assert late({}) == pytest.approx((10.0, 2e-2))  # 0.2 9.81 2 0.5^2 over 1 is 0.981
    assert late({"D": 0.05 * 0.981 / 3.0}) == pytest.approx((30.0, 6e-2))

"""Claims about the case of a loaded block: its bounds follow the drives."""

from __future__ import annotations

import numpy as np
import pytest

from cases.blocks.laden_block import CASE
from vv.ask import Method
from vv.case import Exact, Series
from vv.scene import Vector


def bounds(given: dict[str, float]) -> tuple[Vector, float]:
    """The bounds of slip and rise for springs, and the largest displacement [m]."""
    p = {**CASE.defaults("level"), **given}
    quantities = {q.name: q for q in CASE.declare("level", p).quantities}
    slip, rise = quantities["slip"], quantities["rise"]
    assert isinstance(slip, Series)
    assert isinstance(slip.judge, Exact)
    assert isinstance(rise.judge, Exact)
    assert slip.reference is not None
    way = np.asarray(slip.reference(np.linspace(0.0, p["duration"], 1000)))
    one, other = (judge.tolerance(Method.PENALTY) for judge in (slip.judge, rise.judge))
    assert max(one.floor / one.value, other.floor / other.value) < 1.0  # they vary with the setting
    return np.array([one.value, other.value]), float(np.abs(way).max())


@pytest.mark.parametrize(
    ("given", "times"),
    [
        ({"D": 0.04}, 2.0), ({"a": 3.0}, 2.0), ({"mu": 0.6}, 2.189),
        ({"mu": 0.6, "D": 0.04}, 4.0), ({"mu": 0.6, "a": 4.5}, 6.0), ({"press": 1.0}, 1.0),
    ],
    ids=str,
)  # fmt: skip
def test_a_bound_grows_with_the_largest_drive_and_as_the_way_shrinks(
    given: dict[str, float], times: float
) -> None:
    """Friction rises with the slope and varies by mu times these; it decelerates by mu p - push."""
    own, way = bounds({"v": 6.0})
    other, moved = bounds({"v": 6.0, **given})
    assert other * moved == pytest.approx(times * own * way, rel=0.01)

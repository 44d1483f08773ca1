"""Claims about the case of a loaded block: its bounds follow the drives."""

from __future__ import annotations

import numpy as np
import pytest

from cases.blocks.laden_block import CASE
from vv.ask import Method
from vv.case import Exact, Series
from vv.scene import Vector


def bounds(given: dict[str, float], variant: str = "level") -> tuple[Vector, float]:
    """The bounds of slip and rise for springs, and the largest displacement [m]."""
    p = {**CASE.defaults(variant), **given}
    quantities = {q.name: q for q in CASE.declare(variant, p).quantities}
    slip, rise = quantities["slip"], quantities["rise"]
    assert isinstance(slip, Series)
    assert isinstance(slip.judge, Exact)
    assert isinstance(rise.judge, Exact)
    assert slip.reference is not None
    way = np.asarray(slip.reference(np.linspace(0.0, p["duration"], 1000)))
    one, other = (judge.tolerance(Method.PENALTY) for judge in (slip.judge, rise.judge))
    return np.array([one.value, other.value]), float(np.abs(way).max())


@pytest.mark.parametrize(
    ("given", "times"),
    [
        ({"a": 3.0, "D": 0.04}, (2.0, 2.0)),
        ({"a": 4.5, "D": 0.06, "mu": 0.15}, (1.5, 3.0)),
        ({"mu": 0.6}, (2.0, 1.0)),
        ({"press": 1.0}, (1.0, 1.0)),
    ],
    ids=str,
)
def test_bounds_grow_with_the_drives_and_those_of_the_slip_with_friction(
    given: dict[str, float], times: tuple[float, float]
) -> None:
    """By hand: springs sink in proportion to the pressure's change, and mu of that is friction."""
    own, way = bounds({"v": 6.0})
    other, moved = bounds({"v": 6.0, **given})
    assert other * moved == pytest.approx(np.array(times) * own * way, rel=0.05)


def test_a_block_of_a_fifth_of_the_mass_sinks_a_fifth() -> None:
    """The plate that can rotate is as much thinner, and stands on the same springs."""
    (_, cube), _ = bounds({})
    (_, plate), _ = bounds({}, "turning")
    assert plate == pytest.approx(cube / 5, rel=0.05)

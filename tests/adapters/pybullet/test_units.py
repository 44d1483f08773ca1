"""Claims about the unit of length of a plan for PyBullet."""

from __future__ import annotations

import dataclasses

import pytest

import adapters.pybullet
from cases.blocks.responding_block import CASE
from tests.scenes.other_worlds import rescaled
from vv.ask import Ask, Knobs
from vv.case import Ladder


def asked(length: float = 1.0) -> Ask:
    """A plate on a base that moves, in a world whose lengths are so many times as large."""
    trial = CASE.declare("3d-turning", CASE.defaults("3d-turning"))
    assert isinstance(trial.study, Ladder)
    ask = trial.study.ask(Knobs(1e-3))
    return dataclasses.replace(ask, scene=rescaled(ask.scene, length, 1.0, 1.0))


@pytest.mark.shows("PyBullet's limits of distance are fixed numbers, so that it gets lengths")
@pytest.mark.parametrize("power", [-20, -1, 1, 10])
def test_a_larger_world_differs_in_the_unit_alone(power: int) -> None:
    plan = adapters.pybullet._plan(asked())
    larger = adapters.pybullet._plan(asked(2.0**power))
    assert larger.pop("unit") == 2.0**power * plan.pop("unit")
    assert larger == plan


def test_blocks_of_a_metre_are_in_metres() -> None:
    plan = adapters.pybullet._plan(asked())
    unit = plan["unit"]
    assert 2**-0.5 < plan["size"] < 2**0.5
    assert adapters.pybullet._plan(asked(1.0 / (unit * plan["size"])))["unit"] == 1.0

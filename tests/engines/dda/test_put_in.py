"""Claims about the energy put into a run: it includes the work of all prescribed motions."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from tests.scenes.blocks.dda_scenes import DOWN, FLOOR, asked, box, general, moved, run
from vv.engines.dda import DEFAULT
from vv.scene import Contact, Harmonic, Scene, Wall

X = np.array([1.0, 0.0, 0.0])
CUBE = box((0.5, 0.5, 0.5), 2000.0)
HEAVY = CUBE.mass * 9.81
SMOOTH, ROUGH = Contact(math.inf, mu=0.0), Contact(math.inf, mu=0.6)
SWAY = Harmonic(0.5 * X, np.ones(3))
ALONE = {
    "gravity": Scene((FLOOR, CUBE), SMOOTH, gravity=DOWN + 3.0 * X),
    "a load": Scene((FLOOR, dataclasses.replace(CUBE, load=3e3 * X)), SMOOTH, gravity=DOWN),
    "shaking": Scene((FLOOR, CUBE), SMOOTH, gravity=DOWN, shaking=SWAY),
    "a moving wall": Scene(
        (Wall(np.zeros(3), np.array([0.0, 0.0, 1.0]), SWAY), CUBE), ROUGH, gravity=DOWN
    ),
}


@pytest.mark.parametrize("solver", [run, general], ids=("one block", "many"))
@pytest.mark.parametrize("drive", ALONE)
def test_a_block_at_rest_may_be_set_going_by_one_drive_alone(drive: str, solver: object) -> None:
    assert callable(solver)
    way = moved(solver(asked(ALONE[drive], 1e-3, 1e9, 0.2), DEFAULT))
    assert np.abs(way[-1]).max() > 1e-3

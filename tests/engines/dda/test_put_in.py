"""Claims about the energy put into a run: it includes the work of all prescribed motions."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from tests.scenes.blocks.dda_scenes import (
    ALL,
    DOWN,
    FLOOR,
    NONE,
    asked,
    box,
    general,
    moved,
    run,
)
from vv.engines.dda import BORNE, DEFAULT, Formulation
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


@pytest.mark.parametrize("way", [DEFAULT, BORNE], ids=("default", "augmented-lagrangian"))
@pytest.mark.parametrize("turns", [False, True])
def test_a_block_that_nothing_moves_stays_and_has_not_diverged(
    turns: bool, way: Formulation
) -> None:
    """Corners on an oblique wall are rounded, so that its springs push, with no energy put in.

    They throw it off at gap sqrt(4 kn/m) at most.
    """
    up = np.array([0.36, 0.48, 0.8])
    axes = np.array([[0.48, 0.64, -0.6], [-0.8, 0.6, 0.0], up])
    place = np.array([0.1, 0.7, -0.3])
    block = box((0.5, 0.3, 0.2), 2000.0, place + 0.2 * up, axes, free_spin=ALL if turns else NONE)
    scene = Scene((Wall(place, up), block), ROUGH)
    ask = asked(scene, 2.5e-3, 1e8, 0.2)
    speed = np.finfo(float).eps * math.sqrt(4 * 1e8 / block.mass)
    assert np.abs(moved(run(ask, way))).max() <= speed * 0.2

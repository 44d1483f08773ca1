"""Claims about boxes that stand for walls: their upper face is the wall, wherever blocks go."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from cases.blocks.incline import CASE as INCLINE
from cases.blocks.responding_block import CASE as RESPONDING
from cases.hard.wedge import CASE as WEDGE
from vv.ask import Ask, Knobs
from vv.case import Case, Ladder, Series
from vv.scene import Harmonic, Wall
from vv.standins.boxed import boxed, why_no_boxes

SCENES = {"slope": (INCLINE, "two-way"), "groove": (WEDGE, "xi-1"), "base": (RESPONDING, "3d")}


def asked(case: Case, variant: str) -> Ask:
    study = case.declare(variant, case.defaults(variant)).study
    assert isinstance(study, Ladder)
    return study.ask(Knobs(1e-2))


@pytest.mark.parametrize("name", SCENES)
def test_the_upper_face_of_a_box_lies_in_its_wall(name: str) -> None:
    ask = asked(*SCENES[name])
    axes = ask.scene.axes
    for made, wall in zip(boxed(ask)["walls"], ask.scene.walls, strict=True):
        corners = np.array(made["centre"]) + np.array(made["vertices"])
        height = (corners @ axes - wall.point) @ wall.normal
        size = np.abs(corners).max()
        assert height.max() == pytest.approx(0.0, abs=1e-12 * size)
        assert (np.abs(height) < 1e-9 * size).sum() == 4


def test_a_block_shaken_for_long_stays_on_its_box() -> None:
    ask = asked(*SCENES["slope"])
    (wall,) = boxed(ask)["walls"]
    (exact,) = INCLINE.declare("two-way", INCLINE.defaults("two-way")).quantities
    assert isinstance(exact, Series)
    assert exact.reference is not None
    assert np.abs(exact.reference(np.array([5.0]))).max() < wall["half"][0]


def test_motion_and_forces_are_told_in_the_frame_of_the_scene_s_axes() -> None:
    ask = asked(*SCENES["slope"])
    plan = boxed(ask)
    assert np.array(plan["gravity"]) == pytest.approx(ask.scene.axes @ ask.scene.gravity)
    ((amplitude, omega, phase),) = plan["shaking"]
    assert np.linalg.norm(amplitude) == pytest.approx(20.0)
    assert (omega, phase) == (2 * np.pi, 0.0)
    assert plan["steps"] == 500


def test_two_walls_that_move_are_refused() -> None:
    ask = asked(*SCENES["groove"])
    sine = Harmonic(np.array([0.1, 0.0, 0.0]), np.ones(3))
    moving = tuple(
        dataclasses.replace(one, motion=sine) if isinstance(one, Wall) else one
        for one in ask.scene.bodies
    )
    scene = dataclasses.replace(ask.scene, bodies=moving)
    reason = why_no_boxes(dataclasses.replace(ask, scene=scene))
    assert reason == "2 walls move; one is what it is given"

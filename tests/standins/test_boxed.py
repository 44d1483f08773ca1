"""Claims about boxes that represent walls: their upper face is the wall, wherever blocks move."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from cases.blocks.incline import CASE as INCLINE
from cases.blocks.responding_block import CASE as RESPONDING
from cases.hard.wedge import CASE as WEDGE
from tests.scenes.blocks.block_scenes import FLOOR, box
from vv.ask import Ask, Displacement, History, Knobs
from vv.case import Case, Ladder, Series
from vv.scene import Contact, Harmonic, Pulse, Scene, Wall, rotation_about_z
from vv.standins.boxed import _reach, boxed, why_no_boxes

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
    assert reason == "2 walls move; its input describes the motion of one"


X, Y, Z = np.eye(3)
UP = Wall(np.zeros(3), Z, Harmonic(0.3 * X, 2.0 * X))
WAVE = Harmonic(np.array([2.0, 0.0, 1.0]), np.array([4.0, 0.0, 0.0]))
ALONG = np.array([True, False, True])


def made(*bodies: object, **scene: object) -> Ask:
    """The plan of a block of 2 x 1 x 1 m and 2000 kg, or of given bodies, for half a second."""
    given = bodies or (box("one", 0.5 * Z, [1.0, 0.5, 0.5]),)
    whole = Scene(given, Contact(np.inf), **{"gravity": -10.0 * Z, **scene})  # type: ignore[arg-type]
    return Ask(whole, History(0.5, 0.1), (Displacement(0),), Knobs(1e-2))


@pytest.mark.parametrize(
    ("ask", "way"),
    [
        (made(FLOOR, box("one", 0.5 * Z, [1.0, 0.5, 0.5], load=6000.0 * X + 9.0 * Z)), 0.375),
        (made(FLOOR, box("one", 0.5 * Z, [1.0, 0.5, 0.5], velocity=2.0 * Y - 7.0 * Z)), 1.0),
        (made(FLOOR, box("one", 0.5 * Z, [1.0, 0.5, 0.5]), gravity=4.0 * X - 9.0 * Z), 0.5),
        (made(FLOOR, Wall(-9.0 * X, X), box("one", 0.5 * Z, [0.5] * 3)), 1.25),  # it may fall
        (made(UP, box("one", 0.5 * Z, [0.5] * 3)), 0.6),
        (made(FLOOR, box("one", 0.5 * Z, [0.5] * 3), shaking=WAVE), 0.5 / (np.pi * 2) + 0.125),
    ],
)
def test_a_block_comes_twice_as_far_as_it_would_without_friction(ask: Ask, way: float) -> None:
    assert _reach(ask, ask.scene.blocks[0]) == pytest.approx(2 * way)


def test_a_wall_s_box_is_as_wide_as_blocks_are_large_or_may_come() -> None:
    still = boxed(made(FLOOR, box("one", 0.5 * Z, [1.0, 0.5, 0.5])))
    assert still["size"] == 2.0
    assert still["walls"][0]["half"] == [40.0, 40.0, 1.0]
    fast = boxed(made(FLOOR, box("one", 0.5 * Z, [0.5] * 3, velocity=100.0 * X)))
    assert fast["walls"][0]["half"] == [100.0, 100.0, 0.5]


def test_a_plan_says_what_blocks_are_and_when_shaking_ends() -> None:
    axes = rotation_about_z(0.3)
    free, free_spin = np.array([True, False, False]), np.array([False, True, True])
    one = box("one", 2.0 * X, [1.0, 0.5, 0.5], velocity=X, spin=Y, load=X + Y, free=free,
              free_spin=free_spin)  # fmt: skip
    plan = boxed(made(one, axes=axes, shaking=Pulse(WAVE, 0.3)))
    (block,) = plan["blocks"]
    for name, row in (("centre", 2.0 * X), ("velocity", X), ("spin", Y), ("load", X + Y)):
        assert block[name] == pytest.approx(axes @ row)
    assert (block["free"], block["free_spin"]) == ([*free], [*free_spin])
    assert np.array(block["vertices"]) @ axes == pytest.approx(one.vertices - one.centroid())
    assert np.array(block["inertia"]) == pytest.approx(axes @ one.inertia @ axes.T)
    assert plan["until"] == 0.3
    assert boxed(made(one, shaking=WAVE))["until"] is None


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (made(), None),
        (made(UP, box("one", 0.5 * Z, [0.5] * 3)), None),
        (made(box("one", X, [0.5] * 3, free=ALONG, velocity=Y)), "that it is locked in"),
        (made(box("one", X, [0.5] * 3, free=ALONG, velocity=X)), None),
        (made(box("one", X, [0.5] * 3, free=np.zeros(3, bool), velocity=Y)), None),
    ],
)
def test_only_what_polyhedra_do_is_not_refused(ask: Ask, words: str | None) -> None:
    why = why_no_boxes(ask)
    assert (why is None) is (words is None)
    assert words is None or words in (why or "")


def test_contact_with_a_stiffness_is_refused() -> None:
    ask = made()
    soft = dataclasses.replace(ask.scene, contact=Contact(1e3))
    assert "have no stiffness" in (why_no_boxes(dataclasses.replace(ask, scene=soft)) or "")

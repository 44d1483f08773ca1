"""Claims about sketches: a scene is seen from where it says most, and small however large it is."""

from __future__ import annotations

import numpy as np
import pytest

from tests.scenes.blocks.block_scenes import FREE, HELD, box
from vv.records import codec
from vv.scene import Bonds, Contact, Harmonic, Scene, Spheres, Wall
from vv.scene.picture.sketch import MOST, Sketch, sketch


def spheres(n: int, **parts: object) -> Spheres:
    """Spheres in a row along x, 2 m apart, of radius 1 m."""
    place = np.zeros((n, 3))
    place[:, 0] = 2.0 * np.arange(n)
    rest = {"velocity": np.zeros((n, 3)), "free": np.ones((n, 3), bool), **parts}
    return Spheres(position=place, radius=np.ones(n), mass=np.ones(n), **rest)  # type: ignore[arg-type]


def test_a_sphere_on_the_ground_is_seen_with_it_below() -> None:
    ground = Wall(np.array([0.0, 0.0, -1.0]), np.array([0.0, 0.0, 1.0]))
    seen = sketch(Scene((ground, spheres(1)), Contact(1e3), gravity=np.array([0.0, 0.0, -9.81])))
    assert seen.axes == ("x", "z")
    assert seen.size == 2.0
    assert seen.circles == ((0.0, 0.0, 0.5),)
    assert seen.walls == (((0.0, -0.5), (0.0, 1.0)),)
    assert [(arrow.what, arrow.along) for arrow in seen.arrows] == [("gravity", (0.0, -1.0))]


def test_a_wall_that_bodies_fly_to_is_in_the_picture_and_one_far_away_is_not() -> None:
    for distance, seen in ((3.0, 1), (1e6, 0)):
        wall = Wall(np.array([-distance, 0.0, 0.0]), np.array([1.0, 0.0, 0.0]))
        made = sketch(Scene((wall, spheres(1)), Contact(1e3)))
        assert len(made.walls) == seen
        assert made.size == (4.0 if seen else 2.0)


def test_what_is_held_driven_loaded_and_bonded_is_told() -> None:
    free = np.array([[False] * 3, [True] * 3])
    moves = np.array([[0.0] * 3, [3.0, 0.0, 0.0]])
    group = spheres(2, free=free, velocity=moves, load=-moves)
    bonds = Bonds(np.array([[0, 1]]), np.array(2.0), np.array(1e3), np.array(0.0))
    shaking = Harmonic(np.array([1.0, 0.0, 0.0]), np.ones(3))
    seen = sketch(Scene((group,), Contact(1e3), bonds=bonds, shaking=shaking))
    assert seen.held == (True, False)
    assert seen.bonds == (((-0.25, 0.0), (0.25, 0.0)),)
    assert sorted(arrow.what for arrow in seen.arrows) == ["load", "shaking", "velocity"]


def test_a_block_that_is_locked_is_told_from_one_that_is_not() -> None:
    for free in (FREE, HELD):
        seen = sketch(Scene((box("one", [0.0] * 3, [0.5] * 3, free=free),), Contact(np.inf)))
        assert set(seen.fixed) == {not free.any()}


@pytest.mark.parametrize("n", [1000, 5000])
def test_a_large_scene_has_a_small_sketch_that_says_how_much_it_leaves_out(n: int) -> None:
    seen = sketch(Scene((spheres(n),), Contact(1e3)))
    assert len(seen.circles) == MOST
    assert seen.bodies == n
    assert len(codec.render(seen)) < 10_000


def test_a_sketch_is_kept_as_it_is() -> None:
    seen = sketch(Scene((spheres(2),), Contact(1e3)))
    assert codec.read(Sketch, codec.parse(codec.render(seen)), "sketch") == seen

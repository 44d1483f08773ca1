"""Claims about sketches: a scene is seen from where it says most, and small however large it is."""

from __future__ import annotations

import numpy as np
import pytest

from tests.scenes.blocks.block_scenes import FREE, HELD, box
from tests.scenes.other_worlds import shifted
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


X, Y, Z = np.eye(3)


def balls(*rows: tuple[float, float, float, float], free: object = True) -> Spheres:
    """Spheres of these places and radii."""
    n, given = len(rows), np.array(rows)
    mask = np.broadcast_to(np.array(free, bool), (n, 3))
    return Spheres(given[:, :3], np.zeros((n, 3)), given[:, 3], np.ones(n), mask)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize(("gap", "touch"), [(-0.1, True), (0.0, True), (1e-7, True), (1e-4, False)])
def test_where_spheres_and_walls_touch_is_marked(size: float, gap: float, touch: bool) -> None:
    """Of radii 1 and 3 side by side, 8 wide together, the larger on the ground."""
    two = balls((0.0, 0.0, 0.0, size), ((4.0 + gap) * size, 0.0, 0.0, 3 * size))
    ground = Wall(-(3.0 + gap) * size * Z, Z)
    seen = sketch(shifted(Scene((two, ground), Contact(1e3), gravity=-Z), 16 * size * (X + Z)))
    expected = [(-0.25, 0.0), (0.125, -0.375)] if touch else []
    assert len(seen.touching) == len(expected)
    assert np.array(seen.touching) == pytest.approx(np.array(expected), abs=0.02)
    if gap == 0.0:
        assert seen.touching == tuple(expected)


@pytest.mark.parametrize(
    ("free", "rail"),
    [
        ([True, False, False], (1.0, 0.0)),
        ([False, False, True], (0.0, 1.0)),
        ([True, True, False], (1.0, 0.0)),  # y points at the reader
        ([True, False, True], None),
        ([False, True, False], None),
        ([False] * 3, None),
        ([True] * 3, None),
    ],
)
def test_the_only_direction_in_which_a_body_may_move_as_seen_is_its_rail(
    free: list[bool], rail: tuple[float, float] | None
) -> None:
    ground = Wall(-Z, Z)
    ball = sketch(Scene((balls((0.0, 0.0, 0.0, 1.0), free=free), ground), Contact(1e3), gravity=-Z))
    turns = np.ones(3, bool)
    one = box("one", [0.0] * 3, [1.0] * 3, free=np.array(free), free_spin=turns)
    block = sketch(Scene((one, ground), Contact(1e3), gravity=-Z, shaking=Harmonic(X, X)))
    for seen in (ball, block):
        assert seen.axes == ("x", "z")
        assert [way for _, way in seen.rails] == ([rail] if rail else [])


def test_a_sketch_is_the_same_wherever_the_scene_lies() -> None:
    wall = Wall(-3.0 * X, X)
    here = Scene((wall, spheres(1)), Contact(1e3), gravity=-Z)
    assert sketch(shifted(here, 1e3 * (X + Y - Z))) == sketch(here)


@pytest.mark.parametrize("size", [1e-320, 1e-300, 1e-200, 1e200, 1e300])
def test_a_gravity_whose_square_no_float_holds_points_where_any_other_does(size: float) -> None:
    pulled = [
        sketch(Scene((spheres(2),), Contact(1e3), gravity=size * np.array([0.0, -1.0, -1.0])))
        for size in (1.0, size)
    ]
    assert pulled[0] == pulled[1]


def test_no_arrow_has_a_negative_zero() -> None:
    for way in (X, -X, Z, -Z):
        assert "-0.0" not in str(sketch(Scene((spheres(1),), Contact(1e3), gravity=way)).arrows)


@pytest.mark.parametrize("n", [1000, 5000])
def test_a_large_scene_has_a_small_sketch_that_says_how_much_it_leaves_out(n: int) -> None:
    seen = sketch(Scene((spheres(n),), Contact(1e3)))
    assert len(seen.circles) == MOST
    assert seen.bodies == n
    assert len(codec.render(seen)) < 10_000


def test_a_sketch_is_kept_as_it_is() -> None:
    seen = sketch(Scene((spheres(2),), Contact(1e3)))
    assert codec.read(Sketch, codec.parse(codec.render(seen)), "sketch") == seen

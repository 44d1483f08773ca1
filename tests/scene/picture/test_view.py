"""From where a scene is seen, by hand: the line of sight, what is up, the faces that look at it."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from tests.scenes.blocks.block_scenes import box
from tests.scenes.other_worlds import rescaled, shifted
from vv.scene import Contact, Scene, Spheres, Vector, Wall, rotation_about_z
from vv.scene.picture import view

X, Y, Z = np.eye(3)


def balls(place: Any, velocity: Any = None, load: Any = None) -> Spheres:
    """Spheres at these places, at rest and unloaded unless told otherwise."""
    at = np.array(place, float)
    still = np.zeros_like(at)
    move, pull = (still if one is None else np.array(one, float) for one in (velocity, load))
    ones = np.ones(len(at))
    return Spheres(at, move, 0.1 * ones, ones, np.ones(at.shape, bool), load=pull)


def scene(*bodies: Any, **given: Any) -> Scene:
    return Scene(bodies, Contact(1e3), **given)


def deep(depth: float = 1.0) -> Spheres:
    """Eight spheres at the corners of a box, so deep along y."""
    corners = [[x, depth * y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    return balls(np.array(corners, float) * [1.0, 1.0, 1.0])


@pytest.mark.parametrize(
    ("one", "oblique"),
    [
        (scene(deep()), True),
        (scene(deep(), gravity=-Z), True),
        (scene(deep(0.01)), False),  # flat
        (scene(deep(0.03)), True),
        (scene(deep(), gravity=-Y), False),
        (scene(deep(), axes=rotation_about_z(0.3)), False),
        (scene(deep(), box("one", [5.0, 5.0, 5.0], [1.0] * 3)), False),
    ],
)
def test_only_spheres_in_depth_above_the_ground_are_seen_obliquely(
    one: Scene, oblique: bool
) -> None:
    assert (view.plane(one) is view.OBLIQUE) is oblique
    assert not oblique or view.names(view.plane(one)) == ()


SLANT = np.array([0.6, 0.0, 0.8])
PAIR = [-X, X]


@pytest.mark.parametrize(
    ("one", "axes"),
    [
        (scene(balls([0.0 * X]), gravity=-Y), ("x", "y")),
        (scene(balls([0.0 * X]), gravity=Z), ("x", "-z")),
        (scene(balls([0.0 * X]), Wall(-X, X)), ("x", "z")),
        (scene(balls([0.0 * X]), Wall(-X, X), Wall(-Y, Y), gravity=-Z), ("x", "y")),  # from above
        (scene(balls(3 * [0.0 * X], 3 * [1e-3 * Z], [1e4 * Y, 1e4 * X, 1e4 * Y])), ("y", "z")),
    ],
)
def test_what_acts_lies_across_the_line_of_sight_with_gravity_down(
    one: Scene, axes: tuple[str, str]
) -> None:
    assert view.names(view.plane(one)) == axes


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_a_scene_of_any_size_is_seen_alike_wherever_it_lies(size: float) -> None:
    """Two spheres along x that move along y and are pulled along z, twice as much to be seen."""
    one = scene(balls(PAIR, [Y, Y], [Z, Z]))
    other = shifted(rescaled(one, size, 1.0, 1.0), 50.0 * size * (Y + Z))
    for each in (one, other):
        assert view._sight(each, view._directions(each)) == pytest.approx(X)


def test_a_block_is_seen_across_the_directions_that_its_locks_leave_it() -> None:
    """A cube is as wide as it is high and deep: free along x and y alone, it is seen from above."""
    cube = box("one", [0.0, 0.0, 0.0], [1.0] * 3)
    flat = dataclasses.replace(cube, free=np.array([True, True, False]))
    assert view.names(view.plane(scene(cube))) == ("x", "z")
    assert view.names(view.plane(scene(flat))) == ("x", "y")


@pytest.mark.parametrize(
    ("gravity", "wall", "sight", "up"),
    [
        (-Z, Z, Y, Z),
        (-Z - X, Z, X, Z),
        (0 * Z, SLANT, Y, SLANT),
        (0 * Z, SLANT, X, Z),  # which points at the reader by more than a half
        (0 * Z, SLANT, Z, Y),
        (0 * Z, X, Y, Z),  # not oblique
        (-Z, X, Z, Y),
        (-Z - 0.8e-6 * X, Z, Z, Y),  # but for rounding
        (-Z - 1.2e-6 * X, Z, Z, X),
        (-SLANT, Z, SLANT, Y),
        (np.array([0.0, -0.6, -0.8]), Z, np.array([0.0, 0.6, 0.8]), np.array([0.0, 0.8, -0.6])),
        (0 * Z, np.array([0.6, 0.64, 0.48]), X, Z),
        (-Z, Z, np.array([0.0, 0.6, 0.8]), np.array([0.0, -0.8, 0.6])),
    ],
)
def test_up_is_against_gravity_or_off_an_oblique_wall(
    gravity: Vector, wall: Vector, sight: Vector, up: Vector
) -> None:
    one = scene(balls([0.0 * X]), Wall(-9 * wall, wall), gravity=gravity)
    assert view._up(one, sight) == pytest.approx(up, abs=1e-12)


@pytest.mark.parametrize(
    ("off", "named"), [(0.0, True), (0.8e-9, True), (1.2e-9, False), (0.2, False)]
)
def test_a_direction_has_an_axis_s_name_but_for_rounding(off: float, named: bool) -> None:
    seen = np.array([(1 - off) * X, -Z])
    assert view.names(seen) == (("x", "-z") if named else ())


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_the_faces_that_look_at_the_reader_are_seen_and_no_face_edge_on(size: float) -> None:
    """From -y: of a box one face, of one turned by 0.3 about z two, wherever they lie."""
    across = np.array([X, Z])
    for axes, count in ((np.eye(3), 1), (rotation_about_z(0.3), 2)):
        one = box("one", size * np.array([5.0, 7.0, 9.0]), size * np.array([1.0, 2.0, 3.0]), axes)
        found = view.faces(one, across)
        assert len(found) == count
        assert all(face[:, 1].mean() < one.centroid()[1] for face in found)


@pytest.mark.parametrize("noise", [[0.0, 0.0, 0.0], [1e-14, 0.0, 0.0], [0.0, 1e-14, -1e-14]])
def test_a_scene_along_one_line_is_seen_from_where_rounding_does_not_matter(
    noise: list[float],
) -> None:
    line = np.array([2.0, -1.0, 2.0]) / 3.0
    one = scene(balls([0.0 * line, line + noise], [line, -line]))
    right, up = view.plane(one)
    sight = np.array([2.0, 8.0, 2.0]) / np.sqrt(72.0)  # y without its part along the line
    assert np.abs(view.towards(np.array([right, up]))) == pytest.approx(sight, abs=1e-12)

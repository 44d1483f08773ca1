"""Claims about which scenes the reduced models serve, and what they are built from: by hand."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from vv.ask import Displacement, Velocity
from vv.engines.dem.line.model import ALIGNED, ROUNDING, Line, line
from vv.engines.dem.pressed.model import Pressed, pressed
from vv.scene import Contact, Harmonic, Scene, Spheres, Term, Vector, Wall

NORMAL, TANGENT = np.array([0.6, 0.0, 0.8]), np.array([0.8, 0.0, -0.6])
ACROSS = np.array([0.0, 1.0, 0.0])
AXES = np.array([NORMAL, TANGENT, ACROSS])
ROUGH = Contact(1e4, 8e3, 0.3)
CORNER = np.array([1.0, -2.0, 3.0])  # a point of the wall
GRAVITY, LOAD = np.array([1.0, 2.0, -9.0]), np.array([4.0, 0.0, 3.0])


def scene(free: list[bool], contact: Contact = ROUGH, deep: float = 0.02, **others: Any) -> Scene:
    """A sphere of 3 kg and 0.5 m that overlaps an oblique wall, free along some of the axes."""
    at = np.array([free])
    sphere = Spheres(
        (CORNER + (0.5 - deep) * NORMAL + 7.0 * ACROSS)[None],
        (at[0] * [-1.0, 2.0, 0.5]) @ AXES[None],
        np.array([0.5]), np.array([3.0]), at, load=LOAD[None],
    )  # fmt: skip
    given = {"gravity": GRAVITY, "axes": AXES, **others}
    wall = Wall(CORNER, NORMAL, given.pop("motion", None))
    return Scene((wall, sphere), contact, **given)


def built(one: Line | None) -> Line:
    assert one is not None
    return one


def test_along_a_normal_a_sphere_has_a_spring_and_the_forces_that_act_there() -> None:
    found = built(line(scene([True, False, False], Contact(1e4, eta_n=7.0), eta=2.0)))
    assert found.along == pytest.approx(NORMAL)
    assert found.weight == pytest.approx(3.0 * GRAVITY @ NORMAL)
    assert found.load == pytest.approx(LOAD @ NORMAL)
    state = found.state
    assert state.velocity == pytest.approx([-1.0])
    assert state.force == pytest.approx(found.weight + found.load)
    assert state.normal == pytest.approx((1e4, -0.02))
    assert (state.mass, state.friction, state.eta, state.eta_n) == (3.0, None, 2.0, 7.0)
    due = {Term.SPHERE, Term.WALL_CONTACT, Term.GRAVITY, Term.LOAD, Term.DRAG}
    assert found.terms - {Term.OBLIQUE_LOCK} == due | {Term.CONTACT_VISCOSITY}
    assert "along the contact normal" in found.words


def test_along_a_wall_a_sphere_rubs_under_what_it_overlaps() -> None:
    found = built(line(scene([False, True, False])))
    assert found.along == pytest.approx(TANGENT)
    assert found.state.normal is None
    assert found.state.friction == pytest.approx((8e3, 0.3 * 1e4 * 0.02))
    assert found.state.force == pytest.approx((3.0 * GRAVITY + LOAD) @ TANGENT)
    assert "at constant overlap" in found.words
    for free_of_it in (
        scene([False, True, False], deep=-0.02),
        scene([False, True, False], Contact(1e4)),
    ):
        smooth = built(line(free_of_it))
        assert smooth.state.friction is None
        assert smooth.terms & {Term.FRICTION, Term.WALL_CONTACT} == set()


def test_a_sphere_on_its_own_moves_along_its_line() -> None:
    one = scene([False, True, False])
    alone = built(line(dataclasses.replace(one, bodies=one.bodies[1:])))
    assert (alone.state.normal, alone.state.friction, alone.state.eta) == (None, None, None)
    assert "free of contact" in alone.words
    at_rest = dataclasses.replace(one, bodies=one.bodies[1:], gravity=np.zeros(3))
    (sphere,) = at_rest.bodies
    assert isinstance(sphere, Spheres)
    idle = dataclasses.replace(sphere, load=np.zeros((1, 3)))
    forceless = built(line(dataclasses.replace(at_rest, bodies=(idle,))))
    assert forceless.state.force is None
    assert built(line(dataclasses.replace(at_rest, bodies=(one.bodies[0], dataclasses.replace(
        idle, free=np.array([[True, False, False]]), velocity=-NORMAL[None]
    ))))).state.force == 0.0  # fmt: skip


@pytest.mark.parametrize(("part", "acts"), [(0.5, False), (2.0, True)])
def test_a_component_of_a_force_that_is_rounding_does_not_act(part: float, acts: bool) -> None:
    """It is compared with the whole force, of which it is 1e-14."""
    one = scene([False, True, False])
    (_, sphere) = one.bodies
    assert isinstance(sphere, Spheres)
    heavy = dataclasses.replace(sphere, load=np.zeros((1, 3)), mass=np.array([3e6]))
    across = 10.0 * ACROSS + part * ROUNDING * 10.0 * TANGENT
    found = built(line(dataclasses.replace(one, bodies=(heavy,), gravity=across)))
    assert (found.state.force is not None) == acts
    assert (Term.GRAVITY in found.terms) == acts


def test_potentials_are_the_works_of_weight_and_load_reversed_and_never_minus_zero() -> None:
    found = built(line(scene([True, False, False], Contact(1e4))))
    path, energy = np.array([[0.0, 1.0], [2.0, 3.0]]), np.arange(12.0).reshape(2, 6)
    held = found.held(path, energy)
    q = path[:, 0]
    potentials = -q * found.weight, -q * found.load
    assert held == pytest.approx(np.column_stack([energy[:, :5], *potentials]))
    beside = on_wall(pressed(scene([True, True, False], shaking=WAVE)))
    pushed = dataclasses.replace(beside, weight=np.ones(2), load=np.ones(2))
    for table in (held, pushed.held(np.zeros((2, 4)), np.zeros((2, 8)))):
        assert not np.signbit(table[0]).any()


def beside(distance: float, held_first: bool, along: Vector) -> Scene:
    """Two spheres, one of which is held; the other is free along one axis."""
    place = np.array([np.zeros(3), distance * along])
    free = np.zeros((2, 3), bool)
    free[int(held_first), 0] = True
    spheres = Spheres(
        place,
        np.where(free[:, :1], 2.0, 0.0) * NORMAL,
        np.array([0.5, 0.3]),
        np.array([3.0, 2.0]),
        free,
    )
    return Scene((spheres,), ROUGH, axes=AXES)


@pytest.mark.parametrize("held_first", [True, False])
def test_a_sphere_that_meets_another_is_pushed_away_from_it(held_first: bool) -> None:
    """The unknown grows as they part, wherever the free axis points."""
    found = built(line(beside(0.9, held_first, NORMAL)))
    away = NORMAL if held_first else -NORMAL
    assert found.along == pytest.approx(away)
    assert found.state.velocity == pytest.approx([2.0 if held_first else -2.0])
    assert found.state.normal == pytest.approx((1e4, 0.1))
    assert found.sphere == int(held_first)
    assert found.terms == {Term.SPHERE, Term.SPHERE_CONTACT, Term.OBLIQUE_LOCK} & found.terms
    path = np.array([[1.0, 5.0], [2.0, 6.0]])
    moves, rests = int(held_first), int(not held_first)
    assert found.observed(path, 0, moves, Displacement(0)) == pytest.approx(np.outer([1, 2], away))
    assert found.observed(path, 0, moves, Velocity(0)) == pytest.approx(np.outer([5, 6], away))
    assert not found.observed(path, 0, rests, Velocity(0)).any()


@pytest.mark.parametrize(("slope", "serves"), [(0.9 * ALIGNED, True), (1.1 * ALIGNED, False)])
def test_a_motion_along_a_normal_or_a_wall_is_so_but_for_rounding(
    slope: float, serves: bool
) -> None:
    tilted = NORMAL + slope * TANGENT
    assert (line(beside(0.9, True, tilted)) is not None) == serves
    for free in ([True, False, False], [False, True, False]):
        one = scene(free)
        wall = Wall(CORNER, tilted / np.linalg.norm(tilted))
        assert (line(dataclasses.replace(one, bodies=(wall, one.bodies[1]))) is not None) == serves
    flat = scene([True, True, False])
    leaning = NORMAL + slope * ACROSS
    wall = Wall(CORNER, leaning / np.linalg.norm(leaning))
    assert (pressed(dataclasses.replace(flat, bodies=(wall, flat.bodies[1]))) is not None) == serves


def test_more_than_one_direction_or_body_is_more_than_one_unknown() -> None:
    one = scene([True, False, False])
    assert line(scene([True, True, False])) is None
    third = Wall(-9.0 * NORMAL, NORMAL)
    assert line(dataclasses.replace(one, bodies=(*one.bodies, third))) is None
    (_, sphere) = one.bodies
    assert isinstance(sphere, Spheres)
    spins = dataclasses.replace(sphere, free_spin=np.ones((1, 3), bool))
    assert line(dataclasses.replace(one, bodies=(one.bodies[0], spins))) is None


def on_wall(one: Pressed | None) -> Pressed:
    assert one is not None
    return one


WAVE = Harmonic(np.array([0.3, 0.0, -0.2]), np.array([2.0, 9.0, 0.7]), np.array([0.4, 9.0, 1.3]))


def test_a_sphere_on_a_wall_has_forces_along_its_normal_and_its_tangent() -> None:
    one = scene([True, True, False], eta=2.0, shaking=WAVE)
    found = on_wall(pressed(one, np.array([[6.0, 1.0, 2.0]])))
    assert found.axes == pytest.approx(AXES)
    assert found.weight == pytest.approx(3.0 * AXES[:2] @ GRAVITY)
    assert found.load == pytest.approx(AXES[:2] @ LOAD)
    state = found.state
    assert state.force == pytest.approx(found.weight + found.load)
    assert state.velocity == pytest.approx([-1.0, 2.0])
    assert (state.mass, state.kn, state.eta, state.base) == (3.0, 1e4, 2.0, None)
    assert state.gap == pytest.approx(-0.02)
    assert state.friction == pytest.approx((8e3, 0.3, TANGENT @ [6.0, 1.0, 2.0]))
    assert state.shaking is not None
    waves = np.diag(WAVE.amplitude)[[0, 2]] @ AXES.T
    assert state.shaking.direction == pytest.approx(waves)
    assert on_wall(pressed(one)).state.friction == (8e3, 0.3, 0.0)
    assert on_wall(pressed(scene([True, True, False], Contact(1e4)))).state.friction is None
    path = np.arange(8.0).reshape(2, 4)
    assert found.observed(path, 0, 0, Displacement(1)) == pytest.approx(path[:, :2] @ AXES[:2])
    assert found.observed(path, 0, 0, Velocity(1)) == pytest.approx(path[:, 2:] @ AXES[:2])
    energy = np.arange(16.0).reshape(2, 8)
    held = found.held(path, energy)
    potential = [-path[:, :2] @ found.weight, -path[:, :2] @ found.load]
    assert held == pytest.approx(np.column_stack([energy[:, :5], *potential, -energy[:, 5:7]]))
    still = on_wall(pressed(scene([True, True, False])))
    assert still.held(path, energy).shape == (2, 7)


@pytest.mark.parametrize(("part", "serves"), [(0.4 * ALIGNED, True), (2.0 * ALIGNED, False)])
def test_a_wall_may_not_move_where_the_sphere_is_locked_but_for_rounding(
    part: float, serves: bool
) -> None:
    size = 0.01
    motion = Harmonic(
        size * np.array([1.0, 0.0, 0.0]), np.ones(3), np.zeros(3),
        axes=_turned(TANGENT + part * ACROSS),
    )  # fmt: skip
    found = pressed(scene([True, True, False], motion=motion))
    assert (found is not None) == serves
    if found is not None:
        assert found.state.base is not None
        assert found.state.base.direction[0, :2] == pytest.approx([0.0, size], abs=1e-15)


def _turned(first: Vector) -> Vector:
    """Axes of which the first has the given direction."""
    first = first / np.linalg.norm(first)
    second = np.cross(NORMAL, first)
    second = second / np.linalg.norm(second)
    return np.array([first, second, np.cross(first, second)])


def test_a_tangent_points_to_the_side_of_the_free_axis_that_is_nearest() -> None:
    one = scene([True, True, False])
    for sign in (1.0, -1.0):
        axes = np.array([sign * TANGENT, sign * ACROSS, NORMAL])  # a right-handed system
        free = np.array([[True, False, True]])
        (_, sphere) = one.bodies
        assert isinstance(sphere, Spheres)
        turned = dataclasses.replace(sphere, free=free, velocity=np.zeros((1, 3)))
        found = on_wall(
            pressed(dataclasses.replace(one, bodies=(one.bodies[0], turned), axes=axes))
        )
        assert found.axes[1] == pytest.approx(sign * TANGENT)

"""Claims about springs and spheres in place of rigid contact and blocks: their initial state."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.scenes.blocks.block_scenes import FREE, HELD, box
from tests.scenes.random_scenes import frames
from vv.scene import Block, Contact, Elastic, Harmonic, Scene, Spheres, Vector, Wall
from vv.standins.penalty_springs import (
    acceleration_of,
    as_spheres,
    base_acceleration,
    base_velocity,
    fastest,
    friction_at_start,
    softened,
    why_no_point,
)

X, Y, Z = np.eye(3)
FLOOR = Wall(7.0 * Z, Z)
RISES = Harmonic(0.02 * Z, Z, -np.pi / 2 * Z)  # begins at rest, upwards
START = 0.02 * (2 * np.pi) ** 2  # m/s2
THREE = st.lists(st.floats(-2.0, 2.0), min_size=3, max_size=3).map(np.array)
POSITIVE = st.lists(st.floats(0.1, 2.0), min_size=3, max_size=3).map(np.array)


def cube(**given_block: Any) -> Block:
    """A cube of 1 m and 1000 kg, on a floor at 7 m."""
    return box("one", 7.5 * Z, [0.5] * 3, **{"free_spin": HELD, **given_block})


def ball(height: float = 0.0, **changes: Any) -> Spheres:
    """A ball of 0.5 m and 2 kg at a height above the floor."""
    one = Spheres((7.5 + height) * Z[None], np.zeros((1, 3)), np.array([0.5]), np.array([2.0]),
                  FREE[None])  # fmt: skip
    return dataclasses.replace(one, **changes)


def rigid(*bodies: Any, mu: float = 0.0, **scene: Any) -> Scene:
    return Scene(bodies, Contact(np.inf, mu=mu), **{"gravity": -10.0 * Z, **scene})


@pytest.mark.parametrize(
    ("scene", "words"),
    [
        (rigid(FLOOR, cube()), None),
        (rigid(FLOOR, ball(9.0)), None),
        (rigid(FLOOR, Wall(-X, X), ball(9.0)), None),
        (rigid(FLOOR, cube(free_spin=np.array([False, False, True]))), "may turn"),
        (rigid(FLOOR, cube(spin=X)), "spins at a prescribed rate"),
        (rigid(FLOOR, cube(elastic=Elastic(1e9, 0.2))), "is elastic"),
        (rigid(cube()), "between 0 walls"),
        (rigid(FLOOR, Wall(-X, X), cube()), "between 2 walls"),
        (rigid(FLOOR, cube(), ball(9.0)), "may touch spheres"),
    ],
)
def test_a_sphere_stands_for_a_block_that_moves_as_a_point(scene: Scene, words: str | None) -> None:
    why = why_no_point(scene)
    assert (why is None) is (words is None)
    assert words is None or words in (why or "")
    if words:
        with pytest.raises(ValueError, match=words):
            as_spheres(scene)


@pytest.mark.parametrize(
    ("gap", "radius"), [(0.0, 0.5), (0.8e-9, 0.5 + 0.8e-9), (0.1, 0.5), (-0.1, 0.5)]
)
def test_the_sphere_of_a_block_is_as_far_off_its_wall(gap: float, radius: float) -> None:
    one = cube(velocity=X, load=Y, free=np.array([True, True, False]))
    lifted = dataclasses.replace(one, vertices=one.vertices + gap * Z)
    (wall, made) = as_spheres(rigid(FLOOR, lifted)).bodies
    assert isinstance(made, Spheres)
    assert wall is FLOOR
    assert made.position[0] == pytest.approx((7.5 + gap) * Z)
    assert made.radius[0] == pytest.approx(radius, abs=1e-14)
    assert made.mass[0] == pytest.approx(1000.0)
    assert [made.velocity.tolist(), made.load.tolist()] == [[X.tolist()], [Y.tolist()]]
    assert made.free.tolist() == [[True, True, False]]


@pytest.mark.parametrize(
    ("body", "scene", "overlap"),
    [
        (ball(), {}, 20.0),  # N of weight over 1000 N/m, and so on
        (ball(load=-4.0 * Z[None]), {}, 24.0),
        (ball(load=25.0 * Z[None]), {}, 0.0),  # pulled off
        (ball(), {"shaking": Harmonic(3.0 * Z, X, np.pi / 2 * Z)}, 14.0),
        (ball(0.4e-9), {}, 20.0),  # of 0.5 m, but for rounding
        (ball(0.6e-9), {}, 0.0),
        (ball(-0.6e-9), {}, 0.0),
        (ball(1.0), {}, 0.0),
    ],
)
def test_a_sphere_starts_as_deep_as_its_spring_carries_what_presses_it(
    body: Spheres, scene: dict[str, Any], overlap: float
) -> None:
    made = softened(rigid(FLOOR, body, **scene), 1000.0).spheres
    sunk = (body.position - made.position)[0]
    assert sunk == pytest.approx(overlap / 1000.0 * Z, abs=1e-12)


def test_a_wall_that_begins_to_rise_presses_a_sphere_by_its_acceleration() -> None:
    made = softened(rigid(Wall(7.0 * Z, Z, RISES), ball()), 1000.0).spheres
    assert 7.5 - made.position[0, 2] == pytest.approx(2.0 * (10.0 + START) / 1000.0)


def test_springs_have_the_stiffnesses_that_are_asked_for() -> None:
    rough, smooth = (softened(rigid(FLOOR, ball(), mu=mu), 5.0, 3.0).contact for mu in (0.5, 0.0))
    assert (rough.kn, rough.ks, rough.mu) == (5.0, 15.0, 0.5)
    assert (smooth.kn, smooth.ks) == (5.0, 0.0)
    soft = dataclasses.replace(rigid(FLOOR, ball()), contact=Contact(8.0))
    assert softened(soft, 5.0) is soft


@pytest.mark.parametrize(
    ("body", "scene", "friction"),
    [
        (ball(load=3.0 * X[None]), {}, -3.0 * X),  # at rest
        (ball(load=30.0 * X[None]), {}, -10.0 * X),  # up to 0.5 times the weight, 20 N
        (ball(load=(3.0 * X - 4.0 * Z)[None]), {}, -3.0 * X),
        (ball(load=(30.0 * X - 4.0 * Z)[None]), {}, -12.0 * X),
        (ball(load=(30.0 * X + 25.0 * Z)[None]), {}, 0.0 * X),  # pulled off
        (ball(velocity=0.1 * X[None]), {}, -10.0 * X),  # slips
        (ball(velocity=0.1 * X[None], load=3.0 * Y[None]), {}, -10.0 * X),
        (ball(0.6e-9, load=3.0 * X[None]), {}, 0.0 * X),  # not on its wall
        (ball(0.4e-9, load=3.0 * X[None]), {}, -3.0 * X),
        (ball(load=(3.0 * X + 4.0 * Y)[None], free=np.array([[True, False, True]])), {}, -3.0 * X),
        (ball(), {"shaking": Harmonic(2.0 * Y, Y, np.pi / 2 * Y)}, -4.0 * Y),
        (ball(), {"gravity": -10.0 * Z + X}, -2.0 * X),
    ],
)
def test_friction_at_the_start_holds_what_rests_and_opposes_what_slips(
    body: Spheres, scene: dict[str, Any], friction: Vector
) -> None:
    found = friction_at_start(rigid(FLOOR, body, mu=0.5, **scene))
    assert found[0] == pytest.approx(friction, abs=1e-9)


def test_slip_is_seen_from_the_wall_and_rounding_is_none() -> None:
    wave = Harmonic(0.1 * X, X)  # begins at 0.2 pi m/s
    speed = 0.2 * np.pi
    for velocity, friction in ((speed, 0.0), (0.0, 10.0), (2 * speed, -10.0)):
        body = ball(velocity=velocity * (1 + 1e-13) * X[None])
        found = friction_at_start(rigid(Wall(7.0 * Z, Z, wave), body, mu=0.5))
        assert found[0] == pytest.approx(friction * X, abs=1e-9)


@given(THREE, POSITIVE, THREE, frames(), st.floats(0.0, 3.0))
def test_velocity_and_acceleration_of_a_wall_are_the_rates_of_its_motion(
    size: Vector, frequency: Vector, phase: Vector, axes: Vector, t: float
) -> None:
    motion = Harmonic(size, frequency, phase, axes)

    def place(at: float) -> Vector:
        return sum((a * np.sin(2 * np.pi * f * at + p) for a, f, p in motion.sines()), np.zeros(3))

    h, bound = 1e-4, 200.0 * (1.0 + float(np.abs(size).max()))
    assert acceleration_of(motion, t) == pytest.approx(place(t), abs=1e-9)
    rate = (place(t + h) - place(t - h)) / (2 * h)
    assert base_velocity(motion, t) == pytest.approx(rate, abs=bound * h)
    bend = (base_velocity(motion, t + h) - base_velocity(motion, t - h)) / (2 * h)
    assert base_acceleration(motion, t) == pytest.approx(bend, abs=20 * bound * h)
    assert np.linalg.norm(base_velocity(motion, t)) <= fastest(motion) * (1 + 1e-12)


def test_a_wall_is_no_faster_than_the_sum_of_its_sines() -> None:
    motion = Harmonic(np.array([0.1, -0.2, 0.0]), np.array([1.0, 3.0, 9.0]))
    assert fastest(motion) == pytest.approx(2 * np.pi * 0.7)
    assert fastest(None) == 0.0
    for rate in (acceleration_of, base_velocity, base_acceleration):
        assert (rate(None, 1.0) == 0.0).all()

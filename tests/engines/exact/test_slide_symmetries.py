"""Claims about symmetries of exact slides: rotated, relative to the wall, repeated."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from tests.scenes.blocks.exact_slides import BOX, LEVEL, apart, ran
from tests.scenes.blocks.sliding_blocks import Frame, incline, random_scene, responding, wall
from vv.engines.exact.slide.clock import Clock
from vv.scene import Harmonic, Spheres, Vector, rotated


@pytest.mark.parametrize("frame", [Frame(20, 0.7), Frame(20, 0, True), Frame(20, 4.0, True)])
def test_a_slope_slides_alike_wherever_it_faces(frame: Frame) -> None:
    plain = ran(incline(Frame(20), 22.0, 20.0), 3.0).values[BOX] @ Frame(20).dip
    moved = ran(incline(frame, 22.0, 20.0), 3.0).values[BOX]
    assert apart(moved, plain[:, None] * frame.dip) < 1e-13


def test_scenes_turned_in_space_move_alike() -> None:
    for seed in range(6):
        scene, rotation = random_scene(seed)[0], _turned(seed)
        plain, other = (ran(s, 2.0).values[BOX] for s in (scene, rotated(scene, rotation)))
        assert apart(other @ rotation, plain) < 1e-12, f"seed {seed}"


def _turned(seed: int) -> Vector:
    matrix = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    return np.asarray(matrix * np.sign(np.linalg.det(matrix)))


def test_a_sphere_that_cannot_turn_moves_as_a_block_does() -> None:
    scene = incline(Frame(20), 22.0, 5.0)
    ball = Spheres(
        position=Frame(20).normal[None],
        velocity=np.zeros((1, 3)),
        radius=np.ones(1),
        mass=np.array([7.0]),
        free=np.ones((1, 3), bool),
    )
    other = dataclasses.replace(scene, bodies=(scene.walls[0], ball))
    assert apart(ran(other, 3.0).values[BOX], ran(scene, 3.0).values[BOX]) < 1e-14


def test_shaking_is_a_wall_that_moves_seen_from_the_wall() -> None:
    D, f = 0.3, 1.0
    moving = ran(responding(D, f, 0.6), 5.0)
    still = responding(D, f, 0.6)
    felt = Harmonic((D * (2 * np.pi * f) ** 2, 0, 0), (f, f, f), (-np.pi / 2,) * 3)  # type: ignore[arg-type]
    shaken = dataclasses.replace(still, bodies=(wall(LEVEL), still.blocks[0]), shaking=felt)
    base = D * (1 - np.cos(2 * np.pi * f * moving.times))
    slip = moving.values[BOX][:, 0] - base
    assert apart(ran(shaken, 5.0).values[BOX][:, 0], slip) < 1e-13


def test_phases_are_as_sharp_after_a_million_periods_as_at_first() -> None:
    clock = Clock.of(np.array([2.0, 0.375]), np.array([0.3, 1.1]), 1e9)
    assert (clock.waves((8 * 10**9 * 16, 0.25)) == clock.waves((0, 0.25))).all()
    assert clock.waves_at(np.array([16e6]))[0] == pytest.approx(clock.waves((0, 0.0)), abs=1e-15)


def test_phases_of_turns_too_large_for_whole_numbers_lose_nothing() -> None:
    a, b = 2**62 - 1, 2**62 + 3
    clock = Clock(4.0, ((a, b),), np.array([1.0]), np.array([0.3]))
    due = [2 * math.pi * ((a * n) % b / b) + 0.3 for n in range(7)]
    assert clock.angles(7)[:, 0] == pytest.approx(due, rel=1e-15)


def test_a_long_history_repeats_itself() -> None:
    d = ran(incline(Frame(20), 22.0, 5.0), 400.0, 100.0).values[BOX] @ Frame(20).dip
    gains = np.diff(d)
    assert np.abs(gains - 100 * 0.7080274126836).max() < 1e-12 * d[-1]

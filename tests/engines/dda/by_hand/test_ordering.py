"""Claims about the order in which DDA solves for the blocks of a scene."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from tests.scenes.blocks.dda_scenes import DOWN, FLOOR, box
from vv.ask import Ask, Displacement, History, Knobs, Status, Velocity
from vv.engines.dda import DEFAULT
from vv.engines.dda.general.model import General
from vv.engines.dda.ordering import short_rows
from vv.engines.dda.solve import PreparedBlocks, prepare
from vv.scene import Block, Contact, Scene, Vector

LONG, HIGH = 12, 3
PLANE, ACROSS = np.array([True, False, True]), np.array([False, True, False])


def stone(column: float, course: int, rate: float) -> Block:
    centre = np.array([column, 0.0, course + 0.5])
    velocity, half = np.array([rate, 0.0, 0.0]), (0.5, 0.5, 0.5)
    return box(half, 2000.0, centre, free=PLANE, free_spin=ACROSS, velocity=velocity)


def wall() -> Scene:
    """Courses one on another, each listed from the left; a stone of the lowest one slides."""
    stones = [
        stone(column * 1.5 + 0.1 * course, course, 0.1 * (course == 0 and column == LONG - 1))
        for course in range(HIGH)
        for column in range(LONG)
    ]
    return Scene((FLOOR, *stones), Contact(math.inf, mu=0.6), gravity=DOWN)


def lengths(scene: Scene) -> Vector:
    """How many blocks lie between each block and the first that it touches, and this block."""
    centres = np.array([block.centroid() for block in scene.blocks])
    near = (np.abs(centres[:, None] - centres) < 1.01).all(axis=2)
    return np.asarray(np.arange(len(centres)) - near.argmax(axis=1))


def test_the_stones_of_a_long_wall_are_solved_column_by_column() -> None:
    ordered, place = short_rows(wall())
    assert lengths(wall()).max() == LONG
    assert lengths(ordered).max() < HIGH
    for block, where in zip(wall().blocks, place, strict=True):
        assert np.array_equal(ordered.blocks[where].vertices, block.vertices)


def test_blocks_stay_in_order_where_no_other_is_much_cheaper() -> None:
    column = dataclasses.replace(
        wall(), bodies=(FLOOR, *(stone(0.0, course, 0.0) for course in range(8)))
    )
    ordered, place = short_rows(column)
    assert ordered is column
    assert np.array_equal(place, np.arange(8))


def test_each_stone_moves_as_it_does_in_the_order_of_the_scene() -> None:
    scene = wall()
    seen = tuple(kind(body) for body in (1, LONG, LONG * HIGH) for kind in (Displacement, Velocity))
    ask = Ask(scene, History(0.05, 0.05), seen, Knobs(1e-3, 1e9))
    ordered = prepare(ask, DEFAULT)
    listed = PreparedBlocks(ask, DEFAULT, General(scene, DEFAULT), np.arange(len(scene.blocks)))
    one, two = ordered.run(ordered.solve()), listed.run(listed.solve())
    assert one.status is two.status is Status.RAN
    assert not np.array_equal(ordered.place, listed.place)
    assert np.abs(one.values[Displacement(LONG)][-1]).max() > 1e-4
    for what in seen:
        assert np.allclose(one.values[what], two.values[what], rtol=0.0, atol=1e-9)

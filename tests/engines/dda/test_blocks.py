"""Claims about the general route of DDA: blocks that rotate, strain and touch each other."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from tests.scenes.blocks.dda_scenes import (
    ALL,
    FLOOR,
    NONE,
    ROUGH,
    asked,
    box,
    general,
    moved,
    run,
    shaken,
    slope,
    stack,
    watching,
)
from vv.ask import Velocity
from vv.engines.dda import DEFAULT, PUBLISHED, Formulation, prepare
from vv.engines.dda.general import model
from vv.engines.dda.general.unknowns import unknowns_of
from vv.scene import (
    Block,
    Contact,
    Mask,
    Scene,
    Vector,
    rotated,
    rotation_about_z,
    with_bodies_reversed,
)


@pytest.mark.parametrize("way", [PUBLISHED, DEFAULT], ids=["published", "default"])
@pytest.mark.parametrize(
    "scene",
    [
        shaken((0.1, 0.1, 0.1), (2, 4, 1), 0.6),
        slope(28, 20),
        slope(20, 30, A=20.0),
        slope(45, 50, A=2.0, free=np.array([True, False, True])),
        slope(30, 20, velocity=0.1),
    ],
    ids=["responding", "gravity", "two-way", "plane", "launched"],
)
def test_the_reduced_kernel_agrees_with_the_general_route_to_rounding(
    scene: Scene, way: Formulation
) -> None:
    ask = asked(scene, 2e-3, 1e9, 0.5)
    way = dataclasses.replace(way, settling=0.1 * bool(way.settling))
    few, many = run(ask, way), general(ask, way)
    size = np.abs(moved(few)).max()
    assert size > 1e-5
    assert np.abs(moved(few) - moved(many)).max() <= 1e-11 * size + 1e-14
    assert few.ledger is not None
    assert many.ledger is not None
    assert many.ledger.terms == pytest.approx(dict(few.ledger.terms), abs=1e-9 * few.ledger.peak)
    assert few.steps == many.steps
    assert all(seen <= allowed for seen, allowed in many.ledger.audits.values())


def test_the_unknowns_of_a_block_are_found_once_however_often_the_start_is_sought(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    found: list[Block] = []

    def counted(block: Block, axes: Vector) -> tuple[Vector, Vector, Vector]:
        found.append(block)
        return unknowns_of(block, axes)

    monkeypatch.setattr(model, "unknowns_of", counted)
    program = prepare(asked(stack(ALL), 1e-3, 1e9, 0.01), DEFAULT)
    assert program.formulation.pressed
    assert program.arguments
    assert program.model.unknowns > 0
    assert found == list(program.ask.scene.blocks)


def test_the_smallest_model_is_built() -> None:
    still, turning = slope(28, 20), slope(28, 20, spin=True)
    flat = dataclasses.replace(
        turning.blocks[0], free=np.array([1, 0, 1], bool), free_spin=np.array([0, 1, 0], bool)
    )
    plane = dataclasses.replace(turning, bodies=(turning.walls[0], flat))
    for scene, unknowns in ((still, 3), (turning, 6), (plane, 3)):
        assert prepare(asked(scene, 1e-3, 1e8, 0.1), DEFAULT).model.unknowns == unknowns


@pytest.mark.parametrize("angle", [0.7, math.pi])
def test_friction_does_not_know_the_frame(angle: float) -> None:
    """A diagonal launch on a slope, rotated about the vertical; by pi it is the mirrored slope."""
    scene = slope(30, 25, spin=True)
    diagonal = np.array([0.3, 0.4, 0.0]) @ scene.axes
    body = dataclasses.replace(scene.blocks[0], velocity=diagonal)
    scene = dataclasses.replace(scene, bodies=(scene.walls[0], body))
    ask = asked(scene, 1e-3, 1e8, 0.3)
    turned = dataclasses.replace(ask, scene=rotated(scene, rotation_about_z(angle)))
    one, two = moved(run(ask, DEFAULT)), moved(run(turned, DEFAULT))
    assert np.abs(one @ rotation_about_z(angle).T - two).max() <= 1e-9 * np.abs(one).max()
    assert np.abs(one @ scene.axes[1]).max() > 0.01


@pytest.mark.parametrize(("free_spin", "within"), [(NONE, 1e-12), (ALL, 1e-5)])
def test_the_order_of_blocks_does_not_matter_and_runs_repeat_bit_by_bit(
    free_spin: Mask, within: float
) -> None:
    """For rotating blocks it decides which face gives the normal; faces are not quite parallel."""
    scene = stack(free_spin)
    one, again = (run(watching(scene, (1, 2), 0.2), DEFAULT) for _ in range(2))
    other = run(watching(with_bodies_reversed(scene), (1, 0), 0.2), DEFAULT)
    assert np.array_equal(one.values[Velocity(2)], again.values[Velocity(2)])
    for here, there in ((1, 1), (2, 0)):
        difference = one.values[Velocity(here)] - other.values[Velocity(there)]
        assert np.abs(difference).max() < within


def test_blocks_pass_momentum_on_and_lose_none() -> None:
    """Two boxes collide in free flight, edge on face, with friction."""
    one = box((0.5, 0.5, 0.5), 1000.0, np.zeros(3), free_spin=ALL, velocity=np.array([1.0, 0, 0]))
    turned = rotation_about_z(0.3)
    two = box((0.3, 0.3, 0.3), 3000.0, np.array([0.9, 0.2, 0.1]), turned.T, free_spin=ALL)
    scene = Scene((one, two), ROUGH)
    done = run(watching(scene, (0, 1), 0.2), DEFAULT)
    total = one.mass * done.values[Velocity(0)] + two.mass * done.values[Velocity(1)]
    assert np.abs(done.values[Velocity(1)][-1]).max() > 0.1
    assert np.abs(total - total[0]).max() < 1e-10 * one.mass
    assert done.ledger is not None
    assert done.ledger.bound is not None
    assert done.ledger.unaccounted <= done.ledger.bound
    assert all(seen <= allowed for seen, allowed in done.ledger.audits.values())


def test_a_stack_at_rest_stays_at_rest() -> None:
    scene = stack(ALL)
    bodies = (FLOOR, dataclasses.replace(scene.blocks[0], velocity=np.zeros(3)), scene.blocks[1])
    done = run(watching(dataclasses.replace(scene, bodies=bodies), (1, 2), 0.1), DEFAULT)
    assert max(np.abs(v).max() for v in done.values.values()) < 1e-6


@pytest.mark.parametrize("way", [PUBLISHED, DEFAULT], ids=["first order", "finite"])
def test_a_turning_block_grows_only_if_its_rotations_are_of_first_order(way: Formulation) -> None:
    """Inertia, and kinetic energy at constant spin, grow as the area: (1 + (th/n)^2)^n."""
    n, dt, w = 100, 1e-2, 3.0
    body = box((0.5, 0.3, 0.1), 1000.0, free_spin=ALL, spin=np.array([0.0, 0.0, w]))
    done = run(asked(Scene((body,), Contact(math.inf)), dt, 1e8, n * dt), way)
    start = 0.5 * float(body.inertia[2, 2]) * w**2
    factor = (1 + (w * dt) ** 2) ** n if way is PUBLISHED else 1.0
    assert done.ledger is not None
    assert done.ledger.terms["kinetic"] == pytest.approx(start * factor, rel=1e-10)

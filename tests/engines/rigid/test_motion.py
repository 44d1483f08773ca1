"""Claims about rigid blocks that rotate and touch: balance, objectivity, order, rest, refusals."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from tests.scenes.blocks.block_scenes import (
    DOWN,
    FLOOR,
    FREE,
    HELD,
    G,
    box,
    incline,
    running_bond,
    slope,
)
from tests.scenes.blocks.failure_modes import charted, points, seen
from vv.ask import Ask, Displacement, History, Knobs, Status, Velocity
from vv.engines import rigid
from vv.engines.rigid import PreparedRigidBlocks
from vv.scene import (
    Block,
    Contact,
    Scene,
    Vector,
    Wall,
    rotated,
    rotation_about_z,
    with_bodies_reversed,
)


def solved(
    scene: Scene, duration: float, dt: float = 1e-3, interval: float = 0.01
) -> PreparedRigidBlocks:
    bodies = [i for i, body in enumerate(scene.bodies) if isinstance(body, Block)]
    shown = tuple(kind(i) for i in bodies for kind in (Displacement, Velocity))
    question = Ask(scene, History(duration, interval), shown, Knobs(dt))
    assert rigid.refuses(question) is None
    program = rigid.prepare(question)
    assert program.solve() == len(program.arguments[0])
    return program


def ends(program: PreparedRigidBlocks) -> Vector:
    """Displacements (n, 3) at the end [m]."""
    path: Vector = program.arguments[0]
    return path[-1, ::2, :3]


@pytest.mark.parametrize("free_spin", [HELD, FREE])
def test_a_block_that_nothing_drives_stays_where_it_is(free_spin: Vector) -> None:
    alone = box("alone", [0.0, 0.0, 1.0], [0.3] * 3, free_spin=free_spin)
    for bodies in ((alone,), (FLOOR, alone)):
        path = solved(Scene(bodies, Contact(np.inf, mu=0.2)), 0.1).arguments[0]
        assert (path[..., :3] == 0.0).all()


def turn(seed: int) -> Vector:
    q = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    return np.asarray(q * np.sign(np.linalg.det(q)))


def stack(lower: Any = (0.5, 0.5, 0.5)) -> Scene:
    one = box("lower", [0.0, 0.0, lower[2]], lower)
    two = box("upper", [0.1, 0.05, 2 * lower[2] + 0.3], [0.4, 0.4, 0.3])
    return Scene((FLOOR, one, two), Contact(np.inf, mu=0.5), gravity=DOWN)


def colliding(mu: float = 0.4) -> Scene:
    blocks = tuple(
        box(str(i), [1.2 * i, 0.1 * i, 0.2 * i], [0.5, 0.3, 0.4], turn(1),
            velocity=[-1.0 * i, 0.0, 0.0], spin=[0.5, i, 0.3])
        for i in range(3)
    )  # fmt: skip
    return Scene(blocks, Contact(np.inf, mu=mu))


def test_a_stack_at_rest_stays_and_presses_with_its_weight() -> None:
    program = solved(stack(), 0.5)
    weight = sum(block.mass for block in program.ask.scene.blocks) * G
    assert np.abs(ends(program)).max() <= 1e-10
    assert abs(program.reactions[-1, 0, 2] / weight - 1) <= 1e-8
    assert program.report[:, 0].max() <= 1e-12


def test_a_wall_holds_at_rest_and_under_a_shake_that_friction_bears() -> None:
    for amplitude in (0.0, 0.005):
        program = solved(running_bond(4, 3, amplitude, 3.0), 0.5)
        terms = program.energies
        assert program.report[:, 0].max() <= 1e-5  # m/s
        assert program.report[:, 2].max() <= 1e-5  # m
        assert np.abs(terms.sum(axis=1)).max() <= 1e-9 * np.abs(terms).max()
    rest = solved(running_bond(4, 3), 0.5)
    weight = sum(block.mass for block in rest.ask.scene.blocks) * G
    assert abs(rest.reactions[-1, 0, 2] / weight - 1) <= 1e-8
    assert np.abs(ends(rest)).max() <= 1e-6


@pytest.mark.parametrize("angle", [0.0, 0.4, 1.9, np.pi])
def test_a_diagonal_push_is_opposed_along_the_push_whatever_the_frame(angle: float) -> None:
    scene = incline(20, 35, half=(0.5, 0.3, 0.1))
    axes = slope(20)[0]
    block = dataclasses.replace(scene.blocks[0], velocity=0.7 * axes[0] + 0.7 * axes[1])
    still = DOWN @ axes[2] * axes[2]  # gravity without its part down the dip
    scene = dataclasses.replace(scene, bodies=(scene.walls[0], block), gravity=still)
    turned = rotation_about_z(angle)
    program = solved(rotated(scene, turned), 0.05)
    moved = axes @ turned.T @ ends(program)[0]
    t, mu = 0.05, np.tan(np.radians(35))
    expected = 0.7 * np.sqrt(2) * t - mu * G * np.cos(np.radians(20)) * t**2 / 2
    assert moved[:2] == pytest.approx(np.full(2, expected / np.sqrt(2)), rel=1e-9)


def test_blocks_that_collide_keep_momentum_and_never_gain_energy() -> None:
    program = solved(colliding(), 1.0)
    path: Vector = program.arguments[0][:, ::2]
    mass = np.array([block.mass for block in program.ask.scene.blocks])
    momentum = np.einsum("n,knc->kc", mass, path[:, :, 3:6])
    kinetic = program.energies[:, 0]
    assert kinetic[-1] < 0.99 * kinetic[0]
    assert np.abs(momentum - momentum[0]).max() <= 1e-13 * np.abs(momentum).max()
    assert np.diff(kinetic).max() <= 1e-5 * kinetic[0]


@pytest.mark.parametrize("seed", [1, 2])
def test_the_motion_turns_with_the_frame(seed: int) -> None:
    scene, rotation = colliding(), turn(seed)
    plain, other = solved(scene, 0.4), solved(rotated(scene, rotation), 0.4)
    assert np.abs(ends(plain) @ rotation.T - ends(other)).max() <= 1e-9


def test_the_order_of_the_blocks_does_not_matter() -> None:
    scene = stack()
    scene = dataclasses.replace(scene, gravity=np.array([2.0, 1.0, -G]))
    plain, other = solved(scene, 0.3), solved(with_bodies_reversed(scene), 0.3)
    assert np.abs(ends(plain)).max() <= 1e-9
    assert np.abs(ends(plain) - ends(other)[::-1]).max() <= 1e-9
    plain, other = solved(colliding(), 0.3), solved(with_bodies_reversed(colliding()), 0.3)
    assert np.abs(ends(plain) - ends(other)[::-1]).max() <= 1e-9


def test_the_same_scene_gives_the_same_bits() -> None:
    first, second = solved(colliding(), 0.3), solved(colliding(), 0.3)
    assert np.array_equal(first.arguments[0], second.arguments[0])


def test_a_dropped_box_comes_to_rest_on_a_face() -> None:
    half = np.array([0.3, 0.2, 0.4])
    block = box("dropped", [0.0, 0.0, 1.0], half, turn(1))
    program = solved(Scene((FLOOR, block), Contact(np.inf, mu=0.4), gravity=DOWN), 3.0)
    mechanical = program.energies[:, [0, 5, 6]].sum(
        axis=1
    )  # except for the work of removing penetration
    height = 1.0 + ends(program)[0, 2]
    assert np.abs(half - height).min() <= 1e-9
    assert program.energies[-1, 0] <= 1e-15
    assert np.diff(mechanical).max() <= 1e-4 * np.ptp(mechanical)
    assert program.reactions[-1, 0, 2] == pytest.approx(block.mass * G, rel=1e-8)


def test_a_spinning_block_keeps_its_energy_to_second_order() -> None:
    block = box("spinning", [0.0, 0.0, 0.0], [0.3, 0.2, 0.4], spin=[1.0, 5.0, 2.0])
    drift = []
    for dt in (1e-2, 5e-3):
        kinetic = solved(Scene((block,), Contact(np.inf)), 1.0, dt).energies[:, 0]
        drift.append(np.ptp(kinetic) / kinetic[0])
    assert drift[0] <= 2e-5
    assert drift[1] <= 0.3 * drift[0]


def test_free_fall_is_exact() -> None:
    block = box("falling", [0.0, 0.0, 5.0], [0.3, 0.2, 0.4])
    program = solved(Scene((FLOOR, block), Contact(np.inf), gravity=DOWN), 0.5)
    assert ends(program)[0] == pytest.approx([0.0, 0.0, -G * 0.125], abs=1e-12)


@pytest.mark.parametrize("plane", [True, False], ids=["plane", "space"])
def test_the_first_motion_is_the_one_of_the_chart(plane: bool) -> None:
    for point in points(60, seed=400):
        assert seen(*point, plane) == charted(*point)[0], point


def refusal(scene: Scene) -> str:
    body = next(i for i, b in enumerate(scene.bodies) if isinstance(b, Block))
    run = rigid.solve(Ask(scene, History(0.1, 0.01), (Displacement(body),), Knobs(1e-3)))
    assert run.status is Status.REFUSED
    return run.reason


def test_bad_scenes_are_refused_by_name() -> None:
    rigid_contact = Contact(np.inf, mu=0.5)
    low = box("low", [0.0, 0.0, 0.49], [0.5, 0.5, 0.5])
    reason = refusal(Scene((FLOOR, low), rigid_contact))
    assert "block 'low' overlaps wall 0 by 0.01 m at t = 0" in reason
    one, two = (box(n, [x, 0.0, 0.0], [0.5, 0.4, 0.4]) for n, x in (("one", 0.0), ("two", 0.9)))
    reason = refusal(Scene((one, two), rigid_contact))
    assert "blocks 'one' and 'two' overlap by 0.1 m at t = 0, along the normal of fa" in reason
    falls = Scene((one,), rigid_contact, gravity=DOWN)
    assert "block 'one' has no support" in refusal(falls)
    assert "no stiffness" in refusal(Scene((one,), Contact(1e6)))
    flat = box("flat", [0.0, 0.0, 0.5], [0.5] * 3, free=[True, True, False], free_spin=HELD)
    assert "is not determined" in refusal(Scene((FLOOR, flat), rigid_contact))
    fast = dataclasses.replace(flat, velocity=np.array([0.0, 0.0, 1.0]))
    assert "locked axis" in refusal(Scene((fast,), rigid_contact))


def test_walls_beside_one_another_and_blocks_that_only_touch_are_fine() -> None:
    side = Wall(np.array([0.5, 0.0, 0.0]), np.array([-1.0, 0.0, 0.0]))
    block = box("cornered", [0.0, 0.0, 0.5], [0.5, 0.5, 0.5], free=FREE)
    scene = Scene((FLOOR, side, block), Contact(np.inf, mu=0.1), gravity=np.array([9.0, 0, -G]))
    program = solved(scene, 0.1)
    assert np.abs(ends(program)).max() <= 1e-10
    pressed = program.reactions[-1].sum(axis=0) / (block.mass * G)
    assert pressed == pytest.approx(-scene.gravity / G, abs=1e-8)

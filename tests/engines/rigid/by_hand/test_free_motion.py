"""Claims about rigid blocks without contact: forces, rotation, walls, scales and limits."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.engines.blocks.test_any_blocks import turned
from tests.scenes.blocks.block_scenes import box
from vv.engines.rigid.general.energy import kinetic
from vv.engines.rigid.general.events import move
from vv.engines.rigid.general.model import Space
from vv.engines.rigid.general.setting import (
    Setting,
    State,
    copy_of,
    fastest_speed,
    forecast,
    free_velocities,
    least_impact_speed,
    rates,
    residual_asked,
    shift_at,
    wall_rates,
)
from vv.engines.rigid.limits import CLOSE, FINE, FINEST, GENTLY, LONG, ROUNDED, SLOWLY
from vv.engines.rigid.scales import scales, size_of_motion
from vv.scene import Contact, Harmonic, Scene, Vector, Wall, rotated, rotation_about_z

pytestmark = pytest.mark.usefixtures("in_python")
GRAVITY = np.array([0.3, -0.5, -9.0])
AXES = turned(np.random.default_rng(1))
FREE = np.array([[True, True, True], [True, False, True]])
SPINS = np.array([[True, True, True], [False, True, True]])
V = np.array([[1.0, 0.2, -0.4], [-0.3, 0.5, 0.1]])
W = np.array([[2.0, -1.0, 3.0], [0.5, 0.2, -0.7]])
LOAD = np.array([[3.0, 2.0, -50.0], [90.0, 0.0, 20.0]])
BASE = Harmonic(np.array([0.02, 0.0, 0.03]), np.array([3.0, 0.0, 2.0]), np.array([0.4, 0.0, 2.0]))
OTHER = Harmonic(np.array([0.0, 0.01, 0.0]), np.array([0.0, 5.0, 0.0]), np.array([0.0, 1.0, 0.0]))
SHAKEN = Harmonic(np.array([2.0, 1.0, 3.0]), np.array([4.0, 2.0, 7.0]), np.array([0.1, 0.5, 1.2]))
DT = 1e-2


def scene(**given: Any) -> Scene:
    """Two unlike boxes, of which one is partly locked, over three walls of which two move."""
    halves = ([0.1, 0.2, 0.3], [0.4, 0.2, 0.25])
    boxes = [
        box(str(k), [2.0 * k, 0.5, 3.0], halves[k], turned(np.random.default_rng(5 + k)),
            velocity=_free(V, FREE, k), spin=_free(W, SPINS, k), load=LOAD[k], free=FREE[k],
            free_spin=SPINS[k])
        for k in range(2)
    ]  # fmt: skip
    walls = [Wall(np.array([0, 0, -9.0]), np.array([0, 0, 1.0]), m) for m in (BASE, None, OTHER)]
    data = {"gravity": GRAVITY, "shaking": SHAKEN, **given}
    return Scene((*boxes, *walls), Contact(np.inf, mu=0.3), axes=AXES, **data)


def _free(motion: Vector, free: Any, k: int) -> Vector:
    return np.asarray((motion[k] @ AXES.T * free[k]) @ AXES)


def begun(**given: Any) -> tuple[Setting, State, Scene]:
    """The setting of the scene, its state at the start with turned blocks, and itself."""
    made = scene(**given)
    setting, centre, v, w = Space(made).arguments(DT)
    rotation = np.array([turned(np.random.default_rng(9 + k)) for k in range(2)])
    return setting, State(centre, 0.0 * centre + 0.1, rotation, v, w), made


def hold(free: Any, k: int) -> Vector:
    """The projector on the free axes of a block."""
    rows = AXES[free[k]]
    return np.asarray(rows.T @ rows)


def rate(motion: Harmonic, t: float) -> Vector:
    """The velocity of a wall."""
    omega = 2.0 * np.pi * motion.frequency
    return np.asarray(motion.amplitude * omega * np.cos(omega * t + motion.phase))


def test_a_setting_has_the_masses_forces_and_projectors_of_its_blocks() -> None:
    setting, _, made = begun()
    for k, block in enumerate(made.blocks):
        inside = hold(FREE, k)
        assert setting.inverse[k] == pytest.approx(inside / block.mass)
        assert setting.force[k] == pytest.approx(inside @ (block.mass * GRAVITY + LOAD[k]))
        assert setting.hold_spin[k] == pytest.approx(hold(SPINS, k))
        assert setting.inertia[k] == pytest.approx(block.inertia)
    assert not setting.inverse[2:].any()
    assert setting.moves.tolist() == [True, True]
    assert setting.step == DT


def test_blocks_gain_velocity_from_forces_and_shaking_in_free_directions() -> None:
    setting, state, made = begun()
    now, span, v = 0.07, 0.03, np.full((5, 3), np.nan)
    free_velocities(setting, state, now, span, v)
    t = now + span * (np.arange(4000) + 0.5) / 4000
    shake = [np.mean(a * np.sin(2 * np.pi * f * t + p)) for a, f, p in
             zip(SHAKEN.amplitude, SHAKEN.frequency, SHAKEN.phase, strict=True)]  # fmt: skip
    for k, block in enumerate(made.blocks):
        push = GRAVITY + LOAD[k] / block.mass + shake
        assert v[k] == pytest.approx(state.v[k] + span * hold(FREE, k) @ push, rel=1e-6)
    assert v[2:] == pytest.approx(np.array([rate(BASE, 0.1), np.zeros(3), rate(OTHER, 0.1)]))


def test_walls_have_their_rates_and_ways() -> None:
    setting, state, _ = begun()
    v, w = np.full((5, 3), np.nan), np.full((5, 3), np.nan)
    rates(setting, state, 0.07, v, w)
    assert (v[:2].tolist(), w[:2].tolist()) == (state.v.tolist(), state.w.tolist())
    assert v[2:] == pytest.approx(np.array([rate(BASE, 0.07), np.zeros(3), rate(OTHER, 0.07)]))
    again = np.zeros((5, 3))
    wall_rates(setting, 0.07, again)
    assert again[2:].tolist() == v[2:].tolist()
    way = [np.sin(2 * np.pi * m.frequency * 0.07 + m.phase) - np.sin(m.phase)
           for m in (BASE, OTHER)]  # fmt: skip
    due = [BASE.amplitude * way[0], np.zeros(3), OTHER.amplitude * way[1]]
    assert shift_at(setting, 0.07) == pytest.approx(np.array(due))


def test_free_rotation_conserves_angular_momentum_about_free_axes() -> None:
    """The spin at the end and the rotation by the mean spin satisfy it to third order."""
    setting, state, _ = begun()
    span = 1e-3
    rotation, w, inverse = np.empty((2, 3, 3)), np.zeros((5, 3)), np.zeros((5, 3, 3))
    forecast(setting, state, span, rotation, w, inverse)
    for k in range(2):
        first, inside = state.rotation[k], hold(SPINS, k)
        mean = 0.5 * (state.w[k] + w[k])
        step = Rotation.from_rotvec(span * mean).as_matrix()
        assert rotation[k] == pytest.approx(step @ first, abs=1e-9)
        moment = first @ setting.inertia[k] @ first.T @ state.w[k]
        now = rotation[k] @ setting.inertia[k] @ rotation[k].T
        rows = AXES[SPINS[k]]
        due = rows.T @ np.linalg.solve(rows @ now @ rows.T, rows @ moment)
        assert w[k] == pytest.approx(due, abs=1e-8)
        assert inside @ w[k] == pytest.approx(w[k])
        assert inverse[k] == pytest.approx(rows.T @ np.linalg.inv(rows @ now @ rows.T) @ rows)
    assert np.abs(w[:2] - state.w).max() > 1e-4
    still = state._replace(w=np.zeros((2, 3)))
    forecast(setting, still, span, rotation, w, inverse)
    assert rotation == pytest.approx(state.rotation)
    assert not w.any()


def test_the_fastest_point_is_estimated_from_speed_spin_and_force() -> None:
    """Of blocks at the speed, the spin by their size and the push in a step; or of a wall."""
    setting, state, made = begun()
    of_blocks = [
        np.linalg.norm(state.v[k]) + np.linalg.norm(state.w[k]) * np.ptp(b.vertices, axis=0).max()
        + 0.01 * np.linalg.norm(setting.force[k]) / b.mass
        for k, b in enumerate(made.blocks)
    ]  # fmt: skip
    assert fastest_speed(setting, state, 0.07, 0.01) == pytest.approx(max(of_blocks))
    still = state._replace(v=np.zeros((2, 3)), w=np.zeros((2, 3)))
    of_walls = [np.linalg.norm(rate(m, 0.07)) for m in (BASE, OTHER)]
    assert fastest_speed(setting, still, 0.07, 0.0) == pytest.approx(max(of_walls))


def test_a_block_moves_by_the_mean_of_its_velocities_and_spins() -> None:
    setting, state, _ = begun()
    v, w = np.random.default_rng(3).normal(size=(2, 2, 3))
    w[1] = state.w[1] = 0.0
    before = copy_of(state)

    class Tried:
        """Of a trial only its end."""

    tried: Any = Tried()
    tried.v, tried.w = v, w
    move(setting, state, tried, 0.02)
    way = 0.02 * 0.5 * (before.v + v)
    assert state.centre == pytest.approx(before.centre + way)
    assert state.moved == pytest.approx(before.moved + way)
    for k in range(2):
        step = Rotation.from_rotvec(0.02 * 0.5 * (before.w[k] + w[k])).as_matrix()
        assert state.rotation[k] == pytest.approx(step @ before.rotation[k])
    assert (state.v.tolist(), state.w.tolist()) == (v.tolist(), w.tolist())


def test_the_kinetic_energy_is_of_velocities_and_of_spins_in_the_turned_frame() -> None:
    setting, state, made = begun()
    due = 0.0
    for k, block in enumerate(made.blocks):
        spin = state.rotation[k].T @ state.w[k]
        due += 0.5 * block.mass * state.v[k] @ state.v[k] + 0.5 * spin @ block.inertia @ spin
    assert kinetic(setting, state) == pytest.approx(due)


def norm(a: Vector) -> float:
    """The length of a vector."""
    return float(np.linalg.norm(a))


def test_scales_are_those_of_forces_motions_and_sizes() -> None:
    made = scene()
    extents = [np.ptp(b.vertices @ made.axes.T, axis=0) for b in made.blocks]
    sizes = [extent[free].max() for extent, free in zip(extents, FREE, strict=True)]
    weight = max(norm(GRAVITY + LOAD[k] / b.mass) for k, b in enumerate(made.blocks))
    turns = 2 * np.pi * BASE.frequency
    moved = max((BASE.amplitude * turns**2).sum(), 0.01 * (10 * np.pi) ** 2)
    carried = max((BASE.amplitude * turns).sum(), 0.01 * 10 * np.pi)
    swung = (SHAKEN.amplitude / (2 * np.pi * SHAKEN.frequency)).sum()
    thrown = max(
        norm(b.velocity) + norm(b.spin) * s for b, s in zip(made.blocks, sizes, strict=True)
    )
    pull = weight + 6.0 + moved
    found = scales(made)
    assert found.weight == pytest.approx(weight)
    assert found.pull == pytest.approx(pull)
    assert found.braking == pytest.approx(pull * made.contact.mu)
    rough = scales(dataclasses.replace(made, contact=Contact(np.inf, mu=1.5)))
    assert rough.braking == pytest.approx(pull)
    assert found.speed == pytest.approx(thrown + carried + np.sqrt(pull * min(sizes)))
    assert found.fall == pytest.approx(np.sqrt(weight * min(sizes)))
    assert found.quick == pytest.approx(min(weight / thrown, (6.0 + moved) / (swung + carried)))
    assert found.given == pytest.approx(thrown + swung + carried)


def test_without_weight_the_scale_is_that_of_motions() -> None:
    """A constant shaking counts as an acceleration that has no velocity of its own."""
    block = box("b", [0, 0, 3.0], [0.1, 0.2, 0.3])
    steady = Harmonic(np.array([4.0, 0, 0]), np.zeros(3), np.full(3, np.pi / 2))
    found = scales(Scene((block,), Contact(np.inf), shaking=steady))
    assert (found.weight, found.pull, found.quick, found.given) == (4.0, 4.0, 0.0, 0.0)
    assert found.fall == pytest.approx(np.sqrt(4.0 * 0.6))
    assert found.speed == pytest.approx(np.sqrt(4.0 * 0.6))
    heavy = scales(Scene((block,), Contact(np.inf), gravity=np.array([0, 0, -2.0]), shaking=steady))
    assert (heavy.weight, heavy.pull) == (2.0, 6.0)


@pytest.mark.parametrize("deep", [1e-3, 0.3, 50.0])
def test_the_depth_of_a_block_across_its_plane_of_motion_is_no_scale(deep: float) -> None:
    """In a scene whose plane is oblique to the frame, too."""
    plain = box("b", [0, 0, 3.0], [0.1, deep, 0.3])
    flat = dataclasses.replace(
        plain, free=np.array([True, False, True]), free_spin=np.array([False, True, False])
    )
    made = Scene((flat,), Contact(np.inf), gravity=np.array([0, 0, -2.0]))
    for seen in (made, rotated(made, rotation_about_z(0.7))):
        assert scales(seen).fall == pytest.approx(np.sqrt(2.0 * 0.6))
    held = dataclasses.replace(flat, free=np.zeros(3, bool))
    (block,) = Scene((held,), Contact(np.inf)).blocks
    assert size_of_motion(block, np.eye(3)) == pytest.approx(2 * max(deep, 0.3))


@pytest.mark.parametrize("field", [1.0, 1e-6])
def test_residuals_asked_of_small_scenes_follow_speeds_and_weights(field: float) -> None:
    setting, _, made = begun(gravity=field * GRAVITY, shaking=None)
    known = scales(made)
    due = FINEST * min(known.speed, known.given + LONG * known.pull * DT)
    assert setting.tolerance == pytest.approx(due, abs=0.0)
    assert setting.finest == pytest.approx(FINE * known.weight * DT, abs=0.0)
    for mu in (0.0, 1e-3):
        rubbed = dataclasses.replace(made, contact=Contact(np.inf, mu=mu))
        finest = Space(rubbed).arguments(DT)[0].finest
        due = 0.05 * CLOSE * mu * known.pull if mu else FINE * known.weight
        assert finest == pytest.approx(due * DT, abs=0.0)
    assert setting.pull == pytest.approx(known.pull)
    assert setting.braking == pytest.approx(known.braking)


@pytest.mark.parametrize(("fastest", "apart", "due"), [
    (1.0, 0.0, 2e-10), (1e4, 0.0, 1e4 * ROUNDED), (1.0, 5e-9, 5e-9), (1e9, 0.0, 1e-8),
])  # fmt: skip
def test_the_residual_of_a_step_is_rounding_within_bounds(
    fastest: float, apart: float, due: float
) -> None:
    setting = begun()[0]._replace(finest=2e-10, tolerance=1e-8)
    assert residual_asked(setting, fastest, apart) == pytest.approx(due, abs=0.0)


def test_an_impact_is_faster_than_a_part_of_the_velocity_gained_and_than_residuals() -> None:
    setting = begun()[0]._replace(pull=20.0, tolerance=1e-9)
    assert least_impact_speed(setting, 0.1) == pytest.approx(SLOWLY * 20.0 * 0.1)
    assert least_impact_speed(setting, 1e-6) == pytest.approx(GENTLY * 1e-9)

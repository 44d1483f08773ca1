"""Claims about the DEM engine's general kernel: conservation of free spheres, rotated scenes."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from vv.ask import Ask, Displacement, History, Knobs, Run
from vv.engines import dem
from vv.engines.dem.solve import PreparedSpheres
from vv.scene import Contact, Scene, Spheres, Vector, Wall, rotated, rotation_about_z

FAR = Wall(np.array([0.0, 0.0, -1e9]), np.array([0.0, 0.0, 1.0]))
RADIUS = np.array([1.0, 0.6, 0.8])
MASS = np.array([4.0, 1.0, 2.5])


def colliding(
    seed: int, mu: float = 0.3, count: int = 3, ks: float = 6e3, spin: float = 1.0
) -> Scene:
    """Spheres of unequal size that rotate and are about to collide near the origin, with friction.

    A wall out of reach and negligible forces let all these scenes share one kernel.
    """
    random = np.random.default_rng(seed)
    place = np.array([[0.0, 0.0, 0.0], [1.61, 0.0, 0.0], [0.7, 1.66, 0.0]])[:count]
    turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
    velocity = -0.4 * (place - place.mean(axis=0)) + 0.2 * random.normal(size=(count, 3))
    spheres = Spheres(
        position=place @ turn.T,
        velocity=velocity @ turn.T,
        radius=RADIUS[:count],
        mass=MASS[:count],
        free=np.ones((count, 3), bool),
        spin=spin * random.normal(size=(count, 3)),
        free_spin=np.ones((count, 3), bool),
        load=np.full((count, 3), 1e-100),
    )
    return Scene((spheres, FAR), Contact(1e4, ks, mu), 1e-100, np.full(3, 1e-100))


def solved(scene: Scene, dt: float, duration: float = 0.4) -> tuple[Run, Vector]:
    """The run, and displacement, velocity and spin (k, n, 9) of all spheres."""
    shown = tuple(Displacement(i) for i in range(len(scene.spheres)))
    program = dem.prepare(Ask(scene, History(duration, 0.01), shown, Knobs(dt)), dem.CENTRED)
    return program.run(program.solve()), path(program)


def path(program: PreparedSpheres) -> Vector:
    observed: Vector = program.arguments[0]
    return observed


@settings(max_examples=30)
@given(seed=st.integers(0, 10**6), mu=st.sampled_from([0.05, 0.3, 2.0]))
def test_colliding_spheres_keep_momentum_and_angular_momentum(seed: int, mu: float) -> None:
    scene = colliding(seed, mu)
    spheres = scene.spheres
    u, v, w = np.split(solved(scene, 1e-3)[1], 3, axis=2)
    m, inertia = spheres.mass[:, None], spheres.inertia[:, None]
    momentum = (m * v).sum(axis=1)
    moment = (np.cross(spheres.position + u, m * v) + inertia * w).sum(axis=1)
    turned = np.abs(w[-1] - w[0]).max()
    assert turned > 1e-3, "nothing touched"
    assert np.abs(momentum - momentum[0]).max() <= 1e-12 * np.abs(m * v[0]).sum()
    assert np.abs(moment - moment[0]).max() <= 1e-12 * np.abs(inertia * w[0]).sum()


@settings(max_examples=20)
@given(seed=st.integers(0, 10**6), mu=st.sampled_from([0.05, 0.3]))
def test_friction_takes_energy_and_never_gives_any(seed: int, mu: float) -> None:
    run, _ = solved(colliding(seed, mu), 2e-4)
    assert run.ledger is not None
    assert run.ledger.bound is None
    assert run.ledger.terms["friction dissipation"] > 0
    assert run.ledger.unaccounted < 5e-4 * run.ledger.peak


@pytest.mark.parametrize("mu", [0.05, 0.3, 2.0])
def test_the_energy_error_of_the_general_kernel_is_second_order(mu: float) -> None:
    def unaccounted(dt: float) -> float:
        runs = [solved(colliding(seed, mu), dt)[0] for seed in range(12)]
        return sum(run.ledger.unaccounted / run.ledger.peak for run in runs if run.ledger)

    errors = [unaccounted(dt) for dt in (5e-4, 1.25e-4, 3.125e-5)]
    assert np.log(errors[0] / errors[2]) / np.log(16) == pytest.approx(2, abs=0.25)


@settings(max_examples=10)
@given(seed=st.integers(0, 10**6))
def test_a_turned_scene_gives_the_turned_answer(seed: int) -> None:
    scene = colliding(seed)
    turn = rotation_about_z(0.7) @ np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    far = dataclasses.replace(scene, bodies=(*scene.bodies[:1], FAR))
    twin = rotated(far, turn)
    one, two = solved(scene, 1e-3)[1], solved(twin, 1e-3)[1]
    for first in (0, 3, 6):
        a, b = one[..., first : first + 3] @ turn.T, two[..., first : first + 3]
        assert np.abs(a - b).max() <= 1e-11 * np.abs(a).max()


@pytest.mark.parametrize("mu", [0.05, 0.3, 2.0])
def test_oblique_collisions_with_friction_converge_at_second_order(mu: float) -> None:
    ladder = (1e-3, 5e-4, 2.5e-4, 1.25e-4)
    errors = np.zeros(len(ladder))
    for seed in range(6):
        scene = colliding(seed, mu)
        fine = solved(scene, 1e-5)[1]
        errors += [np.abs(solved(scene, dt)[1] - fine).max() for dt in ladder]
    assert np.polyfit(np.log(ladder), np.log(errors), 1)[0] == pytest.approx(2, abs=0.25)


def test_two_soft_spheres_that_swing_round_each_other_keep_their_energy() -> None:
    # the pair turns by 0.4 rad in contact without slip, and its shear spring with it
    spheres = Spheres(
        position=np.array([[0.0, 0.0, 0.0], [1.6, 0.0, 0.0]]),
        velocity=np.array([[0.0, 0.0, 0.0], [-1.0, 0.6, 0.4]]),
        radius=RADIUS[:2],
        mass=MASS[:2],
        free=np.ones((2, 3), bool),
        spin=np.array([[0.5, 0.2, 0.1], [0.0, 0.3, -0.4]]),
        free_spin=np.ones((2, 3), bool),
        load=np.full((2, 3), 1e-100),
    )
    scene = Scene((spheres, FAR), Contact(3.0, 2.0, mu=50.0), 1e-100, np.full(3, 1e-100))
    runs = [solved(scene, dt, duration=1.0) for dt in (4e-3, 2e-3, 1e-3)]
    u = runs[-1][1][-1, :, :3] + spheres.position
    turned = np.arccos((u[1] - u[0])[0] / np.linalg.norm(u[1] - u[0]))
    errors = [run.ledger.unaccounted / run.ledger.peak for run, _ in runs if run.ledger]
    assert turned > 0.4
    assert errors[0] < 1e-5
    assert errors[0] / errors[2] == pytest.approx(16, rel=0.05)


def test_a_head_on_collision_of_two_free_spheres_is_that_of_the_reduced_mass() -> None:
    spheres = Spheres(
        position=np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 1.6]]),
        velocity=np.array([[0.0, 0.0, 0.0], [0.0, 0.0, -0.3]]),
        radius=RADIUS[:2],
        mass=MASS[:2],
        free=np.ones((2, 3), bool),
        free_spin=np.ones((2, 3), bool),
        load=np.full((2, 3), 1e-100),
    )
    scene = Scene((spheres, FAR), Contact(1e4, 6e3, 0.3), 1e-100, np.full(3, 1e-100))
    rate = np.sqrt(1e4 * MASS[:2].sum() / MASS[:2].prod())
    run, observed = solved(scene, 1e-5, duration=0.05)
    closing = observed[:, 1, 2] - observed[:, 0, 2]
    t = run.times
    exact = np.where(t < np.pi / rate, -0.3 / rate * np.sin(rate * t), 0.3 * (t - np.pi / rate))
    assert np.abs(closing - exact).max() < 1e-6 * np.abs(exact).max()
    assert dem.critical_step(scene, dem.CENTRED) < 2 / rate


def on_a_floor(velocity: list[float], spin: list[float], mu: float, m: float = 2.0) -> Scene:
    """A ball that rests on a floor by its weight, moves and rotates; another is far away."""
    g, kn, r = 10.0, 1e6, 0.5
    spheres = Spheres(
        position=np.array([[0.0, 0.0, r - m * g / kn], [0.0, 1e6, 1e6]]),
        velocity=np.array([velocity, [0.0, 0.0, 0.0]]),
        radius=np.full(2, r),
        mass=np.full(2, m),
        free=np.ones((2, 3), bool),
        spin=np.array([spin, [0.0, 0.0, 0.0]]),
        free_spin=np.ones((2, 3), bool),
        load=np.full((2, 3), 1e-100),
    )
    floor = Wall(np.zeros(3), np.array([0.0, 0.0, 1.0]))
    gravity = np.array([0.0, 0.0, -g])
    return Scene((spheres, floor), Contact(kn, 1e6, mu), 1e-100, gravity)


def test_a_sliding_ball_ends_up_rolling_at_five_sevenths_of_its_speed() -> None:
    _, observed = solved(on_a_floor([1.0, 0.0, 0.0], [0.0, 0.0, 0.0], mu=0.2), 2e-5, duration=0.3)
    v, w = observed[:, 0, 3:6], observed[:, 0, 6:9]
    assert v[10] == pytest.approx([1 - 0.2 * 10.0 * 0.1, 0.0, 0.0], abs=1e-4)
    assert v[-5:, 0].mean() == pytest.approx(5 / 7, rel=2e-3)
    assert w[-5:, 1].mean() * 0.5 == pytest.approx(5 / 7, rel=2e-2)


def test_the_shear_spring_turns_with_a_ball_that_spins_about_the_normal() -> None:
    # too heavy to be moved, it slides at s and spins at 2 W: the mean of both bodies is W, so
    # Fs' = -ks s + W n x Fs, whose size is 2 (ks s/W) sin(W t/2), turning from -s towards W
    heavy, s, rate = 1e12, 1e-3, 3.0
    scene = on_a_floor([s, 0.0, 0.0], [0.0, 0.0, 2 * rate], mu=1e3, m=2.0)
    ball = scene.spheres
    ball = dataclasses.replace(ball, mass=ball.mass * heavy, inertia=ball.inertia * heavy)
    scene = dataclasses.replace(scene, bodies=(ball, *scene.bodies[1:]), gravity=np.full(3, 1e-100))
    run, observed = solved(scene, 1e-3, duration=0.5)
    assert run.ledger is not None
    force = 2 * 1e6 * s / rate * np.sin(rate * 0.5 / 2)
    assert run.ledger.terms["shear elastic"] == pytest.approx(force**2 / 2e6, rel=1e-5)
    assert observed[-1, 0, 4] < 0

"""Claims about momentum and angular momentum of rotating spheres that collide."""

from __future__ import annotations

import numpy as np
import pytest

from vv.ask import Ask, Displacement, History, Knobs
from vv.engines import dem
from vv.scene import Contact, Scene, Spheres, Vector, Wall

KN, DT = 1e4, 5e-4
PLANE = Wall(np.zeros(3), np.array([0.0, 0.0, 1.0]))


def falling(seed: int) -> Scene:
    """Three unequal spheres that hit the plane one after the other, and each other in between."""
    random = np.random.default_rng(seed)
    radius = np.array([0.5, 0.3, 0.4])
    spheres = Spheres(
        np.array([[0.0, 0.0, 0.52], [0.9, 0.1, 0.9], [-0.9, 0.1, 1.4]]),
        np.array([[0, 0, -1], [-1, 0, -1], [1, 0, -1]]) + 0.5 * random.normal(size=(3, 3)),
        radius,
        np.array([4.0, 1.0, 2.0]),
        np.ones((3, 3), bool),
        spin=3 * random.normal(size=(3, 3)),
        free_spin=np.ones((3, 3), bool),
    )
    return Scene((spheres, PLANE), Contact(KN, 0.6 * KN, 0.4))


def collided(scene: Scene) -> tuple[Vector, Vector, Vector]:
    """Centres, velocities and spins (k, 3, 3) at every step."""
    seen = tuple(Displacement(i) for i in range(3))
    program = dem.prepare(Ask(scene, History(1.5, DT), seen, Knobs(DT)), dem.CENTRED)
    assert program.solve() == 3001
    u, v, w = np.split(program.arguments[0], 3, axis=2)
    return scene.spheres.position + u, v, w


@pytest.mark.parametrize("seed", [93, 176, 186])
def test_momentum_closes_with_the_plane_and_between_spheres(seed: int) -> None:
    """The tangential force of the plane follows from the momentum; its moment is the check.

    In a step both change by the mean of the forces at its ends: this is how a leapfrog conserves
    them.
    """
    scene = falling(seed)
    s = scene.spheres
    x, v, w = collided(scene)
    momentum = (s.mass[:, None] * v).sum(axis=1)
    moment = np.cross(x, s.mass[:, None] * v).sum(axis=1) + (s.inertia[:, None] * w).sum(axis=1)
    overlap = np.maximum(s.radius - x[:, :, 2], 0.0)
    touching = overlap > 0
    assert touching.sum(axis=1).max() == 1, "one at a time meets the plane"
    assert touching.any(axis=0).all(), "all of them do"
    apart = np.linalg.norm(x[:, [0, 1, 2]] - x[:, [1, 2, 0]], axis=2)
    assert (apart < s.radius + np.roll(s.radius, -1)).any(), "some pair collides"
    force, where = np.zeros((len(x), 3)), np.zeros((len(x), 3))
    for n in range(1, len(x)):
        force[n] = 2 * (momentum[n] - momentum[n - 1]) / DT - force[n - 1]
        if touching[n].any():
            i = int(touching[n].argmax())
            where[n] = x[n, i] - [0, 0, s.radius[i] - overlap[n, i] / 2]
        else:
            assert np.abs(force[n]).max() * DT <= 1e-12 * np.abs(momentum).max()
            force[n] = 0.0
    pressed = KN * overlap.sum(axis=1)
    assert np.abs(force[:, 2] - pressed).max() * DT <= 1e-12 * np.abs(momentum).max()
    acting = np.cross(where, force)
    gained = np.diff(moment, axis=0) - DT * (acting[1:] + acting[:-1]) / 2
    assert np.abs(gained).max() <= 1e-12 * np.abs(moment).max()
    assert np.abs(gained.sum(axis=0)).max() <= 1e-12 * np.abs(moment).max() * np.sqrt(len(x))

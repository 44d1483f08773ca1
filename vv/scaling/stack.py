"""A scene of any size: a lattice of rotating spheres with friction in a box, in random order."""

from __future__ import annotations

import numpy as np

from vv.ask import Ask, History, Knobs
from vv.scene import Contact, Scene, Spheres, Wall

RADIUS, MASS, LAW, DT = 0.01, 0.01, Contact(1e5, 2e4, 0.3), 2e-5
PITCH = 1.998  # radii: neighbours overlap, and the box keeps them in contact, six contacts each
TREMOR = 0.01  # m/s along each axis, which causes friction
CONTACTS = 3  # of two spheres, for each


def stack(about: int) -> Scene:
    """A stack of about n equal spheres, which fill a box that is nearly a cube.

    Each touches six others, or walls, throughout the run.
    """
    random, across = np.random.default_rng(1), _across(about)
    grid = np.stack(np.meshgrid(*map(np.arange, across), indexing="ij"), 3).reshape(-1, 3)
    x, n = RADIUS * PITCH * (random.permutation(grid) + 0.5), len(grid)
    free = np.ones((n, 3), bool)
    spheres = Spheres(
        x, TREMOR * random.normal(size=(n, 3)), np.full(n, RADIUS), np.full(n, MASS), free,
        free_spin=free,
    )  # fmt: skip
    far = RADIUS * PITCH * np.array(across, float)
    walls = [Wall(np.zeros(3), normal) for normal in np.eye(3)]
    walls += [Wall(far, -normal) for normal in np.eye(3)]
    return Scene((spheres, *walls), LAW, gravity=np.array([0.0, 0.0, -9.81]))


def asked(scene: Scene, steps: int) -> Ask:
    """The ask to run the scene for a number of steps, without observables."""
    return Ask(scene, History(steps * DT, steps * DT), (), Knobs(dt=DT))


def _across(n: int) -> tuple[int, int, int]:
    """The numbers of spheres along the sides of a box with about n."""
    x = round(n ** (1 / 3))
    y = round((n / x) ** 0.5)
    return x, y, round(n / x / y)

"""Creates settled random packs of equal spheres in a box, and stores them below .vv/.

Centres are drawn at random, pushed apart by drag and soft springs, and settle under gravity with
the friction of the bench. Spheres are numbered along the box, as by codes that sort them.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from vv.engines.dem.bulk.model import bulk
from vv.scene import Contact, Scene, Spheres, Vector, Wall

RADIUS, MASS, FILLED, DT = 0.01, 0.01, 0.56, 2e-5
LAW, SOFT = Contact(1e5, 2e4, 0.3), Contact(1e3)
APART, SETTLED = (20.0, 1500), (0.5, 12000)  # drag [N s/m] and number of steps of each stage
KEPT = Path(".vv")
DOWN = np.array([0.0, 0.0, -9.81])


def settled(n: int) -> Scene:
    """A pack of n spheres that are nearly at rest, with shear springs of zero length."""
    path = KEPT / f"pack-{n}.npz"
    if not path.exists():
        path.parent.mkdir(exist_ok=True)
        np.savez(path, x=packed(n))
    return box(np.asarray(np.load(path)["x"], float), width(n))


def width(n: int) -> float:
    """The side of the box [m], chosen so that the filled part is a cube."""
    return float((n * 4.0 / 3.0 * np.pi * RADIUS**3 / FILLED) ** (1.0 / 3.0))


def packed(n: int) -> Vector:
    """The positions (n, 3) [m] at which n spheres come to rest."""
    side = width(n)
    x = np.random.default_rng(1).uniform(RADIUS, side - RADIUS, (n, 3))
    x = after(
        replace(box(x, side), contact=SOFT, eta=APART[0], gravity=np.zeros(3)), 2e-4, APART[1]
    )
    x = after(replace(box(x, side), eta=SETTLED[0]), DT, SETTLED[1])
    cell = np.floor(x / (2.2 * RADIUS)).astype(int)
    return x[np.lexsort(cell.T)]


def box(x: Vector, side: float) -> Scene:
    """Spheres at rest in a box without a lid."""
    n = len(x)
    free = np.ones((n, 3), bool)
    spheres = Spheres(
        x, np.zeros((n, 3)), np.full(n, RADIUS), np.full(n, MASS), free, free_spin=free
    )
    walls = [Wall(np.zeros(3), normal) for normal in np.eye(3)]
    walls += [Wall(np.full(3, side), -normal) for normal in np.eye(3)[:2]]
    return Scene((spheres, *walls), LAW, eta=0.1, gravity=DOWN)


def after(scene: Scene, dt: float, steps: int) -> Vector:
    """The positions [m] of the spheres of a scene after a number of steps."""
    model, n = bulk(scene), len(scene.spheres)
    assert model is not None
    path, energy, watched = model.outputs(2, tuple(range(n)))
    assert model.kernel()(path, energy, watched, steps, dt, *model.state, 1.0, 0.0) == 2
    return np.asarray(scene.spheres.position + path[1, :, :3], float)

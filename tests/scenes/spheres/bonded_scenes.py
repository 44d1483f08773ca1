"""Scenes of bonded spheres: the unit of four elements of Liu et al. (2017)."""

from __future__ import annotations

import numpy as np

from vv.scene import Bonds, Contact, Scene, Spheres, Vector

D, KN, KS, M = 1e-3, 46793831.1079, 8067901.91516, 1.87383297e-6
CORNERS = D * np.array(
    [
        [0.0, 0.0, np.sqrt(2 / 3)],
        [1 / np.sqrt(3), 0.0, 0.0],
        [-0.5 / np.sqrt(3), 0.5, 0.0],
        [-0.5 / np.sqrt(3), -0.5, 0.0],
    ]
)
EDGES = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [2, 3], [3, 1]])


def elements(position: Vector = CORNERS, **changed: object) -> Spheres:
    """Spheres of the paper's mass and size at rest, free to move and not to turn."""
    n = len(position)
    data = {"velocity": np.zeros((n, 3)), "free": np.ones((n, 3), bool), **changed}
    return Spheres(position, radius=np.full(n, D / 2), mass=np.full(n, M), **data)  # type: ignore[arg-type]


def tied(**changed: object) -> Bonds:
    """The six bonds of the unit, unbreakable unless changed."""
    data = {"pairs": EDGES, "length": D, "kn": KN, "ks": KS, **changed}
    return Bonds(**data)  # type: ignore[arg-type]


def unit(spheres: Spheres | None = None, bonds: Bonds | None = None, **changed: object) -> Scene:
    """The unit without supports; contact after breakage has the springs of the bonds."""
    data = {"contact": Contact(KN, KS, 0.3964), "bonds": bonds or tied(), **changed}
    return Scene((spheres or elements(),), **data)  # type: ignore[arg-type]

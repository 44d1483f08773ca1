"""Four bonded elements, and E, nu and bond forces computed from their displacements."""

from __future__ import annotations

import numpy as np

from vv.ask import Displacement, Run
from vv.case import Parameters
from vv.scene import Bonds, Contact, Scene, Spheres, Vector

CORNERS = np.array(
    [
        [0.0, 0.0, np.sqrt(2 / 3)],
        [1 / np.sqrt(3), 0.0, 0.0],
        [-0.5 / np.sqrt(3), 0.5, 0.0],
        [-0.5 / np.sqrt(3), -0.5, 0.0],
    ]
)  # positions of the top and of the base, in diameters
OUT = CORNERS - CORNERS.mean(axis=0)
ROUND = np.cross([0.0, 0.0, 1.0], OUT)
EDGES = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [2, 3], [3, 1]])
BASE = np.array([[True, True, True], *[[True, True, False]] * 3])
SEEN = tuple(Displacement(i) for i in range(4))


def unit(p: Parameters, eta: float, **motion: Vector) -> Scene:
    """The unit with unbreakable bonds; elements rotate only if `motion` frees their spin."""
    data = {"velocity": np.zeros((4, 3)), "free": np.ones((4, 3), bool), **motion}
    spheres = Spheres(
        p["d"] * CORNERS, radius=np.full(4, p["d"] / 2), mass=np.full(4, p["m"]), **data
    )
    bonds = Bonds(EDGES, p["d"], p["kn"], p["gamma"] * p["kn"])  # type: ignore[arg-type]  # for all
    return Scene((spheres,), Contact(p["kn"]), eta, bonds=bonds)


def as_it_is(name: str, fz: float, d: float, u: Vector) -> float:
    """A quantity under Fz [N], by the deformed bonds after displacements u (4, 3) [m]."""
    offset, moved = moved_ends(d, u)
    length = np.linalg.norm(offset + moved, axis=1)
    stretch = np.einsum("bk,bk->b", 2 * offset + moved, moved) / (length + 1)
    n = (offset + moved) / length[:, None]
    return quantity_of(name, fz, d, float(u[0, 2]) / d, stretch, beside(moved, n))


def seen_at(run: Run, output: int) -> Vector:
    """Displacements (4, 3) [m] of the elements at an output."""
    return np.array([run.values[what][output] for what in SEEN])


def moved_ends(d: float, u: Vector) -> tuple[Vector, Vector]:
    """For each bond the offset of its ends and their relative displacement, over d."""
    i, j = EDGES.T
    return CORNERS[j] - CORNERS[i], (u[j] - u[i]) / d


def beside(moved: Vector, n: Vector) -> Vector:
    return np.asarray(np.linalg.norm(moved - np.einsum("bk,bk->b", n, moved)[:, None] * n, axis=1))


def quantity_of(
    name: str, fz: float, d: float, dz: float, stretch: Vector, across: Vector
) -> float:
    """A quantity from dimensionless displacements (over d), averaged over bonds of a kind."""
    strain = dz / np.sqrt(2 / 3)
    told = {
        "E": fz / (np.sqrt(3) / 2 * d * d * strain),
        "nu": -stretch[3:].mean() / strain,
        "dz": d * dz,
        "X_n1": d * stretch[:3].mean(),
        "X_s1": d * across[:3].mean(),
        "X_n2": d * stretch[3:].mean(),
    }
    return float(told[name])

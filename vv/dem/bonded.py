"""Builds the model of spheres that hang together by bonds which never break, and touch nothing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from vv.ask import Displacement, Observable
from vv.dem.leapfrog import Leapfrog
from vv.dem.rows import projected, projectors, triple
from vv.scene import Scene, Term, Vector

Index = npt.NDArray[np.intp]

BESIDE = frozenset({Term.SPHERE, Term.BOND, Term.BOND_SHEAR, Term.GRAVITY, Term.LOAD, Term.DRAG,
                    Term.OBLIQUE_LOCK, Term.FRICTION})  # fmt: skip
"""What a scene with bonds may have here; friction is that of contacts, of which there are none."""


class BondedState(NamedTuple):
    """What `move_bonded` receives about the scene, in its order, shapes and units."""

    velocity: Vector
    mass: Vector
    gravity: tuple[float, float, float] | None
    load: Vector | None
    hold: Vector | None
    springs: tuple[Index, Vector, Vector, Vector, Vector]
    ks: Vector | None
    eta: float | None


@dataclass(frozen=True, eq=False)
class Bonded:
    """The spheres that can move, in rows 0 to m - 1; row[sphere] is m for those that cannot."""

    row: Index
    state: BondedState
    terms: frozenset[Term]
    words: str

    @property
    def unknowns(self) -> tuple[Vector, ...]:
        """The array that holds a number per unknown; locked components are carried along."""
        return (self.state.velocity,)

    def outputs(self, rows: int, spheres: tuple[int, ...]) -> tuple[Vector | Index, ...]:
        """What the kernel fills, path and energy, and the rows it watches."""
        watched = self.row[np.array(spheres, np.intp)]
        return np.empty((rows, len(watched), 6)), np.empty((rows, 7)), watched

    def kernel(self) -> Callable[..., int]:
        """The compiled kernel; the first call imports numba."""
        from vv.dem.bonded_kernel import move_bonded

        return move_bonded

    def observed(self, path: Vector, index: int, sphere: int, what: Observable) -> Vector:
        """An observable (k, 3) of a sphere, which was the index-th one watched."""
        first = 0 if isinstance(what, Displacement) else 3
        return np.array(path[:, index, first : first + 3])

    def held(self, path: Vector, energy: Vector) -> Vector:
        """The ledger's terms [J], (k, 7)."""
        return np.asarray(energy * np.array([1.0, 1.0, 1.0, 1.0, 1.0, -1.0, -1.0]) + 0.0)

    def put_in(self, energy: Vector) -> float:
        """Kinetic and elastic energy [J] at t = 0."""
        kinetic = 0.5 * float(self.state.mass @ (self.state.velocity**2).sum(axis=1))
        return kinetic + float(energy[0, 1]) + float(energy[0, 2])

    def bound(self, energy: Vector, leapfrog: Leapfrog, dt: float) -> float | None:
        """None: where bonds turn, the energy is near one conserved but no bound is known."""
        return None


def why_not_bonded(scene: Scene) -> str | None:
    """Why the bonds of a scene cannot be modelled; None if they can, or there are none."""
    beside = scene.terms() - BESIDE
    if scene.bonds is None or not beside:
        return None
    return f"beside bonds, this is not modelled: {', '.join(sorted(t.value for t in beside))}"


def bonded(scene: Scene) -> Bonded | None:
    """The model of a scene with bonds, without what it does not have; None if it has none."""
    bonds, spheres = scene.bonds, scene.spheres
    if bonds is None:
        return None
    moves = np.any(spheres.free, axis=1)
    row = np.where(moves, np.cumsum(moves) - 1, moves.sum())
    kept = np.any(moves[scene.bonded], axis=1)
    i, j = scene.bonded[kept].T
    offset = spheres.position[j] - spheres.position[i]
    first = np.sqrt((offset**2).sum(axis=1))
    rows = np.stack([row[i], row[j]], axis=1)
    load, ks = spheres.load[moves], np.array(bonds.ks[kept])
    state = BondedState(
        velocity=projected(spheres.velocity[moves], scene.axes, spheres.free[moves]),
        mass=spheres.mass[moves],
        gravity=triple(scene.gravity) if scene.gravity.any() else None,
        load=load if load.any() else None,
        hold=projectors(scene.axes, spheres.free[moves]),
        springs=(rows, offset, first, first - bonds.length[kept], np.array(bonds.kn[kept])),
        ks=ks if ks.any() else None,
        eta=scene.eta if scene.eta > 0 else None,
    )
    words = f"{state.velocity.size} unknowns: {moves.sum()} moving spheres on {len(rows)} bonds"
    return Bonded(row, state, scene.terms() - {Term.FRICTION}, words)


def highest_square(state: BondedState) -> float:
    """w_max^2 [1/s2] of the bonds at t = 0, linear: that of the rigid ground included."""
    m = len(state.mass)
    rows, offset, first, _, kn = state.springs
    ks = np.zeros(len(kn)) if state.ks is None else state.ks
    n = offset / first[:, None]
    spring = (kn - ks)[:, None, None] * n[:, :, None] * n[:, None, :]
    spring = spring + ks[:, None, None] * np.eye(3)
    whole = np.zeros((m + 1, 3, m + 1, 3))
    for (i, j), k in zip(rows, spring, strict=True):
        for a, b, sign in ((i, i, 1.0), (j, j, 1.0), (i, j, -1.0), (j, i, -1.0)):
            whole[a, :, b] += sign * k
    inner = whole[:m, :, :m] / np.sqrt(state.mass[:, None, None, None] * state.mass[:, None])
    if state.hold is not None:
        inner = np.einsum("iab,ibjc,jcd->iajd", state.hold, inner, state.hold)
    return float(np.linalg.eigvalsh(inner.reshape(3 * m, 3 * m))[-1])

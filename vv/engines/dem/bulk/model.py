"""Builds the bulk model: many spheres, each free or fixed, and walls at rest."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from vv.ask import Displacement, Observable, Reaction
from vv.engines.dem.bonds.layout import MANY
from vv.engines.dem.bulk.grains import Given
from vv.engines.dem.contact.law import Law, law_of
from vv.engines.dem.leapfrog import Leapfrog
from vv.engines.dem.rows import Index, triple
from vv.engines.dem.space.ledger import signed
from vv.engines.dem.terms.drag import Drag
from vv.scene import Scene, Term, Vector

HAS = frozenset(
    {Term.SPHERE, Term.SPHERE_CONTACT, Term.WALL_CONTACT, Term.FRICTION, Term.DRAG, Term.GRAVITY,
     Term.ROTATION, Term.CONTACT_VISCOSITY, Term.VISCOUS_FRICTION, Term.HERTZ}
)  # fmt: skip


class BulkState(NamedTuple):
    """The arguments of `move_in_bulk` that describe the scene, in its order."""

    given: Given
    walls: Vector
    law: Law
    friction: tuple[float, float] | None
    dashpot: tuple[float, float] | None
    gravity: tuple[float, float, float]
    drag: Drag
    threads: int | None = None


@dataclass(frozen=True, eq=False)
class Bulk:
    """The bulk model of a scene, with spheres in the order of the scene."""

    state: BulkState
    terms: frozenset[Term]
    words: str

    @property
    def unknowns(self) -> tuple[Vector, ...]:
        """The arrays with one number per unknown."""
        given = self.state.given
        moving = np.isfinite(given.mass)
        told = (given.velocity,) if given.spin is None else (given.velocity, given.spin)
        return tuple(array[moving] for array in told)

    def outputs(self, rows: int, spheres: tuple[int, ...]) -> tuple[Vector | Index, ...]:
        """The arrays that the kernel fills, path and energy, and the spheres that it observes."""
        kinds = 1 if self.state.given.spin is None else 2
        path = np.empty((rows, len(spheres), 3 + 3 * kinds))
        return path, np.zeros((rows, 7)), np.array(spheres, np.intp)

    def kernel(self) -> Callable[..., int]:
        """The compiled kernel; the first call imports numba."""
        from vv.engines.dem.bulk.kernel import move_in_bulk

        return move_in_bulk

    def observed(self, path: Vector, index: int, sphere: int, what: Observable) -> Vector:
        """An observable (k, 3) of a sphere, the index-th of those observed."""
        if isinstance(what, Reaction):
            return np.zeros((len(path), 3))
        first = 0 if isinstance(what, Displacement) else 3
        return np.array(path[:, index, first : first + 3])

    def held(self, path: Vector, energy: Vector) -> Vector:
        """The terms of the energy ledger [J], (k, 7)."""
        return signed(energy)

    def put_in(self, energy: Vector) -> float:
        """Kinetic and elastic energy [J] at t = 0."""
        given = self.state.given
        moving = np.isfinite(given.mass)
        kinetic = 0.5 * float(given.mass[moving] @ (given.velocity[moving] ** 2).sum(axis=1))
        if given.spin is not None:
            kinetic += 0.5 * float(given.inertia[moving] @ (given.spin[moving] ** 2).sum(axis=1))
        return kinetic + float(energy[0, 1] + energy[0, 2])

    def bound(self, energy: Vector, leapfrog: Leapfrog, dt: float) -> float | None:
        """None: no bound of the energy is known, as for the general model."""
        return None


def bulk(scene: Scene) -> Bulk | None:
    """The bulk model of a scene of many spheres, each free or fixed; None for other scenes.

    Rotation is left out where no friction can change it and no sphere spins.
    """
    spheres, terms = scene.spheres, scene.terms()
    rubs, moving = Term.FRICTION in terms, spheres.free[:, 0]
    alike = [spheres.free, spheres.free_spin] if rubs or spheres.spin.any() else [spheres.free]
    if not terms <= HAS or np.count_nonzero(moving) < MANY:
        return None
    if not all((free == moving[:, None]).all() for free in alike):
        return None
    law, eta_n = law_of(scene), scene.contact.eta_n
    mass, inertia = (np.where(moving, what, np.inf) for what in (spheres.mass, spheres.inertia))
    spin = spheres.spin if rubs else None
    given = Given(spheres.position, spheres.velocity, spin, spheres.radius, mass, inertia)
    walls: Any = [[*wall.normal, wall.point @ wall.normal] for wall in scene.walls]
    state = BulkState(
        given,
        np.array(walls, float).reshape(-1, 4),
        law,
        law.friction,
        (scene.contact.kn, eta_n) if eta_n > 0 else None,
        triple(scene.gravity),
        Drag(scene.eta, None),  # may be zero: one kernel serves both cases
    )
    left_out = {Term.ROTATION} if spheres.spin.any() and not rubs else set()
    return Bulk(state, terms - left_out, _words(int(moving.sum()), len(spheres), rubs))


def _words(count: int, whole: int, rubs: bool) -> str:
    """The description of the model: how many of all spheres move."""
    words = f"{3 * count * (2 if rubs else 1)} unknowns: {count} free spheres"
    words += " that turn" if rubs else ""
    return f"{words}, sorted by cells" + (f", {whole - count} held" if whole > count else "")
